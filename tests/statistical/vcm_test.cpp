// Vertex connection and merging is biased by its radius: with a small one it agrees with mis, as
// all integrators do; with a large one it does not, and the less so the more the radius shrinks.

#include "catch.hpp"
#include "equal_means.h"
#include "equality_cases.h"
#include "scene_builder.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::test {
namespace {

RenderOptions options(const EqualityCase& test, IntegratorKind integrator, std::uint64_t seed)
{
    RenderOptions result;
    result.integrator = integrator;
    result.transport.max_depth = test.max_depth;
    result.sampling.seed = seed;
    return result;
}

MeanComparison compare(const EqualityCase& test, const std::string& what, TileMeans& a,
                       TileMeans& b, const Sharpness& sharpness)
{
    const MeanComparison result = compare_means(a, b, sharpness);
    UNSCOPED_INFO(test.name << ", " << what << ": " << result.text());
    if (std::getenv("BDPT_TEST_VERBOSE") != nullptr) {
        std::cout << test.name << ", " << what << ": " << result.text() << "\n";
    }
    return result;
}

/// Leaves all paths of two edges and more to merging.
RenderOptions merging_alone(RenderOptions options)
{
    options.bidirectional.connections = 0.0;
    for (int n = 3; n <= options.transport.max_depth + 1; ++n) {
        for (const int s : {0, 1, n - 1, n}) {
            options.bidirectional.disabled.push_back({.s = s, .t = n - s});
        }
    }
    return options;
}

/// Every case of a number that `step` divides.
void check_small_radius(const std::vector<EqualityCase>& cases, std::size_t step,
                        std::uint64_t seed, SamplerKind sampler = SamplerKind::independent)
{
    for (std::size_t i = 0; i < cases.size(); i += step) {
        const EqualityCase& test = cases[i];
        const Scene scene(test.scene);
        TileMeans mis(scene, test.camera, options(test, IntegratorKind::mis, seed + 10 * i));
        RenderOptions small = options(test, IntegratorKind::vcm, seed + 10 * i + 1);
        small.bidirectional.merge_radius = 0.02;
        small.bidirectional.light_paths = i % 3 == 0 ? 0.5 : 1.0;
        small.transport.heuristic = i % 2 == 0 ? Heuristic::power : Heuristic::balance;
        TileMeans vcm(scene, test.camera, small, sampler);
        const MeanComparison result =
            compare(test, "mis = vcm", mis, vcm, {.detectable_bias = 0.03});
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

/// A closed room under a lamp, with surfaces as `material`.
EqualityCase room_of(const char* name, const MaterialDesc& material)
{
    SceneBuilder builder;
    builder.walls(material, material).ceiling(material).front(material);
    builder.lamp(0.6f, 0.3f, Rgb(8.0f));
    builder.sphere({0.3f, -0.6f, 0.0f}, 0.4f, material, 24);
    return {.name = name,
            .scene = std::move(builder.desc),
            .camera = camera_at({0.0f, 0.0f, 0.95f}, {0.0f, -0.3f, 0.0f}, 1.2f)};
}

}  // namespace

TEST_CASE("vcm with a small radius agrees with mis", "[equality][vcm]")
{
    check_small_radius(equality_cases(), 2, 500000);
}

TEST_CASE("vcm with a small radius agrees with mis: alpha, layers and many lights",
          "[equality][vcm]")
{
    check_small_radius(alpha_cases(), 2, 510000);
    check_small_radius(layer_cases(), 3, 520000);
    check_small_radius(many_light_cases(), 2, 540000);
    check_small_radius(normal_map_cases(), 3, 560000);
}

TEST_CASE("vcm with a small radius agrees with mis: what moves, and bodies in bodies",
          "[equality][motion][vcm]")
{
    // All pixels of a sample have one time, so samples must be evenly spread over time.
    check_small_radius(motion_cases(), 1, 530000, SamplerKind::sobol);
    check_small_radius(volume_cases(), 2, 550000, SamplerKind::sobol);
}

TEST_CASE("merging alone finds all light of two edges and more", "[equality][vcm]")
{
    SceneBuilder panes;
    MaterialDesc pane = plastic({0.2f, 0.6f, 0.8f}, 0.4f);
    pane.base_color.w = 0.5f;
    pane.alpha_mode = AlphaMode::blend;
    panes.walls(lambertian(Rgb(0.7f)), pane).ceiling(pane).lamp(0.98f, 0.7f, Rgb(4.0f));
    std::vector<EqualityCase> cases{
        room_of("diffuse", lambertian({0.7f, 0.5f, 0.4f})),
        room_of("glossy", plastic({0.7f, 0.5f, 0.4f}, 0.4f)),
        {.name = "walls that let rays pass", .scene = panes.desc, .camera = room_camera()},
        equality_cases().front()};
    std::uint64_t seed = 570000;
    for (const EqualityCase& test : cases) {
        const Scene scene(test.scene);
        TileMeans mis(scene, test.camera, options(test, IntegratorKind::mis, ++seed));
        RenderOptions merging = merging_alone(options(test, IntegratorKind::vcm, ++seed));
        merging.bidirectional.merge_radius = 0.02;
        merging.bidirectional.light_paths = 4.0;
        TileMeans vcm(scene, test.camera, merging);
        const MeanComparison result =
            compare(test, "mis = merging alone", mis, vcm, {.detectable_bias = 0.03});
        CHECK(result.sharp_enough);
        CHECK(result.greatest_bias < 0.03);
    }
}

TEST_CASE("merging is biased by its radius, and less so as that shrinks", "[vcm]")
{
    std::uint64_t seed = 580000;
    for (const EqualityCase& test : {room_of("diffuse", lambertian({0.7f, 0.5f, 0.4f})),
                                     room_of("glossy", plastic({0.7f, 0.5f, 0.4f}, 0.4f))}) {
        const Scene scene(test.scene);
        TileMeans mis(scene, test.camera, options(test, IntegratorKind::mis, ++seed));
        const auto bias = [&](double radius, double alpha) {
            RenderOptions merging = merging_alone(options(test, IntegratorKind::vcm, ++seed));
            merging.bidirectional.merge_radius = radius;
            merging.bidirectional.merge_alpha = alpha;
            TileMeans vcm(scene, test.camera, merging);
            const std::string what = "mis = merging within " + std::to_string(radius) + ", alpha " +
                                     std::to_string(alpha);
            vcm.refine(1000);  // what the first, larger radii bring must not stand out
            return compare(test, what, mis, vcm, {.detectable_bias = 0.02}).greatest_bias;
        };
        const double wide = bias(0.4, 1.0);
        const double half = bias(0.2, 1.0);
        CHECK(wide > 0.1);
        CHECK(half < 0.7 * wide);
        CHECK(half > 0.03);
        CHECK(bias(0.4, 0.2) < 0.02);
    }
}

}  // namespace bdpt::test
