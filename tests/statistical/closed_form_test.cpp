// Renders whose result is known on paper.

#include "catch.hpp"
#include "equal_means.h"
#include "furnace.h"
#include "scene_builder.h"

#include <cmath>
#include <tuple>
#include <utility>

namespace bdpt::test::closed_form_test {
namespace {

const Rgb albedo(0.2f, 0.5f, 0.8f);
const Rgb emitted(1.0f, 0.7f, 0.3f);

double average(Rgb color)
{
    return static_cast<double>(color.r + color.g + color.b) / 3.0;
}

RenderOptions options(IntegratorKind integrator, int max_depth)
{
    RenderOptions result;
    result.integrator = integrator;
    result.transport.max_depth = max_depth;
    return result;
}

/// A closed box whose walls all emit and reflect alike, seen from inside.
Scene furnace_room()
{
    const MaterialDesc wall = emitter(emitted, albedo);
    SceneBuilder builder;
    builder.walls(wall, wall).ceiling(wall).front(wall);
    return Scene(std::move(builder.desc));
}

}  // namespace

TEST_CASE("closed Lambertian furnace: L = Le (1 - a^k) / (1 - a)", "[closed-form][long]")
{
    const Scene scene = furnace_room();
    const CameraDesc camera = camera_at({0.3f, 0.1f, 0.6f}, {-0.2f, -0.1f, -1.0f}, 1.2f);
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt}) {
        for (const int k : {1, 2, 4, 7}) {
            Rgb expected;
            for (int c = 0; c < 3; ++c) {
                expected[c] = emitted[c] * (1.0f - std::pow(albedo[c], static_cast<float>(k))) /
                              (1.0f - albedo[c]);
            }
            TileMeans means(scene, camera, options(kind, k));
            const MeanComparison result =
                compare_means(means, average(expected), {.detectable_bias = 0.003});
            INFO("integrator " << static_cast<int>(kind) << ", " << k
                               << " edges: " << result.text());
            CHECK(result.sharp_enough);
            CHECK(result.equal);
        }
    }
}

TEST_CASE("roulette keeps the light of dark surfaces", "[closed-form][roulette]")
{
    // A closed room that reflects so little that hardly any walk goes on: paths of k edges bring Le
    // a^(k - 1). The survivors of one decision make all of the image.
    const Rgb dark(0.02f, 0.01f, 0.015f);
    const Scene scene = furnace_sphere(emitted, dark);
    const CameraDesc camera = camera_at({0.1f, 0.0f, 0.3f}, {0.0f, 0.1f, -1.0f}, 0.9f);
    for (const auto& [kind, edges, survival] :
         {std::tuple(IntegratorKind::pt, 3, 0.0f), std::tuple(IntegratorKind::nee, 3, 0.0f),
          std::tuple(IntegratorKind::mis, 3, 0.0f), std::tuple(IntegratorKind::bdpt, 3, 0.0f),
          std::tuple(IntegratorKind::lt, 3, 0.0f), std::tuple(IntegratorKind::mis, 3, 0.5f),
          std::tuple(IntegratorKind::bdpt, 3, 0.5f)}) {
        RenderOptions o = options(kind, edges);
        o.transport.min_depth = edges;
        o.transport.rr_start = 1;
        o.transport.rr_survival = survival;
        o.sampling.lights = LightSampling::power;  // all triangles are as bright
        Rgb expected = emitted;
        for (int i = 1; i < edges; ++i) {
            expected *= dark;
        }
        TileMeans means(scene, camera, o);
        const MeanComparison result =
            compare_means(means, average(expected), {.detectable_bias = 0.25});
        INFO("integrator " << static_cast<int>(kind) << ", " << edges << " edges, least survival "
                           << survival << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

TEST_CASE("point light: L = albedo I cos / (pi r^2)", "[closed-form]")
{
    // A small patch right below the light is seen by a narrow camera, so the radiance is constant
    // over the film to a part in a thousand.
    constexpr float height = 2.0f;
    SceneBuilder builder;
    builder.quad({-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5}, lambertian(albedo));
    builder.light(PointLightDesc{.position = {0.0f, height, 0.0f}, .intensity = Rgb(100.0f)});
    const Scene scene(std::move(builder.desc));
    const CameraDesc camera = camera_at({3.0f, 3.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.02f);
    const Rgb expected = albedo * (100.0f / (3.14159265f * height * height));
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt}) {
        TileMeans means(scene, camera, options(kind, 2));
        const MeanComparison result =
            compare_means(means, average(expected), {.detectable_bias = 0.01, .max_batches = 64});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.max_bias < 2e-3);
    }
}

TEST_CASE("sun: L = albedo E cos / pi", "[closed-form]")
{
    SceneBuilder builder;
    builder.quad({-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5}, lambertian(albedo));
    builder.light(
        DirectionalLightDesc{.direction = {0.6f, -0.8f, 0.0f}, .illuminance = Rgb(1000.0f)});
    const Scene scene(std::move(builder.desc));
    const CameraDesc camera = camera_at({0.0f, 3.0f, 2.0f}, {0.0f, 0.0f, 0.0f}, 0.5f);
    const Rgb expected = albedo * (1000.0f * 0.8f / 3.14159265f);
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt}) {
        TileMeans means(scene, camera, options(kind, 2));
        const MeanComparison result =
            compare_means(means, average(expected), {.detectable_bias = 0.01, .max_batches = 64});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.max_bias < 2e-3);
    }
}

TEST_CASE("a clear glass sphere in a white furnace is invisible", "[closed-form]")
{
    SceneBuilder builder;
    builder.sphere({0.0f, 0.0f, 0.0f}, 1.0f, glass(0.0f));
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(2)}}});
    const Scene scene(std::move(builder.desc));
    const CameraDesc camera = camera_at({0.0f, 0.0f, 4.0f}, {0.0f, 0.0f, 0.0f}, 0.4f);
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt}) {
        TileMeans means(scene, camera, options(kind, 60));
        const MeanComparison result =
            compare_means(means, 2.0, {.detectable_bias = 0.01, .max_batches = 256});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.max_bias < 2e-3);
    }
}

}  // namespace bdpt::test::closed_form_test
