#include "profile/time_recorder.h"

#include <algorithm>
#include <limits>

namespace bdpt {
namespace {

/// Preempted threads do not get their processor back sooner.
constexpr double suspicious_seconds = 30e-6;

/// Returns the ticks that PhaseClock::enter() takes: the minimum of the means of several batches,
/// as disturbances only make it slower.
double measure_clock()
{
    constexpr int batches = 16;
    constexpr int calls = 128;
    double least = std::numeric_limits<double>::max();
    for (int batch = 0; batch < batches; ++batch) {
        PhaseClock clock;
        for (int i = 0; i < calls; ++i) {
            clock.enter(Phase::walk);
        }
        const PhaseTicks& spent = clock.spent().front();
        least = std::min(least, static_cast<double>(spent.ticks) / calls);
    }
    return least;
}

double mean(const PhaseTicks& samples)
{
    return samples.pieces > 0
               ? static_cast<double>(samples.ticks) / static_cast<double>(samples.pieces)
               : 0.0;
}

void add(PhaseTicks& sum, const PhaseTicks& part)
{
    sum.ticks += part.ticks;
    sum.pieces += part.pieces;
}

SampleTicks compute_sum(tbb::combinable<SampleTicks>& parts)
{
    SampleTicks sum;
    parts.combine_each([&](const SampleTicks& part) {
        for (std::size_t i = 0; i < all_phases.size(); ++i) {
            add(sum.phases[i], part.phases[i]);
        }
        add(sum.clocked, part.clocked);
        add(sum.others, part.others);
        sum.interrupted += part.interrupted;
    });
    return sum;
}

}  // namespace

TimeProfile compute_profile(const SampleTicks& samples, double clock_ticks, double tick_seconds)
{
    std::array<double, all_phases.size()> ticks{};
    double phase_ticks = 0.0;
    double pieces = 0.0;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        const auto read = static_cast<double>(samples.phases[i].pieces);
        ticks[i] = std::max(static_cast<double>(samples.phases[i].ticks) - read * clock_ticks, 0.0);
        phase_ticks += ticks[i];
        pieces += read;
    }
    TimeProfile result;
    result.samples = samples.clocked.pieces + samples.others.pieces + samples.interrupted;
    result.clocked_samples = samples.clocked.pieces;
    const auto all = static_cast<double>(result.samples);
    // Two reads per sample, one more per interval.
    result.clock_seconds = (2.0 * all + pieces) * clock_ticks * tick_seconds;
    if (phase_ticks > 0.0) {
        const double clocked = phase_ticks / static_cast<double>(samples.clocked.pieces);
        const double plain = std::max(mean(samples.others) - clock_ticks, 0.0);
        // The duration of a sample is measured by those not timed by phase, if there are any.
        const double sample = plain > 0.0 ? plain : clocked;
        for (std::size_t i = 0; i < ticks.size(); ++i) {
            result.phase_seconds[i] = ticks[i] / phase_ticks * sample * all * tick_seconds;
        }
        result.distortion = plain > 0.0 ? clocked / plain : 0.0;
    }
    return result;
}

TimeRecorder::TimeRecorder(const PixelRect& region)
    : start_ticks_(read_ticks()),
      start_(std::chrono::steady_clock::now()),
      clock_ticks_(measure_clock()),
      suspicious_ticks_(suspicious_seconds / seconds_a_tick()),
      pixels_(region)
{}

double TimeRecorder::seconds_a_tick() const
{
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    return passed.count() / static_cast<double>(read_ticks() - start_ticks_);
}

TimeSheet TimeRecorder::sheet()
{
    return {.pixels = pixels_,
            .samples = samples_.local(),
            .clock_ticks = clock_ticks_,
            .suspicious_ticks = suspicious_ticks_};
}

TimeProfile TimeRecorder::profile(std::int64_t samples_of_pixel)
{
    const double tick_seconds = seconds_a_tick();
    TimeProfile result = compute_profile(compute_sum(samples_), clock_ticks_, tick_seconds);
    result.region = pixels_.region();
    result.pixel_seconds.reserve(pixels_.ticks().size());
    for (const double ticks : pixels_.ticks()) {
        result.pixel_seconds.push_back(
            static_cast<float>(ticks * tick_seconds / static_cast<double>(samples_of_pixel)));
    }
    return result;
}

}  // namespace bdpt
