// Each strategy by itself, and all ways to combine them, estimate the same integral.

#include "catch.hpp"
#include "equal_means.h"
#include "furnace.h"
#include "moving_scenes.h"
#include "scene_builder.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>
#include <utility>

namespace bdpt::test::strategies_test {
namespace {

/// Surfaces that do not touch each other: where they do, a strategy alone has no finite variance.
SceneBuilder open_stage_builder()
{
    SceneBuilder builder;
    builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1},
                 lambertian({0.8f, 0.6f, 0.4f}));
    builder.quad({-0.8f, -0.6f, -1.6f}, {0.8f, -0.6f, -1.6f}, {0.8f, 0.9f, -1.6f},
                 {-0.8f, 0.9f, -1.6f}, plastic(Rgb(0.7f), 0.6f));
    builder.sphere({0.1f, -0.2f, 0.1f}, 0.35f, lambertian({0.5f, 0.7f, 0.9f}));
    builder.lamp(1.0f, 1.1f, Rgb(4.0f, 3.5f, 3.0f));
    return builder;
}

Scene open_prepared_scene()
{
    return Scene(std::move(open_stage_builder().desc));
}

CameraDesc pinhole()
{
    return camera_at({0.0f, 0.3f, 3.6f}, {0.0f, 0.0f, 0.0f}, 0.75f);
}

/// So wide that light paths hit it.
CameraDesc thin_lens()
{
    return with_lens(pinhole(), 1.2f, 3.4f);
}

CameraDesc parallel()
{
    return in_parallel(pinhole(), 2.6f);
}

/// Options of the renders of one test, with a seed each, whatever other tests ran before.
class Options {
public:
    explicit Options(std::uint64_t first_seed) : seed_(first_seed) {}

    [[nodiscard]] RenderOptions operator()(IntegratorKind integrator, int min_depth, int max_depth)
    {
        RenderOptions result;
        result.integrator = integrator;
        result.transport.min_depth = min_depth;
        result.transport.max_depth = max_depth;
        result.sampling.seed = seed_++;
        return result;
    }

    /// Only the strategy with s light vertices makes paths of `edges` edges.
    [[nodiscard]] RenderOptions only(int s, int edges)
    {
        RenderOptions result = (*this)(IntegratorKind::bdpt, edges, edges);
        for (int other = 0; other <= edges + 1; ++other) {
            if (other != s) {
                result.bidirectional.disabled.push_back({.s = other, .t = edges + 1 - other});
            }
        }
        return result;
    }

private:
    std::uint64_t seed_;
};

void check_equal(const std::string& what, TileMeans& a, TileMeans& b, double detectable_bias)
{
    const MeanComparison result = compare_means(a, b, {.detectable_bias = detectable_bias});
    INFO(what << ": " << result.text());
    CHECK(result.sharp_enough);
    CHECK(result.equal);
    if (std::getenv("BDPT_TEST_VERBOSE") != nullptr) {
        std::cout << what << ": " << result.text() << "\n";
    }
}

/// All strategies for paths of one length against path tracing with both kinds of sampling.
void check_each_strategy(Options& options, const Scene& scene, const CameraDesc& camera, int edges,
                         int last_s, double detectable_bias = 0.06)
{
    TileMeans reference(scene, camera, options(IntegratorKind::mis, edges, edges));
    for (int s = 0; s <= last_s; ++s) {
        TileMeans alone(scene, camera, options.only(s, edges));
        check_equal("s = " + std::to_string(s) + " of " + std::to_string(edges) + " edges",
                    reference, alone, detectable_bias);
    }
}

}  // namespace

TEST_CASE("each strategy alone, pinhole", "[strategies][long]")
{
    Options options(41000);
    const Scene scene = open_prepared_scene();
    for (const int edges : {1, 2, 3}) {
        check_each_strategy(options, scene, pinhole(), edges, edges);
    }
}

