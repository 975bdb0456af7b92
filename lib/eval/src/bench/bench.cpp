#include <bdpt/eval/bench.h>

#include <bdpt/error.h>
#include <bdpt/eval/bench_report.h>
#include <bdpt/eval/statistics.h>
#include <bdpt/io/denoise.h>
#include <bdpt/io/read_image.h>
#include <bdpt/io/write_image.h>
#include <bdpt/options/integrators.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/render.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "bench/bench_parts.h"

namespace bdpt::eval {

std::vector<IntegratorKind> all_integrators()
{
    std::vector<IntegratorKind> kinds;
    for (const IntegratorInfo& integrator : integrators()) {
        kinds.push_back(integrator.kind);
    }
    return kinds;
}

std::vector<IntegratorKind> unbiased_integrators()
{
    std::vector<IntegratorKind> kinds = all_integrators();
    std::erase_if(kinds, [](IntegratorKind kind) { return info(kind).biased; });
    return kinds;
}

namespace {

constexpr double min_share = 0.1;  // least share of the error; a smaller floor is negligible
constexpr double min_errors = 3.0;

/// Returns the mean of (a - r) (b - r) / (r^2 + e).
double product(const Image& a, const Image& b, const Image& reference, double epsilon)
{
    return relative_mean(reference, epsilon, [&](std::size_t i, int c, double r) {
        return (static_cast<double>(a.pixels[i][c]) - r) *
               (static_cast<double>(b.pixels[i][c]) - r);
    });
}

}  // namespace

std::optional<double> error_floor(std::span<const Image> images, const Image& reference,
                                  double noise)
{
    const double epsilon = bench_scale(reference).squared_epsilon;
    Moments own;     // relMSE of each image
    Moments common;  // product of the errors of each pair of images
    for (std::size_t i = 0; i < images.size(); ++i) {
        own.add(product(images[i], images[i], reference, epsilon));
        for (std::size_t j = 0; j < i; ++j) {
            common.add(product(images[i], images[j], reference, epsilon));
        }
    }
    const double floor = common.mean() - noise;
    const bool matters = floor > min_share * own.mean() && floor > noise;
    const bool sure = common.count() < 2 || floor > min_errors * common.standard_error();
    return matters && sure ? std::optional(floor) : std::nullopt;
}

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

bool reaches(const BenchRun& run, const BenchGoals& goals)
{
    const auto has = [&](std::int64_t samples) {
        return std::any_of(run.checkpoints.begin(), run.checkpoints.end(),
                           [&](const Checkpoint& point) { return point.samples == samples; });
    };
    return has(goals.equal_time) && has(goals.equal_samples);
}

/// Returns the run in the folder; none if there is none.
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
                                                  ": does not match its name and plan.json; delete "
                                                  "it to render it again");
    }
    return run;
}

void keep(const Trial& trial, const BenchFiles& files, const BenchScene& scene,
          const BenchGoals& goals)
{
    io::ExrOptions exr;
    exr.metadata = make_metadata(scene);
    exr.metadata.integrator = to_name(goals.integrator);
    exr.metadata.seed = trial.run.seed;
    exr.metadata.samples_per_pixel = goals.equal_time;
    io::write_exr(files.image(goals.integrator, trial.run.seed), trial.image, exr);
    // Written last: a run without its numbers does not count.
    write_json(files.run(goals.integrator, trial.run.seed), run_json(trial.run));
}

