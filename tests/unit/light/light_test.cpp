#include "light/light.h"

#include "catch.hpp"
#include "math/elementary.h"
#include "math/rgb.h"
#include "scene/world.h"
#include "scene_builder.h"
#include "statistics.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

namespace bdpt::light_test {
namespace {

using test::SceneBuilder;

Image sky()
{
    Image image{.width = 8, .height = 4, .pixels = {}};
    for (int i = 0; i < 32; ++i) {
        image.pixels.emplace_back(i == 11 ? 40.0f : 0.2f * static_cast<float>(i % 5), 0.5f, 0.1f);
    }
    return image;
}

/// Brighter below than above, and not the same all around.
LightProfile luminaire()
{
    return {.polar_angles = {0.0f, 0.5f, 1.2f, 2.5f},
            .azimuths = {0.0f, 1.5f, 4.0f, 2.0f * pi},
            .intensities = {3, 4, 1, 0, 3, 2, 5, 0.5f, 3, 1, 0, 0, 3, 4, 1, 0}};
}

EnvironmentLight environment(Image image)
{
    return EnvironmentLight(
        {.radiance = std::move(image),
         .world_from_environment = Mat3(glm::rotate(Mat4(1.0f), 0.8f, Vec3(0.0f, 0.6f, 0.8f)))},
        {.center = Vec3(1.0f), .radius = 3.0f});
}

/// Of all light that enters the scene, by a sum over directions.
double flux_of(const EnvironmentLight& light, const BoundingSphere& bounds)
{
    constexpr int rows = 400;
    constexpr int columns = 800;
    double sum = 0.0;
    for (int i = 0; i < rows * columns; ++i) {
        const double y = 1.0 - 2.0 * (i / columns + 0.5) / rows;
        const double phi = 6.283185307179586 * (i % columns + 0.5) / columns;
        const double r = std::sqrt(1.0 - y * y);
        sum += static_cast<double>(
            luminance(light.radiance(Vec3(r * std::cos(phi), y, r * std::sin(phi)))));
    }
    const double solid_angle = 12.566370614359172 / (rows * columns);
    return sum * solid_angle / static_cast<double>(bounds.pdf_disk().value);
}

}  // namespace

TEST_CASE("environment: the image closes behind, without a seam", "[light]")
{
    // A column each; the centre is at -z, columns to the right turn towards +x.
    constexpr int columns = 6;
    const std::array<float, columns> values{8.0f, 1.0f, 4.0f, 2.0f, 6.0f, 3.0f};
    Image ring{.width = columns, .height = 1, .pixels = {}};
    for (const float value : values) {
        ring.pixels.emplace_back(value);
    }
    const EnvironmentLight light({.radiance = std::move(ring)},
                                 {.center = Vec3(0.0f), .radius = 1.0f});
    for (int i = 0; i < 8 * columns; ++i) {
        const double x = (i + 0.3) / 8.0;  // [columns], from the left edge, which is at +z
        const double left = std::floor(x - 0.5);
        const auto column = [&](double index) {
            return static_cast<double>(
                values[static_cast<std::size_t>((static_cast<int>(index) + columns) % columns)]);
        };
        const double share = x - 0.5 - left;
        const double expected = (1.0 - share) * column(left) + share * column(left + 1.0);
        const double phi = 6.283185307179586 * (x / columns - 0.5);
        CAPTURE(x);
        CHECK(static_cast<double>(light.radiance(Vec3(std::sin(phi), 0.0, -std::cos(phi))).g) ==
              Approx(expected).epsilon(1e-4));
    }
}

TEST_CASE("environment: the density integrates to one and is that of the samples", "[light]")
{
    const EnvironmentLight light = environment(sky());
    const auto sampling = GENERATE(EnvironmentSampling::plain, EnvironmentSampling::compensated);
    CAPTURE(static_cast<int>(sampling));
    test::Random random(1);
    test::Moments density;
    test::Moments radiance;
    for (int i = 0; i < 400000; ++i) {
        const Vec3 w = random.direction();
        const float pdf = light.pdf_incident({}, {.p = w}, sampling).value;
        density.add(static_cast<double>(4.0f * pi * pdf));
        // What is never sampled is left to others.
        const float sampled = pdf > 0.0f ? luminance(light.radiance(w)) : 0.0f;
        radiance.add(static_cast<double>(4.0f * pi * sampled));
    }
    CHECK(std::abs(density.mean() - 1.0) < 4.0 * density.standard_error());
    CHECK(density.standard_error() < 0.01);

    test::Moments sampled;
    for (int i = 0; i < 20000; ++i) {
        const auto incident = light.sample_incident({}, random.next_2d(), sampling, 0.0f);
        REQUIRE(incident.has_value());
        REQUIRE(light.pdf_incident({}, {.p = incident->wi}, sampling).value ==
                Approx(incident->pdf_solid_angle.value).epsilon(2e-3));
        sampled.add(static_cast<double>(luminance(light.incident_weight(*incident))));
    }
    const double error = std::hypot(sampled.standard_error(), radiance.standard_error());
    CHECK(std::abs(sampled.mean() - radiance.mean()) < 4.0 * error);
    CHECK(error < 0.01 * radiance.mean());
}

TEST_CASE("environment: light wherever it is bright can be sampled", "[light]")
{
    const EnvironmentLight light = environment(sky());
    test::Random random(2);
    for (int i = 0; i < 10000; ++i) {
        const Vec3 w = random.direction();
        if (luminance(light.radiance(w)) > 0.0f) {
            REQUIRE(light.pdf_incident({}, {.p = w}, EnvironmentSampling::plain).value > 0.0f);
            REQUIRE(light.pdf_position({.p = w}).value > 0.0f);
        }
    }
}

TEST_CASE("environment: compensated sampling leaves out half of the mean", "[light]")
{
    constexpr int width = 16;
    constexpr int height = 256;
    Image image{.width = width, .height = height, .pixels = {}};
    for (int i = 0; i < width * height; ++i) {
        const float below = i % width < width / 2 ? 1.0f : 2.0f;
        image.pixels.emplace_back(i / width < height / 2 ? 5.0f : below);  // the mean is 3.25
    }
    const auto compensated = EnvironmentSampling::compensated;
    const EnvironmentLight light({.radiance = image}, {.center = Vec3(0.0f), .radius = 1.0f});
    const Vec3 up = normalize(Vec3(0.3f, 0.5f, -0.2f));
    const Vec3 left = normalize(Vec3(-0.3f, -0.5f, -0.2f));
    const Vec3 right = normalize(Vec3(0.3f, -0.5f, -0.2f));
    const auto share = [](float level, float mean) {
        return Approx(0.25f * inv_pi * level / mean).epsilon(0.02);
    };
    CHECK(light.pdf_incident({}, {.p = up}, compensated).value == share(3.375f, 1.78125f));
    CHECK(light.pdf_incident({}, {.p = right}, compensated).value == share(0.375f, 1.78125f));
    CHECK(light.pdf_incident({}, {.p = left}, compensated).value == 0.0f);
    for (const auto& [direction, level] : {std::pair{up, 5.0f}, {left, 1.0f}, {right, 2.0f}}) {
        CHECK(light.pdf_position({.p = direction}).value == share(level, 3.25f));
        CHECK(light.pdf_incident({}, {.p = direction}, EnvironmentSampling::plain).value ==
              share(level, 3.25f));
    }

    // A constant image keeps its density.
    for (const int columns : {1, 7, 512}) {
        const Image grey{.width = columns,
                         .height = 3,
                         .pixels = std::vector<Rgb>(3 * static_cast<std::size_t>(columns),
                                                    Rgb(0.1f, 0.7f, 0.3f))};
        const EnvironmentLight constant({.radiance = grey}, {});
        CHECK(constant.pdf_incident({}, {.p = up}, compensated).value == Approx(0.25f * inv_pi));
        CHECK(constant.pdf_incident({}, {.p = left}, compensated).value == Approx(0.25f * inv_pi));
    }
}

TEST_CASE("environment: directions of the image", "[light]")
{
    Image image{.width = 4, .height = 2, .pixels = std::vector<Rgb>(8, Rgb(0.0f))};
    const auto seen = [&](int texel, Vec3 direction) {
        image.pixels.assign(8, Rgb(0.0f));
        image.pixels[static_cast<std::size_t>(texel)] = Rgb(1.0f);
        return EnvironmentLight({.radiance = image}, {}).radiance(normalize(direction)).r > 0.4f;
    };
    // Texel centres of the upper row, left to right, are at +z/-x, -x/-z, -z/+x and +x/+z.
    CHECK(seen(0, {-1.0f, 1.0f, 1.0f}));
    CHECK(seen(1, {-1.0f, 1.0f, -1.0f}));
    CHECK(seen(2, {1.0f, 1.0f, -1.0f}));
    CHECK(seen(3, {1.0f, 1.0f, 1.0f}));
    CHECK(seen(6, {1.0f, -1.0f, -1.0f}));
    CHECK_FALSE(seen(6, {1.0f, 1.0f, -1.0f}));
}

TEST_CASE("emission weights integrate to the power, for every kind of light", "[light]")
{
    SceneBuilder builder;
    builder.quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, test::emitter({3, 2, 1}));
    MaterialDesc both = test::emitter(Rgb(2.0f));
    both.double_sided = true;
    builder.quad({-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}, both);
    builder.light(PointLightDesc{.intensity = Rgb(5.0f)});
    builder.light(SpotLightDesc{.direction = {1, 2, 3},
                                .intensity = Rgb(5.0f),
                                .inner_cone_angle = 0.3f,
                                .outer_cone_angle = 0.9f});
    builder.light(PointLightDesc{.intensity = Rgb(5.0f), .radius = 0.3f});
    builder.light(SpotLightDesc{.direction = {1, 2, 3},
                                .intensity = Rgb(5.0f),
                                .inner_cone_angle = 0.3f,
                                .outer_cone_angle = 0.9f,
                                .radius = 0.7f});
    builder.light(DirectionalLightDesc{.direction = {1, -2, 3}, .illuminance = Rgb(2.0f)});
    builder.desc.profiles.push_back(luminaire());
    builder.light(ProfileLightDesc{.scale = {1.0f, 2.0f, 0.5f}});
    builder.light(EnvironmentLightDesc{.radiance = sky()});
    const World world(std::move(builder.desc));
    test::Random random(3);
    for (std::uint32_t id = 0; id < world.lights().size(); ++id) {
        const Light& light = world.lights()[LightId{id}];
        test::Moments flux;
        for (int i = 0; i < 100000; ++i) {
            const auto emitted = light.sample_emission(random.next_2d(), random.next_2d(), 0.0f);
            flux.add(emitted ? static_cast<double>(luminance(emitted->weight)) : 0.0);
            if (emitted && !light.is_infinite()) {
                REQUIRE(light.pdf_direction(emitted->end.ng, emitted->direction, 0.0f).value ==
                        Approx(emitted->pdf_direction.value).epsilon(1e-3));
            }
        }
        INFO("light " << id);
        auto power = static_cast<double>(luminance(light.power()));
        if (const auto* environment = std::get_if<EnvironmentLight>(&light.model())) {
            // Its power is that of nearest texels; lookups are bilinear.
            const double bilinear = flux_of(*environment, world.bounding_sphere());
            CHECK(bilinear == Approx(power).epsilon(0.15));
            power = bilinear;
        }
        CHECK(std::abs(flux.mean() - power) < 4.0 * flux.standard_error() + 1e-3 * power);
        CHECK(flux.standard_error() < 0.005 * power);
    }
}