TEST_CASE("each strategy alone, with connections that are chosen", "[strategies][long]")
{
    Options options(49000);
    const Scene scene = open_prepared_scene();
    for (const auto& [s, edges] : {std::pair(2, 3), std::pair(2, 4), std::pair(3, 4)}) {
        TileMeans reference(scene, pinhole(), options(IntegratorKind::mis, edges, edges));
        RenderOptions alone = options.only(s, edges);
        alone.bidirectional.light_paths = 0.25;
        alone.bidirectional.connections = 6.0;
        alone.bidirectional.connection_rays = 4.0;
        TileMeans chosen(scene, pinhole(), alone);
        check_equal("s = " + std::to_string(s) + " of " + std::to_string(edges) + " edges",
                    reference, chosen, 0.06);
    }
}

TEST_CASE("lights are as bright where few pixels connect them to the lens", "[strategies]")
{
    // So small that camera paths hardly ever hit it.
    SceneBuilder builder;
    constexpr float side = 1e-4f;
    builder.quad({0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}, emitter(Rgb(1e6f)));
    const Scene scene(std::move(builder.desc));
    Options options(62000);
    // The columns and rows of these pixels do not divide the image's.
    const auto brightness_by = [&](double looks) {
        RenderOptions few = options(IntegratorKind::bdpt, 1, 1);
        few.film.width = 33;
        few.film.height = 17;
        few.sampling.samples = {0, 8192};
        few.bidirectional.light_paths = 0.5;
        few.bidirectional.visible_light_samples = looks;
        const Image image = render(scene, pinhole(), few).film.develop();
        double sum = 0.0;
        for (const Rgb& pixel : image.pixels) {
            sum += static_cast<double>(pixel.g);
        }
        return sum;
    };
    const double all = brightness_by(1.0);
    CHECK(brightness_by(1.0 / 1024.0) == Approx(all).epsilon(0.05));
    CHECK(brightness_by(1.0 / 4096.0) == Approx(all).epsilon(0.1));
}

TEST_CASE("each strategy alone, many lights", "[strategies][tree][long]")
{
    Options options(42000);
    // The same stage under nine panels, some of which face up or to both sides.
    SceneBuilder builder;
    builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, lambertian(Rgb(0.7f)));
    builder.sphere({0.1f, -0.2f, 0.1f}, 0.35f, lambertian({0.5f, 0.7f, 0.9f}));
    for (int i = 0; i < 9; ++i) {
        const Vec3 p(0.8f * static_cast<float>(i % 3 - 1), 1.0f,
                     0.8f * static_cast<float>(i / 3 - 1));
        const float h = i == 4 ? -0.38f : 0.38f;
        MaterialDesc panel = emitter({4.0f, 3.5f, 3.0f});
        panel.double_sided = i == 7;
        builder.quad(p + Vec3(-h, 0.0f, -0.38f), p + Vec3(h, 0.0f, -0.38f),
                     p + Vec3(h, 0.0f, 0.38f), p + Vec3(-h, 0.0f, 0.38f), panel);
    }
    const Scene scene(std::move(builder.desc));
    check_each_strategy(options, scene, pinhole(), 2, 2, 0.08);
}

TEST_CASE("each strategy alone, thin lens: t = 0 as well", "[strategies][long]")
{
    Options options(43000);
    const Scene scene = open_prepared_scene();
    for (const int edges : {1, 2}) {
        check_each_strategy(options, scene, thin_lens(), edges, edges + 1);
    }
}

TEST_CASE("each strategy alone, in a body that absorbs", "[strategies]")
{
    // All of the stage and the wide lens are inside: light on its way to a lens that it hits is
    // absorbed like any other.
    SceneBuilder builder = open_stage_builder();
    MaterialDesc tinted = glass(0.0f);
    tinted.ior = 1.0f;
    tinted.attenuation_color = {0.4f, 0.6f, 0.8f};
    tinted.attenuation_distance = 3.0f;
    builder.cube(Vec3(0.0f), 6.0f, tinted);
    const Scene scene(std::move(builder.desc));
    Options options(61000);
    TileMeans reference(scene, thin_lens(), options(IntegratorKind::mis, 2, 2));
    for (const int s : {1, 2, 3}) {
        TileMeans alone(scene, thin_lens(), options.only(s, 2));
        check_equal("s = " + std::to_string(s) + " of 2 edges", reference, alone, 0.25);
    }
}

