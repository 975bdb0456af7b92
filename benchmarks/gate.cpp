// The gate: tests whether bdpt is as much better than mis as required. Compares the error at equal
// CPU time in scenes where light is hard to find, and where it is easy.

#include <bdpt/eval/bench.h>
#include <bdpt/eval/equal_time.h>
#include <bdpt/io/gltf.h>
#include <bdpt/render.h>

#include <CLI/CLI.hpp>

#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>

namespace {

using namespace bdpt;

/// A scene and the least required ratio of the error of `mis` to that of bdpt.
struct Demand {
    const char* file;
    double min_ratio;
};

constexpr std::array demands{Demand{"cornell-box-hidden.gltf", 4.0}, Demand{"lamp-box.gltf", 10.0},
                             Demand{"cornell-box.gltf", 1.0 / 1.5}};

struct Settings {
    std::string folder = BDPT_SCENES_DIR;
    int size = 128;                         ///< width and height [pixels]
    int max_depth = 8;                      ///< maximum path length [edges]
    int threads = 1;                        ///< 0: one per hardware thread
    std::int64_t reference_samples = 2048;  ///< per pixel
    eval::EqualTimeOptions contest;
};

eval::Reference make_reference(const eval::BenchScene& scene, RenderOptions options,
                               std::int64_t samples)
{
    options.system.threads = 0;
    eval::Reference reference = eval::render_reference(scene, options, samples);
    std::printf("%s: reference by %s: relMSE about %.1e\n", scene.name.c_str(),
                reference.origin.c_str(), reference.noise);
    std::fflush(stdout);
    return reference;
}

/// Tests whether the scene meets the demand.
bool measure(const Demand& demand, const Settings& settings)
{
    io::LoadedScene loaded = io::load_gltf(settings.folder + "/" + demand.file);
    const Scene built(std::move(loaded.scene));
    const eval::BenchScene scene{.name = demand.file,
                                 .file = demand.file,
                                 .scene = built,
                                 .camera = loaded.cameras.at(0),
                                 .width = settings.size,
                                 .height = settings.size};
    RenderOptions options;
    options.film = {.width = settings.size, .height = settings.size};
    options.transport.max_depth = settings.max_depth;
    options.system.threads = settings.threads;
    const eval::Reference reference = make_reference(scene, options, settings.reference_samples);
    std::array variants{eval::Variant{"bdpt", options}, eval::Variant{"mis", options}};
    variants[1].options.integrator = IntegratorKind::mis;
    const auto scores = compare_at_equal_time(scene, reference, variants, settings.contest);
    const double ratio = scores[1].error.median / scores[0].error.median;
    const bool met = ratio >= demand.min_ratio;
    std::printf("  relMSE: bdpt %.2e (%.2e .. %.2e), mis %.2e (%.2e .. %.2e)\n",
                scores[0].error.median, scores[0].error.least, scores[0].error.greatest,
                scores[1].error.median, scores[1].error.least, scores[1].error.greatest);
    std::printf("  samples: bdpt %lld, mis %lld\n", static_cast<long long>(scores[0].samples),
                static_cast<long long>(scores[1].samples));
    std::printf("  mis has %.2f times the relMSE of bdpt; at least %.2f is asked for: %s\n", ratio,
                demand.min_ratio, met ? "met" : "NOT MET");
    return met;
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Is bdpt as good against mis at equal CPU time as it is meant to be?"};
    app.add_option("folder", settings.folder, "Where the scenes are")->capture_default_str();
    app.add_option("--size", settings.size, "Width and height [pixels]")->capture_default_str();
    app.add_option("--max-depth", settings.max_depth, "Longest path in edges")
        ->capture_default_str();
    app.add_option("--threads", settings.threads, "Threads (0: all)")->capture_default_str();
    app.add_option("--reference", settings.reference_samples, "Samples of the reference")
        ->capture_default_str();
    app.add_option("--time", settings.contest.seconds, "CPU seconds a render")
        ->capture_default_str();
    app.add_option("--rounds", settings.contest.rounds, "Renders of each variant")
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        int missed = 0;
        for (const Demand& demand : demands) {
            missed += measure(demand, settings) ? 0 : 1;
        }
        std::printf("gate: %s\n", missed == 0 ? "passed" : "NOT PASSED");
        return missed == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
}
