#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <cstddef>
#include <utility>

namespace bdpt::fog_light_test {
namespace {

/// Nothing but fog so thin that one walk of hundreds is scattered in it, beside a lamp that is not
/// seen.
Scene thin_fog()
{
    test::SceneBuilder builder;
    builder.light(PointLightDesc{.position = {0.7f, 0.1f, 0.0f}, .intensity = Rgb(3.0f)});
    builder.desc.fog = MediumDesc{.extinction = Rgb(1e-3f), .albedo = Rgb(1.0f)};
    return Scene(std::move(builder.desc));
}

RenderResult rendered(const Scene& scene, IntegratorKind integrator, int samples)
{
    RenderOptions options;
    options.integrator = integrator;
    options.film = {.width = 8, .height = 8};
    options.sampling.samples.end = samples;
    options.transport.max_depth = 2;
    return render(scene, test::camera_at({0, 0, 3}, {0, 0, 0}, 0.3f), options);
}

/// Beside what is seen of dense fog a globe so large and near that all three ways to find it count:
/// points of fog that are chosen for it, light samples, and directions of the phase function.
Scene globe_in_fog()
{
    test::SceneBuilder builder;
    builder.light(
        PointLightDesc{.position = {1.4f, 0.0f, 0.0f}, .intensity = Rgb(3.0f), .radius = 0.7f});
    builder.desc.fog = MediumDesc{.extinction = Rgb(1.0f), .albedo = Rgb(1.0f)};
    return Scene(std::move(builder.desc));
}

double mean_of_globe(LightSampling lights, int light_samples)
{
    RenderOptions options;
    options.integrator = IntegratorKind::mis;
    options.film = {.width = 8, .height = 8};
    options.sampling.samples.end = 512;
    options.sampling.lights = lights;
    options.sampling.light_samples = light_samples;
    options.transport.max_depth = 2;
    const CameraDesc camera = test::camera_at({0, 0, 3}, {0, 0, 0}, 0.3f);
    double sum = 0.0;
    for (const Rgb& pixel : render(globe_in_fog(), camera, options).film.develop().pixels) {
        sum += static_cast<double>(pixel.g) / (8 * 8);
    }
    return sum;
}

}  // namespace

TEST_CASE("coloured fog that absorbs nothing cannot be seen before an even sky", "[media]")
{
    // Not by a single path: distances do not change the sum of its channels.
    test::SceneBuilder builder;
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1.0f)}}});
    builder.cube({0.0f, 0.0f, 0.0f}, 0.6f, test::lambertian(Rgb(1.0f)));
    builder.desc.fog =
        MediumDesc{.extinction = {0.3f, 1.0f, 4.0f}, .albedo = Rgb(1.0f), .anisotropy = 0.2f};
    const Scene scene(std::move(builder.desc));
    RenderOptions options;
    options.integrator = IntegratorKind::pt;
    options.film = {.width = 8, .height = 8};
    options.sampling.samples.end = 1;
    options.transport.max_depth = 200;
    options.transport.rr_start = 200;
    const RenderResult result = render(scene, test::camera_at({0, 0, 3}, {0, 0, 0}, 0.9f), options);
    int coloured = 0;
    for (const Rgb& pixel : result.film.develop().pixels) {
        CHECK(pixel.r + pixel.g + pixel.b == Approx(3.0f).epsilon(1e-3));
        coloured += pixel.r > 1.1f || pixel.b > 1.1f ? 1 : 0;
    }
    CHECK(coloured > 16);
}

TEST_CASE("a lamp in thin fog has no noise, for points of the fog are chosen for it", "[media]")
{
    const Scene scene = thin_fog();
    const auto kind = GENERATE(IntegratorKind::nee, IntegratorKind::mis);
    const RenderResult few = rendered(scene, kind, 2);
    const RenderResult many = rendered(scene, kind, 256);
    CHECK(few.stats.rays.shadow >= few.stats.paths.camera);
    const Image image = few.film.develop();
    const Image reference = many.film.develop();
    double found = 0.0;
    double expected = 0.0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        found += static_cast<double>(image.pixels[i].g);
        expected += static_cast<double>(reference.pixels[i].g);
    }
    CHECK(expected > 0.0);
    CHECK(found == Approx(expected).epsilon(0.03));
}

TEST_CASE("the ways to find a lamp share its light in fog, however often each is tried", "[media]")
{
    // With a tree, points are chosen for the lamp on one segment in four.
    const double expected = mean_of_globe(LightSampling::power, 1);
    CHECK(mean_of_globe(LightSampling::tree, 1) == Approx(expected).epsilon(0.03));
    CHECK(mean_of_globe(LightSampling::power, 4) == Approx(expected).epsilon(0.03));
    CHECK(mean_of_globe(LightSampling::tree, 4) == Approx(expected).epsilon(0.03));
}

}  // namespace bdpt::fog_light_test
