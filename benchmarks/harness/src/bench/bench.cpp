#include <bdpt/harness/bench/bench.h>

#include <bdpt/error.h>
#include <bdpt/io/exr.h>
#include <bdpt/version.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/bench_files.h"
#include "bench/hasher.h"
#include "bench/meter.h"
#include "bench/reference_cache.h"
#include "bench/strategy_shares.h"
#include "bench/trial.h"

namespace bdpt::harness {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Of a run's time, what finding out its samples takes at most.
constexpr double calibration_share = 1.0 / 3.0;

/// What all runs in a folder have in common.
ordered_json plan_settings(const BenchScene& scene, const BenchOptions& options,
                           const std::string& reference)
{
    ordered_json settings = render_settings(scene, options.render);
    settings["threads"] = options.render.threads;
    settings["cpu_seconds"] = options.seconds;
    settings["equal_samples"] = options.samples ? ordered_json(*options.samples) : ordered_json();
    settings["reference"] = reference;
    return settings;
}

/// Throws the `Error` for a folder that holds something else, with what differs.
void check_same(const ordered_json& ours, const ordered_json& kept, const fs::path& file)
{
    for (const auto& [name, value] : ours.items()) {
        const ordered_json other =
            kept.is_object() ? kept.value(name, ordered_json()) : ordered_json();
        if (other != value) {
            throw Error(ErrorCode::usage, file.string() + ": holds runs with " + name + " " +
                                              other.dump() + ", not " + value.dump() +
                                              "; choose another folder, or delete this one");
        }
    }
}

/// The samples of each integrator, found out once and then kept.
class Plan {
public:
    Plan(const BenchScene& scene, const BenchOptions& options, const BenchFiles& files,
         const std::string& reference)
        : file_(files.plan()), json_{{"settings", plan_settings(scene, options, reference)}}
    {
        std::optional<ordered_json> kept = read_json(file_);
        if (kept) {
            check_same(json_["settings"], kept->value("settings", ordered_json()), file_);
            json_ = std::move(*kept);
        }
    }

    /// False if stopped.
    bool complete(const BenchScene& scene, const BenchOptions& options, Meter& meter,
                  const BenchControl& control)
    {
        for (const IntegratorKind kind : options.integrators) {
            const double seconds = options.seconds * calibration_share;
            if (known(kind)) {
                meter.skip(seconds);
                continue;
            }
            meter.begin("how many samples take " + std::string(to_string(kind)) + " that long",
                        seconds);
            const auto samples =
                samples_in(make_setup(scene, options.render, kind, 0, control), options.seconds);
            if (!samples) {
                return false;
            }
            meter.end();
            json_["equal_time_samples"][to_string(kind)] = *samples;
        }
        if (!json_.contains("equal_samples")) {
            json_["equal_samples"] = options.samples.value_or(power_of_two_for_all(options));
        }
        write_json(file_, json_);
        return true;
    }

    [[nodiscard]] BenchGoals goals(IntegratorKind kind) const
    {
        return {.integrator = kind,
                .equal_time = number(json_["equal_time_samples"], std::string(to_string(kind))),
                .equal_samples = number(json_, "equal_samples")};
    }

private:
    [[nodiscard]] bool known(IntegratorKind kind) const
    {
        return json_.contains("equal_time_samples") &&
               json_["equal_time_samples"].contains(to_string(kind));
    }
    [[nodiscard]] std::int64_t power_of_two_for_all(const BenchOptions& options) const
    {
        std::int64_t least = std::numeric_limits<std::int64_t>::max();
        for (const IntegratorKind kind : options.integrators) {
            least =
                std::min(least, number(json_["equal_time_samples"], std::string(to_string(kind))));
        }
        std::int64_t power = 1;
        while (2 * power <= least) {
            power *= 2;
        }
        return power;
    }
    [[nodiscard]] std::int64_t number(const ordered_json& object, const std::string& name) const
    {
        const auto found = object.find(name);
        if (found == object.end() || !found->is_number_integer() || *found < 1 ||
            *found > most_samples) {
            throw Error(ErrorCode::invalid_input, file_.string() + ": " + name +
                                                      " is no number of samples; delete the folder "
                                                      "to start anew");
        }
        return found->get<std::int64_t>();
    }