/// Returns false if stopped.
bool run_all(const BenchScene& scene, const BenchOptions& options, const BenchFiles& files,
             const Reference& reference, BenchProgressMeter& meter, const BenchControl& control,
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
            meter.begin(std::string(to_name(goals.integrator)) + ", seed " + std::to_string(seed),
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

/// Opens Open Image Denoise; returns none where it is not found.
std::optional<io::Denoiser> open_denoiser(int threads)
{
    try {
        return io::Denoiser({}, threads);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::unsupported) {
            throw;
        }
        return std::nullopt;
    }
}

/// Compares images as people see them, raw and denoised.
class Viewer {
public:
    Viewer(const BenchScene& scene, const BenchOptions& options, const Image& reference)
        : reference_(reference),
          exposures_(flip_exposures(reference)),
          denoiser_(open_denoiser(options.render.system.threads))
    {
        if (denoiser_) {
            RenderOptions guides = options.render;
            guides.integrator = IntegratorKind::mis;
            guides.film = {
                .width = scene.width, .height = scene.height, .aovs = {Aov::albedo, Aov::normal}};
            guides.transport.max_depth = 1;
            guides.sampling.samples = {0, 16};
            const RenderResult result = render(scene.scene, scene.camera, guides);
            layers_ = result.aovs.develop(result.film);
        }
    }

    [[nodiscard]] VisibleErrors judge(IntegratorKind kind, std::span<const Image> images) const
    {
        std::vector<double> raw;
        std::vector<double> denoised;
        for (const Image& image : images) {
            raw.push_back(mean(hdr_flip(image, reference_, exposures_)));
            if (denoiser_) {
                const Image clean = denoiser_->denoise(
                    {.image = image, .albedo = &layers_.at(0), .normal = &layers_.at(1)});
                denoised.push_back(mean(hdr_flip(clean, reference_, exposures_)));
            }
        }
        return {.integrator = kind,
                .flip = spread(raw),
                .denoised_flip = denoiser_ ? std::optional(spread(denoised)) : std::nullopt};
    }

private:
    const Image& reference_;
    FlipExposures exposures_;
    std::optional<io::Denoiser> denoiser_;
    std::vector<Layer> layers_;  ///< albedo and normals, if there is a denoiser
};

/// Finds what the images of each integrator have in common: error floors, and what people see.
void judge_images(const BenchScene& scene, const BenchOptions& options, const BenchFiles& files,
                  const Reference& reference, SceneResult& result)
{
    const Viewer viewer(scene, options, reference.image);
    for (const BenchGoals& goals : result.goals) {
        std::vector<Image> images;
        for (const BenchRun& run : result.runs) {
            if (run.integrator == goals.integrator) {
                const fs::path file = files.image(run.integrator, run.seed);
                images.push_back(io::read_image(file).image);
                check_size(images.back(), result.width, result.height, file);
            }
        }
        if (images.empty()) {
            continue;
        }
        result.visible.push_back(viewer.judge(goals.integrator, images));
        const auto floor = images.size() < 2
                               ? std::nullopt
                               : error_floor(images, reference.image, reference.noise);
        if (floor) {
            result.floors.push_back({.integrator = goals.integrator, .relmse = *floor});
        }
    }
}

}  // namespace

double planned_seconds(const BenchOptions& options)
{
    const auto integrators = static_cast<double>(options.integrators.size());
    return 2.0 * options.reference_seconds +
           integrators * options.seconds * (options.seeds + calibration_share) +
           (options.strategy_depth > 0 ? options.seconds : 0.0);
}

fs::path image_file(const fs::path& folder, const std::string& scene, IntegratorKind integrator,
                    std::uint64_t seed)
{
    return BenchFiles(folder, scene).image(integrator, seed);
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
            result.push_back(files.image(kind, number));
        }
    }
    return result;
}

std::optional<SceneResult> run_scene(const BenchScene& scene, const BenchOptions& options,
                                     const fs::path& folder, const BenchControl& control)
{
    const BenchFiles files(folder, scene.name);
    files.create();
    BenchProgressMeter meter(planned_seconds(options), control);
    // Refuses an unsuitable folder before a reference is rendered for it.
    std::optional<Plan> plan;
    if (!options.reference) {
        plan.emplace(scene, options, files, reference_key(scene, options));
    }
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
                       .content = hash_content(scene),
                       .width = scene.width,
                       .height = scene.height,
                       .light_scale = bench_scale(reference.image).epsilon / 0.01,
                       .reference_noise = reference.noise,
                       .reference_origin = reference.origin,
                       .reference_file = keyed->file,
                       .goals = {},
                       .runs = {},
                       .complete = false};
    if (!plan) {
        plan.emplace(scene, options, files, keyed->key);
    }
    if (!plan->complete(scene, options, meter, control)) {
        return result;
    }
    for (const IntegratorKind kind : options.integrators) {
        result.goals.push_back(plan->goals(kind));
    }
    result.complete = run_all(scene, options, files, reference, meter, control, result);
    judge_images(scene, options, files, reference, result);
    if (result.complete && options.strategy_depth > 0) {
        measure_strategies(scene, options, files, reference, meter, control);
    }
    return result;
}

}  // namespace bdpt::eval