TEST_CASE("each strategy alone, in fog", "[strategies][media][long]")
{
    // Joins of vertices in a medium, which may be as close as they like, have no finite variance by
    // themselves. The lamp has the colour that the fog takes away most, so that walks from it and
    // from the lens choose different channels for their distances.
    SceneBuilder builder = open_stage_builder();
    builder.desc.instances.pop_back();
    builder.lamp(1.0f, 1.1f, Rgb(0.0f, 1.0f, 12.0f));
    builder.desc.fog = MediumDesc{
        .extinction = {0.1f, 0.2f, 0.3f}, .albedo = {0.9f, 0.8f, 0.7f}, .anisotropy = 0.3f};
    const Scene scene(std::move(builder.desc));
    Options options(64000);
    for (const int edges : {1, 2}) {
        TileMeans reference(scene, thin_lens(), options(IntegratorKind::mis, edges, edges));
        for (const int s : {0, 1, edges + 1}) {
            TileMeans alone(scene, thin_lens(), options.only(s, edges));
            check_equal("s = " + std::to_string(s) + " of " + std::to_string(edges) + " edges",
                        reference, alone, 0.1);
        }
    }
}

TEST_CASE("each strategy alone, in a volume that colours light", "[strategies][media][long]")
{
    // The means of all channels would agree if one strategy took the volume for grey, so the lamp
    // is blue, which the volume takes away most.
    SceneBuilder builder = open_stage_builder();
    builder.desc.instances.pop_back();
    builder.lamp(1.0f, 1.1f, Rgb(0.0f, 0.0f, 12.0f));
    builder.desc.volumes.push_back(
        {.size = {1, 1, 1},
         .density = {1.0f},
         .world_from_grid = glm::scale(glm::translate(Mat4(1.0f), Vec3(-4.0f)), Vec3(8.0f)),
         .extinction = {0.0f, 0.1f, 0.3f},
         .albedo = Rgb(0.0f)});
    const Scene scene(std::move(builder.desc));
    Options options(65000);
    for (const int edges : {1, 2}) {
        TileMeans reference(scene, thin_lens(), options(IntegratorKind::mis, edges, edges));
        for (const int s : {0, 1, edges + 1}) {
            TileMeans alone(scene, thin_lens(), options.only(s, edges));
            check_equal("s = " + std::to_string(s) + " of " + std::to_string(edges) + " edges",
                        reference, alone, 0.15);
        }
    }
}

TEST_CASE("each strategy alone makes long paths as bright as they are", "[strategies]")
{
    // In a furnace paths of k edges bring Le a^(k - 1) [nit].
    const Rgb albedo(0.9f, 0.8f, 0.7f);
    const Scene scene = furnace_sphere(Rgb(1.0f), albedo);
    const CameraDesc inside = camera_at({0.1f, 0.0f, 0.3f}, {0.0f, 0.1f, -1.0f}, 0.9f);
    Options options(62000);
    for (const int edges : {5, 6}) {
        double expected = 0.0;
        for (int c = 0; c < 3; ++c) {
            expected += std::pow(static_cast<double>(albedo[c]), edges - 1) / 3.0;
        }
        // Those with three vertices and more on each side.
        for (int s = 3; s <= edges - 2; ++s) {
            RenderOptions only = options.only(s, edges);
            only.sampling.lights = LightSampling::power;  // all triangles are as bright
            TileMeans alone(scene, inside, only);
            const MeanComparison result = compare_means(alone, expected, {.detectable_bias = 0.03});
            INFO("s = " << s << " of " << edges << " edges: " << result.text());
            CHECK(result.sharp_enough);
            CHECK(result.equal);
        }
    }
}

