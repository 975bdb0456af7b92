#include <bdpt/eval/bench_report.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bdpt::eval {
namespace {

/// Removes the reference's noise from an error; the result is at least a small fraction of the
/// noise, so that its logarithm exists.
double without_noise(double relmse, double noise)
{
    constexpr double least = 1e-12;
    return std::max({relmse - noise, 0.1 * noise, least});
}

/// Returns a value of each run at the checkpoint of `samples`.
template <typename Value>
std::vector<double> at(const std::vector<const BenchRun*>& runs, std::int64_t samples,
                       const Value& value)
{
    std::vector<double> result;
    for (const BenchRun* run : runs) {
        for (const Checkpoint& point : run->checkpoints) {
            if (point.samples == samples) {
                result.push_back(value(point));
            }
        }
    }
    return result;
}

/// Ratio of relmse_scales to relmse of uncorrelated noise: averages over squares of 2, 4, 8 and 16
/// pixels a side reduce its variance by their area.
constexpr double noise_at_scales = (1.0 + 1.0 / 4.0 + 1.0 / 16.0 + 1.0 / 64.0 + 1.0 / 256.0) / 5.0;

/// Summarizes runs. `seconds`: CPU time that errors are extrapolated to; none: no extrapolation.
GoalSummary summarize_goal(const std::vector<const BenchRun*>& runs, std::int64_t samples,
                           double noise, std::optional<double> seconds)
{
    const auto compute_median = [&](const auto& value) {
        return spread(at(runs, samples, value)).median;
    };
    const double raw = compute_median([](const Checkpoint& point) { return point.relmse; });
    // Errors are taken as proportional to the inverse of the time.
    const auto brought_to_time = [&](double error, const Checkpoint& point) {
        return error * (seconds ? point.cpu_seconds / *seconds : 1.0);
    };
    return {
        .samples = samples,
        .cpu_seconds = compute_median([](const Checkpoint& point) { return point.cpu_seconds; }),
        .wall_seconds = compute_median([](const Checkpoint& point) { return point.wall_seconds; }),
        .error = spread(at(runs, samples,
                           [&](const Checkpoint& point) {
                               return brought_to_time(without_noise(point.relmse, noise), point);
                           })),
        .error_scales =
            spread(at(runs, samples,
                      [&](const Checkpoint& point) {
                          return brought_to_time(
                              without_noise(point.relmse_scales, noise_at_scales * noise), point);
                      })),
        .mape = spread(at(runs, samples, [](const Checkpoint& point) { return point.mape; })),
        .near_noise = raw < 3.0 * noise};
}

std::vector<CurvePoint> compute_curve(const std::vector<const BenchRun*>& runs, double noise)
{
    std::vector<CurvePoint> result;
    for (const Checkpoint& first : runs.front()->checkpoints) {
        const auto errors = at(runs, first.samples, [&](const Checkpoint& point) {
            return without_noise(point.relmse, noise);
        });
        const auto seconds =
            at(runs, first.samples, [](const Checkpoint& point) { return point.cpu_seconds; });
        result.push_back({.samples = first.samples,
                          .cpu_seconds = spread(seconds).median,
                          .error = spread(errors)});
    }
    return result;
}

/// Adds rates over all runs, in wall-clock time.
void add_rates(const std::vector<const BenchRun*>& runs, IntegratorSummary& summary)
{
    double seconds = 0.0;
    double samples = 0.0;
    RenderStats stats;
    for (const BenchRun* run : runs) {
        seconds += run->checkpoints.back().wall_seconds;
        samples += static_cast<double>(run->checkpoints.back().samples);
        stats += run->stats;
        summary.invalid += run->invalid;
        if (run->peak_memory) {
            summary.peak_memory = std::max(summary.peak_memory.value_or(0), *run->peak_memory);
        }
    }
    seconds = std::max(seconds, 1e-9);
    summary.samples_per_second = samples / seconds;
    summary.camera_rays_per_second = static_cast<double>(stats.rays.camera) / seconds;
    summary.light_rays_per_second = static_cast<double>(stats.rays.light) / seconds;
    summary.shadow_rays_per_second = static_cast<double>(stats.rays.shadow) / seconds;
}

void add_speed_ups(std::vector<IntegratorSummary>& summaries)
{
    const auto pt = std::find_if(
        summaries.begin(), summaries.end(),
        [](const IntegratorSummary& summary) { return summary.integrator == IntegratorKind::pt; });
    if (pt == summaries.end()) {
        return;
    }
    const double error = pt->curve.back().error.median;
    const double seconds = pt->curve.back().cpu_seconds;
    for (IntegratorSummary& summary : summaries) {
        if (summary.integrator == IntegratorKind::pt) {
            summary.speed_up = SpeedUp{};
            continue;
        }
        const TimeToError time = time_to_error(summary.curve, error);
        summary.speed_up =
            SpeedUp{.factor = seconds / time.seconds, .extrapolated = time.extrapolated};
    }
}

}  // namespace

TimeToError time_to_error(const std::vector<CurvePoint>& curve, double error)
{
    const CurvePoint& last = curve.back();
    if (last.error.median > error) {
        return {.seconds = last.cpu_seconds * last.error.median / error, .extrapolated = true};
    }
    for (std::size_t i = curve.size() - 1; i > 0; --i) {
        const CurvePoint& before = curve[i - 1];
        const CurvePoint& after = curve[i];
        if (before.error.median <= error) {
            continue;
        }
        const double share = std::log(before.error.median / error) /
                             std::log(before.error.median / after.error.median);
        return {
            .seconds = before.cpu_seconds * std::pow(after.cpu_seconds / before.cpu_seconds, share),
            .extrapolated = false};
    }
    const CurvePoint& first = curve.front();
    return {.seconds = first.cpu_seconds * first.error.median / error,
            .extrapolated = first.error.median < error};
}

std::vector<IntegratorSummary> summarize(const SceneResult& result, double seconds)
{
    std::vector<IntegratorSummary> summaries;
    for (const BenchGoals& goals : result.goals) {
        std::vector<const BenchRun*> runs;
        for (const BenchRun& run : result.runs) {
            if (run.integrator == goals.integrator) {
                runs.push_back(&run);
            }
        }
        if (runs.empty()) {
            continue;
        }
        IntegratorSummary summary;
        summary.integrator = goals.integrator;
        summary.seeds = static_cast<int>(runs.size());
        summary.equal_time =
            summarize_goal(runs, goals.equal_time, result.reference_noise, seconds);
        summary.equal_samples =
            summarize_goal(runs, goals.equal_samples, result.reference_noise, std::nullopt);
        summary.curve = compute_curve(runs, result.reference_noise);
        summary.efficiency = 1.0 / (summary.equal_time.error.median * seconds);
        add_rates(runs, summary);
        for (const ErrorFloor& floor : result.floors) {
            if (floor.integrator == goals.integrator) {
                summary.floor = floor.relmse;
            }
        }
        for (const VisibleErrors& visible : result.visible) {
            if (visible.integrator == goals.integrator) {
                summary.flip = visible.flip;
                summary.denoised_flip = visible.denoised_flip;
            }
        }
        summaries.push_back(std::move(summary));
    }
    add_speed_ups(summaries);
    return summaries;
}

}  // namespace bdpt::eval
