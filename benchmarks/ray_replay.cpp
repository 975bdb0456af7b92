// Measures which part of a full bdpt render is ray tracing: compares its rays per second with those
// of replaying the same rays by Embree alone, by single-ray calls in the same scene and order,
// interleaved. Also measures the benefit of the BVH: some of these rays are tested against every
// triangle.

#include <bdpt/io/gltf.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "ray_throughput.h"

namespace {

using namespace bdpt;

struct Settings {
    std::vector<std::string> scenes;
    SubjectSettings subject{.size = 256};
    std::int64_t samples = 1;
    int rounds = 5;
    bool without_bvh = false;
    bool json = false;
};

void print(const Subject& subject, const RenderOptions& options, const RayThroughput& result,
           const std::optional<LoopThroughput>& loop)
{
    const auto rays = static_cast<double>(result.totals.rays);
    std::printf(
        "%s: %llu triangles, %.1f M rays, %.0f %% of them for closest hits, %.1f a sample\n",
        subject.name.c_str(),
        static_cast<unsigned long long>(subject.scene.counts().instanced_triangles), 1e-6 * rays,
        100.0 * static_cast<double>(result.totals.closest) / rays,
        rays / static_cast<double>(options.sampling.samples.end * options.film.width *
                                   options.film.height));
    std::printf("  M rays a CPU second: bdpt %.2f, Embree alone %.2f; ratio %.3f\n",
                1e-6 * result.bdpt, 1e-6 * result.embree, result.ratio);
    if (loop) {
        std::printf("  without a BVH %.3g rays a CPU second: Embree is %.3g times as fast\n",
                    loop->rays_per_second, result.embree / loop->rays_per_second);
    }
}

void print_json(const Subject& subject, const RayThroughput& result,
                const std::optional<LoopThroughput>& loop)
{
    nlohmann::ordered_json line{{"scene", subject.name},
                                {"triangles", subject.scene.counts().instanced_triangles},
                                {"rays", result.totals.rays},
                                {"bdpt_rays_per_second", result.bdpt},
                                {"embree_rays_per_second", result.embree}};
    if (loop) {
        line["all_triangles_rays_per_second"] = loop->rays_per_second;
    }
    std::printf("%s\n", line.dump().c_str());
}

/// Returns false if the replay differs from the render.
bool measure(const std::string& file, const Settings& settings)
{
    const Subject subject = load_subject(file, settings.subject);
    RenderOptions options = subject.options;
    options.integrator = IntegratorKind::bdpt;  // auto would trace rays of its own before
    options.sampling.samples.end = settings.samples;
    const RayLogs logs = record_rays(subject, options);
    const RayThroughput result = measure_throughput(subject, options, logs, settings.rounds);
    std::optional<LoopThroughput> loop;
    if (settings.without_bvh) {
        loop = measure_loop(AllTriangles(io::load_gltf(file).scene), logs);
    }
    if (settings.json) {
        print_json(subject, result, loop);
    } else {
        print(subject, options, result, loop);
    }
    constexpr double tolerance = 0.01;  // for rays that hit an edge or start beside a triangle
    if (!result.equal || (loop && loop->different > tolerance)) {
        std::fprintf(stderr, "error: the replay did not trace what the render did\n");
        return false;
    }
    return true;
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Rays per second of bdpt against those of Embree alone, for the same rays"};
    app.add_option("scenes", settings.scenes, "glTF files with a camera")->required();
    app.add_option("--spp", settings.samples, "Samples per pixel")->capture_default_str();
    app.add_option("--rounds", settings.rounds, "Renders and replays")->capture_default_str();
    app.add_flag("--without-bvh", settings.without_bvh,
                 "Trace some of the rays by a loop over all triangles, too");
    app.add_flag("--json", settings.json, "Print a line of JSON for each scene");
    add_options(app, settings.subject);
    CLI11_PARSE(app, argc, argv);
    return report_errors([&] {
        int failures = 0;
        for (const std::string& scene : settings.scenes) {
            failures += measure(scene, settings) ? 0 : 1;
        }
        return failures == 0 ? 0 : 1;
    });
}