TEST_CASE("light paths bring to a surface what next-event estimation finds there", "[light]")
{
    // Irradiance at a small patch: once by light sampling, once by counting emitted rays through a
    // disk around it. The sampled densities of the two have nothing in common.
    SceneBuilder builder;
    builder.quad({-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}, test::emitter(Rgb(3.0f)));
    builder.light(SpotLightDesc{.position = {0.3f, 3.0f, 0.0f},
                                .direction = {0, -1, 0},
                                .intensity = Rgb(5.0f),
                                .inner_cone_angle = 0.1f,
                                .outer_cone_angle = 0.5f});
    builder.light(EnvironmentLightDesc{.radiance = sky()});
    builder.light(DirectionalLightDesc{.direction = {0.3f, -1, 0.2f}, .illuminance = Rgb(2.0f)});
    builder.light(PointLightDesc{.position = {0.0f, 1.0f, 0.5f}, .intensity = Rgb(1.0f)});
    // Some of these receivers see the spheres' lower halves only, or the edge of the cone.
    builder.light(
        PointLightDesc{.position = {0.0f, 0.7f, 0.2f}, .intensity = Rgb(1.0f), .radius = 0.5f});
    builder.light(SpotLightDesc{.position = {0.5f, 1.0f, 0.0f},
                                .direction = {-0.3f, -1, 0},
                                .intensity = Rgb(5.0f),
                                .inner_cone_angle = 0.1f,
                                .outer_cone_angle = 0.5f,
                                .radius = 0.3f});
    builder.desc.profiles.push_back(luminaire());
    builder.light(ProfileLightDesc{
        .position = {0.2f, 1.2f, 0.1f},
        .world_from_light = Mat3(glm::rotate(Mat4(1.0f), -1.3f, Vec3(1.0f, 0.0f, 0.0f)))});
    // The receiver is part of the scene, for light from infinity is aimed at its bounds.
    builder.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, test::lambertian(Rgb(0.5f)));
    const World world(std::move(builder.desc));
    test::Random random(4);
    constexpr float radius = 0.8f;
    const Vec3 normal(0.0f, 1.0f, 0.0f);
    for (std::uint32_t id = 0; id < world.lights().size(); ++id) {
        const Light& light = world.lights()[LightId{id}];
        test::Moments by_light_paths;
        test::Moments by_light_samples;
        for (int i = 0; i < 400000; ++i) {
            const auto emitted = light.sample_emission(random.next_2d(), random.next_2d(), 0.0f);
            double flux = 0.0;
            if (emitted && emitted->direction.y < 0.0f) {
                const float t = -emitted->end.p.y / emitted->direction.y;
                const Vec3 p = emitted->end.p + t * emitted->direction;
                const bool through = t > 0.0f && p.x * p.x + p.z * p.z < radius * radius;
                flux = through ? static_cast<double>(luminance(emitted->weight)) : 0.0;
            }
            by_light_paths.add(flux / static_cast<double>(pi * radius * radius));
            const float r = radius * std::sqrt(random.next());
            const SinCos phi = sin_cos(2.0f * pi * random.next());
            const auto incident =
                light.sample_incident({.p = {r * phi.cos, 0.0f, r * phi.sin}}, random.next_2d(),
                                      EnvironmentSampling::plain, 0.0f);
            const bool above = incident && incident->wi.y > 0.0f;
            by_light_samples.add(
                above ? static_cast<double>(luminance(light.incident_weight(*incident)) *
                                            dot(incident->wi, normal))
                      : 0.0);
        }
        INFO("light " << id);
        const double error =
            std::hypot(by_light_paths.standard_error(), by_light_samples.standard_error());
        CHECK(std::abs(by_light_paths.mean() - by_light_samples.mean()) < 4.0 * error);
        CHECK(error < 0.008 * by_light_samples.mean());
    }
}

TEST_CASE("a spot is dark outside of its cone and full inside of the inner one", "[light]")
{
    const PunctualLight spot(SpotLightDesc{.direction = {0, -1, 0},
                                           .intensity = Rgb(8.0f),
                                           .inner_cone_angle = 0.2f,
                                           .outer_cone_angle = 0.6f});
    const auto intensity = [&](float angle) {
        const auto incident =
            spot.sample_incident({.p = {2.0f * std::sin(angle), -2.0f * std::cos(angle), 0.0f}}, {},
                                 EnvironmentSampling::plain, 0.0f);
        return incident ? 4.0f * incident->weight.r : 0.0f;
    };
    CHECK(intensity(0.0f) == Approx(8.0f));
    CHECK(intensity(0.19f) == Approx(8.0f));
    CHECK(intensity(0.61f) == 0.0f);
    const float x = (std::cos(0.4f) - std::cos(0.6f)) / (std::cos(0.2f) - std::cos(0.6f));
    CHECK(intensity(0.4f) == Approx(8.0f * x * x).epsilon(1e-3));
}

}  // namespace bdpt::light_test
