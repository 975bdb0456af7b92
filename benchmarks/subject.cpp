#include "subject.h"

#include <bdpt/framing.h>
#include <bdpt/harness/metrics/metric.h>
#include <bdpt/io/environment.h>
#include <bdpt/io/gltf.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "measure.h"

namespace bdpt {
namespace {

constexpr std::uint64_t reference_seed = 1'000'003;

}  // namespace

void add_options(CLI::App& app, SubjectSettings& settings)
{
    app.add_option("--env", settings.environment, "A picture of light from all around");
    app.add_option("--size", settings.size, "Width and height [pixels]")->capture_default_str();
    app.add_option("--max-depth", settings.max_depth, "Longest path in edges")
        ->capture_default_str();
    app.add_option("--threads", settings.threads, "Threads (0: all)")->capture_default_str();
}

void add_reference_option(CLI::App& app, SubjectSettings& settings)
{
    app.add_option("--reference", settings.reference_samples, "Samples of the reference")
        ->capture_default_str();
}

Subject load_subject(const std::string& file, const SubjectSettings& settings)
{
    io::LoadedScene loaded = io::load_gltf(file);
    std::string name = std::filesystem::path(file).stem().string();
    if (!settings.environment.empty()) {
        loaded.scene.lights.emplace_back(io::load_environment(settings.environment).light);
        name += " + " + std::filesystem::path(settings.environment).stem().string();
    }
    Scene scene(std::move(loaded.scene));
    const CameraDesc camera =
        loaded.cameras.empty() ? frame_scene(scene, 1.0f).camera : loaded.cameras.front();
    RenderOptions options;
    options.width = settings.size;
    options.height = settings.size;
    options.max_depth = settings.max_depth;
    options.threads = settings.threads;
    return {std::move(name), std::move(scene), camera, options};
}

Reference make_reference(const Subject& subject, std::int64_t samples)
{
    RenderOptions options = subject.options;
    options.threads = 0;
    options.seed = reference_seed;
    options.samples.end = samples;
    const RenderResult result = render(subject.scene, subject.camera, options);
    // The squared difference of the halves has four times the variance of their mean.
    Reference reference{
        .image = result.film.develop(),
        .noise = harness::evaluate(harness::Metric::relmse, result.film.develop_half(0),
                                   result.film.develop_half(1)) /
                 4.0};
    std::printf("%s: reference by bdpt with %lld samples: %.1f s, relMSE about %.1e\n",
                subject.name.c_str(), static_cast<long long>(samples), result.seconds,
                reference.noise);
    std::fflush(stdout);
    return reference;
}

double error_of(const Film& film, const Reference& reference)
{
    return std::max(harness::evaluate(harness::Metric::relmse, film.develop(), reference.image) -
                        reference.noise,
                    1e-12);
}

void print_error(const std::exception& error)
{
    std::fprintf(stderr, "error: %s\n", error.what());
}

}  // namespace bdpt
