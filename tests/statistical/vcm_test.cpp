// Vertex connection and merging is biased by its radius: with a small one it agrees with mis, as
// all integrators do; with a large one it does not, and the less so the more the radius shrinks.

#include "catch.hpp"
#include "equal_means.h"
#include "equality_cases.h"
#include "scene_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::test::vcm_test {
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
        small.bidirectional.light_paths = i / step % 3 == 0 ? 0.5 : 1.0;
        small.transport.heuristic = i / step % 2 == 0 ? Heuristic::power : Heuristic::balance;
        TileMeans vcm(scene, test.camera, small, sampler);
        const MeanComparison result =
            compare(test, "mis = vcm", mis, vcm, {.detectable_bias = 0.04});
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

TEST_CASE("vcm with a small radius agrees with mis", "[equality][vcm][long]")
{
    check_small_radius(equality_cases(), 3, 500000);
}

TEST_CASE("vcm with a small radius agrees with mis: alpha, layers and many lights",
          "[equality][vcm][long]")
{
    check_small_radius(alpha_cases(), 2, 510000);
    check_small_radius(layer_cases(), 3, 520000);
    check_small_radius(many_light_cases(), 2, 540000);
    check_small_radius(volume_cases(), 3, 550000);
    check_small_radius(normal_map_cases(), 3, 560000);
}

TEST_CASE("vcm with a small radius agrees with mis: media", "[equality][media][vcm][long]")
{
    check_small_radius(media_cases(), 2, 590000);
}

TEST_CASE("vcm with a small radius agrees with mis: what moves", "[equality][motion][vcm]")
{
    // All pixels of a sample have one time, so samples must be evenly spread over time.
    check_small_radius({motion_cases()[2]}, 1, 530000, SamplerKind::sobol);
}

TEST_CASE("merging alone finds all light of two edges and more", "[equality][vcm][long]")
{
    SceneBuilder panes;
    MaterialDesc pane = plastic({0.2f, 0.6f, 0.8f}, 0.4f);
    pane.base_color.w = 0.5f;
    pane.alpha_mode = AlphaMode::blend;
    panes.walls(lambertian(Rgb(0.7f)), pane).ceiling(pane).lamp(0.98f, 0.7f, Rgb(4.0f));
    std::vector<EqualityCase> cases{
        room_of("diffuse", lambertian({0.7f, 0.5f, 0.4f})),
        room_of("glossy", plastic({0.7f, 0.5f, 0.4f}, 0.4f)),
        {.name = "walls that let rays pass", .scene = panes.desc, .camera = room_camera()}};
    std::uint64_t seed = 570000;
    for (const EqualityCase& test : cases) {
        const Scene scene(test.scene);
        TileMeans mis(scene, test.camera, options(test, IntegratorKind::mis, ++seed));
        RenderOptions merging = merging_alone(options(test, IntegratorKind::vcm, ++seed));
        merging.bidirectional.merge_radius = 0.02;
        merging.bidirectional.light_paths = 4.0;
        TileMeans vcm(scene, test.camera, merging);
        const MeanComparison result =
            compare(test, "mis = merging alone", mis, vcm, {.detectable_bias = 0.05});
        CHECK(result.sharp_enough);
        CHECK(result.max_bias < 0.05);
    }
}

TEST_CASE("merging is biased by its radius, and less so as that shrinks", "[vcm][long]")
{
    // Light does not arrive beyond the edges of a plate, where the disk of merging does: of a
    // square of side 2 that is 4 / 2 * 2 / (3 pi) of the radius, if that is small.
    std::uint64_t seed = 580000;
    for (const MaterialDesc& material :
         {lambertian({0.7f, 0.5f, 0.4f}), plastic({0.7f, 0.5f, 0.4f}, 0.4f)}) {
        SceneBuilder builder;
        builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, material);
        builder.light(
            DirectionalLightDesc{.direction = {0.2f, -0.3f, -1.0f}, .illuminance = Rgb(1.0f)});
        const EqualityCase test{
            .name = "plate",
            .scene = std::move(builder.desc),
            .camera = in_parallel(camera_at({0.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 0.7f), 2.0f),
            .max_depth = 2};
        const Scene scene(test.scene);
        TileMeans mis(scene, test.camera, options(test, IntegratorKind::mis, ++seed));
        mis.refine_to(100);
        const auto bias = [&](double radius, double alpha) {
            RenderOptions merging = merging_alone(options(test, IntegratorKind::vcm, ++seed));
            merging.bidirectional.merge_radius = radius / std::sqrt(2.0);  // of the sphere
            merging.bidirectional.merge_alpha = alpha;
            TileMeans vcm(scene, test.camera, merging);
            vcm.refine_to(200);
            double found = 0.0;
            double expected = 0.0;
            double variance = 0.0;
            for (std::size_t i = 0; i < TileMeans::cells; ++i) {
                found += vcm.cell_moments()[i].mean();
                expected += mis.cell_moments()[i].mean();
                variance += std::pow(vcm.cell_moments()[i].standard_error(), 2);
            }
            if (std::getenv("BDPT_TEST_VERBOSE") != nullptr) {
                std::cout << "plate within " << radius << ", alpha " << alpha << ": "
                          << found / expected - 1.0 << " +- " << std::sqrt(variance) / expected
                          << "\n";
            }
            CHECK(std::sqrt(variance) < 0.01 * expected);
            return found / expected - 1.0;
        };
        const double edge = -4.0 / (3.0 * 3.14159265);
        CHECK(bias(0.2, 1.0) == Approx(0.2 * edge).margin(0.02));
        CHECK(bias(0.1, 1.0) == Approx(0.1 * edge).margin(0.02));
        // The mean of i^-0.4 for i up to 200.
        CHECK(bias(0.2, 0.2) == Approx(0.2 * 0.2 * edge).margin(0.02));
        CHECK(std::abs(bias(0.02, 1.0)) < 0.02);
    }
}

}  // namespace bdpt::test::vcm_test