TEST_CASE("a join refracts each channel as if there were no other", "[strategies][long]")
{
    // A floor in a rough block of glass, seen from within, under a small lamp, which seems the
    // farther away the smaller the index is: 1.25 of red, around 1.5.
    const auto block_under = [](Rgb light, float ior, float dispersion) {
        MaterialDesc material = glass(0.5f);
        material.ior = ior;
        material.dispersion = dispersion;
        SceneBuilder builder;
        builder.quad({-0.8f, -0.6f, 0.8f}, {0.8f, -0.6f, 0.8f}, {0.8f, -0.6f, -0.8f},
                     {-0.8f, -0.6f, -0.8f}, lambertian(Rgb(0.8f)));
        builder.cube(Vec3(0.0f), 1.0f, material);
        builder.lamp(1.3f, 0.3f, light);
        return Scene(std::move(builder.desc));
    };
    const CameraDesc within = camera_at({0.0f, 0.3f, 0.6f}, {0.0f, -0.6f, 0.0f}, 0.6f);
    Options options(63000);
    const Scene alone = block_under(Rgb(20, 0, 0), 1.25f, 0.0f);
    const Scene dispersing = block_under(Rgb(20, 0, 0), 1.5f, 20.0f);
    TileMeans expected(alone, within, options(IntegratorKind::mis, 3, 3));
    // Joined between the floor and the glass, where only the light path has met it.
    TileMeans found(dispersing, within, options.only(2, 3));
    check_equal("s = 2 of 3 edges", expected, found, 0.15);
}

TEST_CASE("each strategy alone, orthographic", "[strategies]")
{
    Options options(44000);
    const Scene scene = open_prepared_scene();
    // What else it sees of the lamp is its dark side.
    const CameraDesc at_lamp =
        in_parallel(camera_at({0.0f, 0.35f, 0.9f}, {0.0f, 1.0f, 0.0f}, 0.75f), 0.4f);
    check_each_strategy(options, scene, at_lamp, 1, 0);
    check_each_strategy(options, scene, parallel(), 2, 2);
}

TEST_CASE("each strategy alone, all of it moving", "[strategies][motion][long]")
{
    Options options(45000);
    SceneBuilder builder;
    builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1},
                 lambertian({0.8f, 0.6f, 0.4f}));
    move_last(builder, 2, [](float t) {
        return glm::rotate(translation({0.0f, 0.2f * t, 0.0f}), 0.5f * t, Vec3(0.0f, 0.0f, 1.0f));
    });
    builder.sphere({0.1f, -0.1f, 0.1f}, 0.35f, lambertian({0.5f, 0.7f, 0.9f}), 24);
    deform(builder.desc.meshes.back(), 3,
           [](Vec3 p, float t) { return Vec3(p.x * (1.0f + 0.5f * t), p.y + 0.5f * t, p.z); });
    builder.lamp(1.0f, 1.1f, Rgb(4.0f, 3.5f, 3.0f));
    move_last(builder, 4, [](float t) {
        return glm::scale(glm::rotate(translation({0.4f * t, 0.0f, 0.0f}), 0.9f * t - 0.4f,
                                      Vec3(0.0f, 0.0f, 1.0f)),
                          Vec3(0.6f + 0.5f * t, 1.0f, 1.0f));
    });
    const Scene scene(std::move(builder.desc));
    const CameraDesc lens = moving(thin_lens());
    constexpr double bias = 0.1;
    check_each_strategy(options, scene, lens, 1, 2, bias);
    check_each_strategy(options, scene, lens, 2, 2, bias);
    TileMeans reference(scene, lens, options(IntegratorKind::mis, 3, 3));
    TileMeans joined(scene, lens, options.only(2, 3));
    check_equal("s = 2 of 3 edges", reference, joined, bias);
    check_each_strategy(options, scene, moving(parallel()), 2, 2, bias);
}

TEST_CASE("all integrators agree through all cameras", "[strategies][long]")
{
    Options options(46000);
    const Scene scene = open_prepared_scene();
    for (const CameraDesc& camera : {pinhole(), thin_lens(), parallel()}) {
        TileMeans mis(scene, camera, options(IntegratorKind::mis, 2, 4));
        for (const auto kind :
             {IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::lt, IntegratorKind::bdpt}) {
            TileMeans other(scene, camera, options(kind, 2, 4));
            check_equal("mis = integrator " + std::to_string(static_cast<int>(kind)), mis, other,
                        0.05);
        }
    }
}

