// Media whose light is known on paper.

#include "catch.hpp"
#include "equal_means.h"
#include "scene_builder.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <utility>

namespace bdpt::test::closed_form_media_test {
namespace {

constexpr double pi_double = 3.14159265358979323846;

void check_mean(const Scene& scene, const CameraDesc& camera, const RenderOptions& options,
                double expected, double detectable_bias)
{
    TileMeans means(scene, camera, options);
    const MeanComparison result =
        compare_means(means, expected, {.detectable_bias = detectable_bias});
    INFO("integrator " << static_cast<int>(options.integrator) << ": " << result.text());
    CHECK(result.sharp_enough);
    // Without any noise the width of a pixel would show.
    CHECK(result.found_bias < 2e-4);
}

RenderOptions options(IntegratorKind integrator, int max_depth)
{
    RenderOptions result;
    result.integrator = integrator;
    result.transport.max_depth = max_depth;
    return result;
}

}  // namespace

TEST_CASE("what a slab lets through: L = Le exp(-sigma d)", "[closed-form][media]")
{
    SceneBuilder builder;
    builder.quad({-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}, emitter(Rgb(2.0f), Rgb(0.0f)));
    builder.desc.fog = MediumDesc{.extinction = {0.3f, 0.6f, 1.2f}, .albedo = Rgb(0.0f)};
    const CameraDesc camera = camera_at({0, 0, 2}, {0, 0, 0}, 0.02f);
    const double expected = 2.0 * (std::exp(-0.6) + std::exp(-1.2) + std::exp(-2.4)) / 3.0;
    const Scene absorbing(builder.desc);
    // Where it scatters, one edge has still the same light.
    builder.desc.fog->albedo = Rgb(0.9f);
    const Scene scattering(std::move(builder.desc));
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt}) {
        check_mean(absorbing, camera, options(kind, 4), expected, 0.01);
        check_mean(scattering, camera, options(kind, 1), expected, 0.02);
    }
}

TEST_CASE("fog that absorbs nothing under an even sky is not seen", "[closed-form][media]")
{
    // Whatever its colour: no wavelength is preferred. Nothing but fog, in a sphere of radius 1;
    // one path in ten thousand is longer than 40 edges.
    SceneBuilder builder;
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1)}}});
    builder.desc.fog = MediumDesc{.extinction = {0.3f, 0.7f, 1.4f}, .anisotropy = 0.5f};
    const Scene scene(std::move(builder.desc));
    const CameraDesc camera = camera_at({0.2f, 0.1f, 0.5f}, {0.0f, 0.0f, -1.0f}, 1.2f);
    for (const auto kind :
         {IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::mis, IntegratorKind::bdpt}) {
        RenderOptions o = options(kind, 40);
        if (kind == IntegratorKind::bdpt) {
            o.transport.max_depth = 16;
        }
        check_mean(scene, camera, o, 1.0, 0.02);
    }
}

TEST_CASE("a volume of even density is a medium", "[closed-form][media][long]")
{
    SceneBuilder fog;
    fog.light(EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1)}}});
    VolumeDesc volume;
    volume.size = {6, 6, 6};
    volume.density.assign(216, 0.7f);
    volume.world_from_grid = glm::translate(Mat4(1.0f), Vec3(-3.0f));
    volume.extinction = {0.5f, 1.0f, 1.5f};
    volume.anisotropy = 0.5f;
    fog.desc.volumes.push_back(volume);
    fog.desc.volumes.front().albedo = Rgb(0.0f);
    const Scene black(fog.desc);
    // Thinner, as long paths of other colours than white have no end of noise.
    fog.desc.volumes.front().albedo = Rgb(1.0f);
    fog.desc.volumes.front().extinction *= 0.5f;
    const Scene white(std::move(fog.desc));
    const CameraDesc camera = camera_at({0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -1.0f}, 0.002f);
    // Half a voxel on the border goes linearly to half of the density.
    const double depth = 0.7 * (2.5 + 0.5 * 0.75);
    const double through =
        (std::exp(-0.5 * depth) + std::exp(-depth) + std::exp(-1.5 * depth)) / 3.0;
    for (const auto kind :
         {IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::mis, IntegratorKind::bdpt}) {
        check_mean(black, camera, options(kind, 3), through, 0.02);
        check_mean(white, camera, options(kind, kind == IntegratorKind::bdpt ? 16 : 40), 1.0, 0.02);
    }
}

TEST_CASE("single scattering of a point light", "[closed-form][media][long]")
{
    // In a sphere of radius 1 around the origin, along the z axis, seen from +z. One number for
    // all channels, as the scattering is white.
    const double extinction = 0.8;
    const double albedo = 0.75;
    for (const double g : {-0.4, 0.0, 0.7}) {
        const glm::dvec3 lamp(0.45, 0.2, 0.1);
        double expected = 0.0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            const glm::dvec3 x(0.0, 0.0, 2.0 * (i + 0.5) / steps - 1.0);
            const double d = glm::distance(x, lamp);
            const double cosine = dot((x - lamp) / d, glm::dvec3(0.0, 0.0, 1.0));
            const double phase =
                (1.0 - g * g) / (4.0 * pi_double * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
            expected += 2.0 / steps * extinction * albedo * phase * 3.0 / (d * d) *
                        std::exp(-extinction * (1.0 - x.z + d));
        }
        SceneBuilder builder;
        builder.light(PointLightDesc{.position = Vec3(lamp), .intensity = Rgb(3.0f)});
        builder.desc.fog = MediumDesc{.extinction = Rgb(static_cast<float>(extinction)),
                                      .albedo = Rgb(static_cast<float>(albedo)),
                                      .anisotropy = static_cast<float>(g)};
        const Scene scene(std::move(builder.desc));
        const CameraDesc camera = camera_at({0, 0, 4}, {0, 0, 0}, 1e-5f);
        CAPTURE(g);
        for (const auto kind :
             {IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::mis, IntegratorKind::bdpt}) {
            check_mean(scene, camera, options(kind, 2), expected, 0.015);
        }
    }
}

}  // namespace bdpt::test::closed_form_media_test
