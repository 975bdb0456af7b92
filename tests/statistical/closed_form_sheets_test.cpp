// What clear sheets let pass, known on paper.

#include "catch.hpp"
#include "equal_means.h"
#include "scene_builder.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt::test::closed_form_sheets_test {
namespace {

/// The reflectance of glass, after Snell and Fresnel.
double reflectance(double cosine, double ior)
{
    const double outer = std::acos(cosine);
    const double inner = std::asin(std::sin(outer) / ior);
    const double s = std::sin(outer - inner) / std::sin(outer + inner);
    const double p = std::tan(outer - inner) / std::tan(outer + inner);
    return 0.5 * (s * s + p * p);
}

RenderOptions options(IntegratorKind integrator)
{
    RenderOptions result;
    result.integrator = integrator;
    result.transport.max_depth = 2;  // passing a sheet is no edge
    return result;
}

MaterialDesc sheet(float tint)
{
    MaterialDesc material = thin_glass(0.0f);
    material.base_color = {tint, tint, tint, 1.0f};
    return material;
}

}  // namespace

TEST_CASE("light samples reach a floor under a clear sheet, which is seen through it",
          "[closed-form][sheet][long]")
{
    constexpr float albedo = 0.8f;
    constexpr float tint = 0.7f;
    constexpr float illuminance = 5.0f;
    const Vec3 to_sun = normalize(Vec3(0.9f, 0.3f, 1.0f));
    const Vec3 to_eye = normalize(Vec3(-1.1f, 0.6f, 1.0f));
    SceneBuilder builder;
    builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, lambertian(Rgb(albedo)));
    builder.quad({-3, -3, 1}, {3, -3, 1}, {3, 3, 1}, {-3, 3, 1}, sheet(tint));
    builder.light(DirectionalLightDesc{.direction = -to_sun, .illuminance = Rgb(illuminance)});
    const Scene scene(std::move(builder.desc));
    const CameraDesc camera = in_parallel(camera_at(4.0f * to_eye, Vec3(0.0f), 0.5f), 1.0f);
    const auto ior = static_cast<double>(thin_glass(0.0f).ior);
    const auto passes = [&](Vec3 direction) {
        return static_cast<double>(tint) *
               (1.0 - reflectance(static_cast<double>(direction.z), ior));
    };
    const double floor = static_cast<double>(albedo * illuminance * to_sun.z) / M_PI;
    for (const auto kind : {IntegratorKind::nee, IntegratorKind::mis, IntegratorKind::lt,
                            IntegratorKind::bdpt, IntegratorKind::vcm}) {
        TileMeans means(scene, camera, options(kind));
        const bool is_noisy = kind == IntegratorKind::lt || kind == IntegratorKind::vcm;
        const MeanComparison result = compare_means(means, floor * passes(to_sun) * passes(to_eye),
                                                    {.detectable_bias = is_noisy ? 0.04 : 0.01});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

TEST_CASE("light paths that reach the lens itself have the tint of the sheets that they pass",
          "[closed-form][sheet][long]")
{
    // A mirror that shows a lamp behind the camera: light paths find it by hitting the lens.
    constexpr float tint = 0.6f;
    SceneBuilder builder;
    MaterialDesc pane = sheet(tint);
    pane.specular = 0.0f;
    builder.quad({-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}, metal(Rgb(1.0f), 0.0f));
    builder.quad({-9, -9, 1}, {9, -9, 1}, {9, 9, 1}, {-9, 9, 1}, pane);
    constexpr float r = 0.8f;
    builder.quad({-r, -r, 4}, {-r, r, 4}, {r, r, 4}, {r, -r, 4}, emitter(Rgb(3.0f)));
    const Scene scene(std::move(builder.desc));
    const CameraDesc camera =
        with_lens(camera_at({0.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 0.2f), 1.0f, 7.0f);
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::lt}) {
        TileMeans means(scene, camera, options(kind));
        const MeanComparison result = compare_means(means, static_cast<double>(3.0f * tint * tint),
                                                    {.detectable_bias = 0.05});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

TEST_CASE("a clear sheet in a white furnace is invisible, alone or as a box",
          "[closed-form][sheet]")
{
    SceneBuilder builder;
    builder.quad({-1, -1, 0.2f}, {1, -1, 0.2f}, {1, 1, 0}, {-1, 1, 0}, sheet(1.0f));
    builder.cube({0.2f, 0.1f, -0.6f}, 0.4f, sheet(1.0f));
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(2)}}});
    const Scene scene(std::move(builder.desc));
    const CameraDesc camera = camera_at({0.3f, 0.5f, 4.0f}, {0.0f, 0.0f, 0.0f}, 0.4f);
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt}) {
        RenderOptions deep = options(kind);
        deep.transport.max_depth = 40;
        TileMeans means(scene, camera, deep);
        const MeanComparison result = compare_means(means, 2.0, {.detectable_bias = 0.01});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

}  // namespace bdpt::test::closed_form_sheets_test