TEST_CASE("light seen directly: s = t = 1 and hits share it", "[strategies]")
{
    Options options(47000);
    const Scene scene = open_prepared_scene();
    const CameraDesc up = camera_at({0.0f, -0.5f, 0.8f}, {0.0f, 1.0f, 0.0f}, 0.9f);
    TileMeans mis(scene, up, options(IntegratorKind::mis, 1, 1));
    TileMeans bdpt(scene, up, options(IntegratorKind::bdpt, 1, 1));
    TileMeans lt(scene, up, options(IntegratorKind::lt, 1, 1));
    check_equal("mis = bdpt", mis, bdpt, 0.02);
    check_equal("mis = lt", mis, lt, 0.02);
}

TEST_CASE("heuristics, more light paths and roulette change noise only", "[strategies][long]")
{
    Options options(48000);
    const Scene scene = open_prepared_scene();
    const CameraDesc camera = thin_lens();
    TileMeans mis(scene, camera, options(IntegratorKind::mis, 1, 4));
    for (const auto heuristic :
         {Heuristic::balance, Heuristic::cutoff, Heuristic::maximum, Heuristic::uniform}) {
        RenderOptions with = options(IntegratorKind::bdpt, 1, 4);
        with.transport.heuristic = heuristic;
        // Equal shares take the worst strategies as seriously as the best.
        const double sharpness = heuristic == Heuristic::uniform ? 0.06 : 0.03;
        TileMeans bdpt(scene, camera, with);
        check_equal("bdpt, heuristic " + std::to_string(static_cast<int>(heuristic)), mis, bdpt,
                    sharpness);
        with.integrator = IntegratorKind::mis;
        with.sampling.seed += 500;
        TileMeans path(scene, camera, with);
        check_equal("mis, heuristic " + std::to_string(static_cast<int>(heuristic)), mis, path,
                    sharpness);
    }
    RenderOptions many = options(IntegratorKind::bdpt, 1, 4);
    many.bidirectional.light_paths = 3;
    TileMeans three(scene, camera, many);
    check_equal("three light paths", mis, three, 0.03);
    for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::mis, IntegratorKind::lt}) {
        RenderOptions roulette = options(kind, kind == IntegratorKind::lt ? 2 : 1, 4);
        RenderOptions without = options(IntegratorKind::mis, roulette.transport.min_depth, 4);
        roulette.transport.rr_start = 1;
        TileMeans ended(scene, camera, roulette);
        TileMeans reference(scene, camera, without);
        check_equal("roulette", reference, ended, 0.03);
    }
}

TEST_CASE("strategies that are left out are made up for by the others", "[strategies][long]")
{
    Options options(49000);
    const Scene scene = open_prepared_scene();
    const CameraDesc camera = thin_lens();
    TileMeans mis(scene, camera, options(IntegratorKind::mis, 1, 4));
    RenderOptions fewer = options(IntegratorKind::bdpt, 1, 4);
    fewer.bidirectional.disabled = {
        {.s = 1, .t = 2}, {.s = 2, .t = 1}, {.s = 0, .t = 4}, {.s = 1, .t = 1}};
    TileMeans without(scene, camera, fewer);
    check_equal("four strategies left out", mis, without, 0.03);
    RenderOptions shallow = options(IntegratorKind::bdpt, 1, 4);
    shallow.bidirectional.max_camera_depth = 3;
    shallow.bidirectional.max_light_depth = 1;
    TileMeans limited(scene, camera, shallow);
    check_equal("short subpaths", mis, limited, 0.03);
    RenderOptions no_light_paths = options(IntegratorKind::bdpt, 1, 4);
    no_light_paths.bidirectional.max_light_depth = 0;
    TileMeans path_tracing(scene, camera, no_light_paths);
    check_equal("no light paths", mis, path_tracing, 0.03);
}

}  // namespace bdpt::test::strategies_test