    fs::path file_;
    ordered_json json_;
};

bool reaches(const BenchRun& run, const BenchGoals& goals)
{
    const auto has = [&](std::int64_t samples) {
        return std::any_of(run.checkpoints.begin(), run.checkpoints.end(),
                           [&](const Checkpoint& point) { return point.samples == samples; });
    };
    return has(goals.equal_time) && has(goals.equal_samples);
}

/// The run that the folder has; none if there is none.
std::optional<BenchRun> kept_run(const BenchFiles& files, const BenchGoals& goals,
                                 std::uint64_t seed)
{
    const fs::path file = files.run(goals.integrator, seed);
    const std::optional<ordered_json> json = read_json(file);
    if (!json) {
        return std::nullopt;
    }
    BenchRun run = parse_run(*json, file);
    if (run.integrator != goals.integrator || run.seed != seed || !reaches(run, goals)) {
        throw Error(ErrorCode::invalid_input, file.string() +
                                                  ": is another run than its name and "
                                                  "plan.json say; delete it to have it "
                                                  "made again");
    }
    return run;
}

void keep(const Trial& trial, const BenchFiles& files, const BenchScene& scene,
          const BenchGoals& goals)
{
    io::ExrOptions exr;
    exr.metadata.version = BDPT_VERSION;
    exr.metadata.scene = scene.file;
    exr.metadata.integrator = to_string(goals.integrator);
    exr.metadata.seed = trial.run.seed;
    exr.metadata.samples_per_pixel = goals.equal_time;
    exr.metadata.camera = scene.camera;
    exr.metadata.created = std::chrono::system_clock::now();
    io::write_exr(files.picture(goals.integrator, trial.run.seed), trial.picture, exr);
    // Comes last: a run without its numbers is none.
    write_json(files.run(goals.integrator, trial.run.seed), run_json(trial.run));
}

/// False if stopped.
bool run_all(const BenchScene& scene, const BenchOptions& options, const BenchFiles& files,
             const Reference& reference, Meter& meter, const BenchControl& control,
             SceneResult& result)
{
    for (int seed = 0; seed < options.seeds; ++seed) {
        for (const BenchGoals& goals : result.goals) {
            const auto number = static_cast<std::uint64_t>(seed);
            if (auto run = kept_run(files, goals, number)) {
                meter.skip(options.seconds);
                result.runs.push_back(std::move(*run));
                continue;
            }
            meter.begin(std::string(to_string(goals.integrator)) + ", seed " + std::to_string(seed),
                        options.seconds);
            auto trial =
                make_trial(make_setup(scene, options.render, goals.integrator, number, control),
                           goals, reference, meter);
            if (!trial) {
                return false;
            }
            meter.end();
            keep(*trial, files, scene, goals);
            result.runs.push_back(std::move(trial->run));
        }
    }
    return true;
}

}  // namespace

double planned_seconds(const BenchOptions& options)
{
    const auto integrators = static_cast<double>(options.integrators.size());
    return 2.0 * options.reference_seconds +
           integrators * options.seconds * (options.seeds + calibration_share) +
           (options.strategy_depth > 0 ? options.seconds : 0.0);
}

fs::path picture_file(const fs::path& folder, const std::string& scene, IntegratorKind integrator,
                      std::uint64_t seed)
{
    return BenchFiles(folder, scene).picture(integrator, seed);
}

std::vector<fs::path> scene_files(const fs::path& folder, const std::string& scene,
                                  const BenchOptions& options)
{
    const BenchFiles files(folder, scene);
    std::vector<fs::path> result{files.plan(), files.strategies()};
    for (const IntegratorKind kind : options.integrators) {
        for (int seed = 0; seed < options.seeds; ++seed) {
            const auto number = static_cast<std::uint64_t>(seed);
            result.push_back(files.run(kind, number));
            result.push_back(files.picture(kind, number));
        }
    }
    return result;
}

std::optional<SceneResult> run_scene(const BenchScene& scene, const BenchOptions& options,
                                     const fs::path& folder, const BenchControl& control)
{
    const BenchFiles files(folder, scene.name);
    files.create();
    Meter meter(planned_seconds(options), control);
    const auto keyed = reference_for(scene, options, files, meter, control);
    if (!keyed) {
        return std::nullopt;
    }
    const Reference& reference = keyed->reference;
    if (control.on_note) {
        control.on_note(scene.name + ": reference: " + reference.origin);
    }
    SceneResult result{.name = scene.name,
                       .file = scene.file,
                       .environment = scene.environment,
                       .camera = scene.camera.name,
                       .content = hex_text(scene.content) + hex_text(content_hash(scene.camera)),
                       .width = scene.width,
                       .height = scene.height,
                       .light_scale = bench_scale(reference.image).epsilon / 0.01,
                       .reference_noise = reference.noise,
                       .reference_origin = reference.origin,
                       .reference_file = keyed->file,
                       .goals = {},
                       .runs = {},
                       .complete = false};
    Plan plan(scene, options, files, keyed->key);
    if (!plan.complete(scene, options, meter, control)) {
        return result;
    }
    for (const IntegratorKind kind : options.integrators) {
        result.goals.push_back(plan.goals(kind));
    }
    if (!run_all(scene, options, files, reference, meter, control, result)) {
        return result;
    }
    result.complete = true;
    if (options.strategy_depth > 0) {
        measure_strategies(scene, options, files, reference, meter, control);
    }
    return result;
}

}  // namespace bdpt::harness
