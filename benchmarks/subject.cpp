#include "subject.h"

#include <bdpt/framing.h>
#include <bdpt/io/environment.h>
#include <bdpt/io/gltf.h>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <utility>

namespace bdpt {

void add_options(CLI::App& app, SubjectSettings& settings)
{
    app.add_option("--env", settings.environment, "An image of light from all around");
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

void add_options(CLI::App& app, eval::EqualTimeOptions& contest)
{
    app.add_option("--time", contest.seconds, "CPU seconds a render")->capture_default_str();
    app.add_option("--rounds", contest.rounds, "Renders of each variant")->capture_default_str();
}

void add_sample_options(CLI::App& app, eval::EqualTimeOptions& contest)
{
    contest.samples = 16;
    app.add_option("--spp", contest.samples, "Samples per pixel (16 if not given)");
    app.add_option("--rounds", contest.rounds, "Renders of each variant")->capture_default_str();
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
    options.film.width = settings.size;
    options.film.height = settings.size;
    options.transport.max_depth = settings.max_depth;
    options.system.threads = settings.threads;
    return {std::move(name), std::move(scene), camera, options};
}

eval::BenchScene Subject::bench_scene() const
{
    return {.name = name,
            .file = name,
            .scene = scene,
            .camera = camera,
            .width = options.film.width,
            .height = options.film.height};
}

eval::Reference make_reference(const Subject& subject, std::int64_t samples)
{
    RenderOptions options = subject.options;
    options.system.threads = 0;
    eval::Reference reference = eval::render_reference(subject.bench_scene(), options, samples);
    std::printf("%s: reference by %s: relMSE about %.1e\n", subject.name.c_str(),
                reference.origin.c_str(), reference.noise);
    std::fflush(stdout);
    return reference;
}

void print_error(const std::exception& error)
{
    std::fprintf(stderr, "error: %s\n", error.what());
}

}  // namespace bdpt
