#include "catch.hpp"
#include "even_bins.h"
#include "light/light.h"
#include "math/elementary.h"
#include "math/frame.h"
#include "scene/world.h"
#include "scene_builder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <utility>
#include <vector>

// Light paths leave every kind of light as its densities say (sphere lights: sphere_light_test).

namespace bdpt::emission_test {
namespace {

using test::find_bin;
using test::turn;

constexpr int samples = 200000;
constexpr int steps = 8;

/// The only light of a scene.
const Light& only_light(const World& world)
{
    REQUIRE(world.lights().size() == 1);
    return world.lights()[LightId{0}];
}

/// Where on the disk in front of the scene a ray enters, as two numbers that should be uniform.
std::array<double, 2> place_on_disk(const BoundingSphere& bounds, const EmissionSample& emitted)
{
    const Vec3 local =
        Frame::from_normal(emitted.direction).to_local(emitted.end.p - bounds.center) /
        bounds.radius;
    REQUIRE(local.z == Approx(-1.0f).epsilon(1e-5));
    const auto x = static_cast<double>(local.x);
    const auto y = static_cast<double>(local.y);
    return {x * x + y * y, turn(x, y)};
}

}  // namespace

TEST_CASE("point and spot: light leaves evenly in the cone", "[light]")
{
    constexpr float outer_cone_angle = 0.9f;
    for (const bool spot : {false, true}) {
        INFO((spot ? "spot" : "point"));
        test::SceneBuilder builder;
        const Vec3 axis = spot ? normalize(Vec3(1.0f, 2.0f, 3.0f)) : Vec3(0.0f, 0.0f, 1.0f);
        if (spot) {
            builder.light(SpotLightDesc{.direction = axis,
                                        .intensity = Rgb(5.0f),
                                        .inner_cone_angle = 0.3f,
                                        .outer_cone_angle = outer_cone_angle});
        } else {
            builder.light(PointLightDesc{.intensity = Rgb(5.0f)});
        }
        const World world(std::move(builder.desc));
        const Light& light = only_light(world);
        const double height = spot ? 1.0 - std::cos(0.9) : 2.0;
        test::Random random(31);
        std::vector<double> counts(steps * steps);
        for (int i = 0; i < samples; ++i) {
            const auto emitted = light.sample_emission(random.next_2d(), random.next_2d(), 0.0f);
            REQUIRE(emitted.has_value());
            REQUIRE(static_cast<double>(emitted->pdf_direction.value) ==
                    Approx(1.0 / (6.283185307179586 * height)).epsilon(1e-4));
            const Vec3 local = Frame::from_normal(axis).to_local(emitted->direction);
            counts[find_bin<2>({(1.0 - static_cast<double>(local.z)) / height,
                                turn(static_cast<double>(local.x), static_cast<double>(local.y))},
                               steps)] += 1.0;
        }
        test::check_uniform(counts);
    }
}

TEST_CASE("triangle: light leaves with the cosine, on the sides that emit", "[light]")
{
    for (const bool both_sides : {false, true}) {
        INFO((both_sides ? "both sides" : "one side"));
        test::SceneBuilder builder;
        MaterialDesc material = test::emitter({3, 2, 1});
        material.double_sided = both_sides;
        builder.quad({-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, material);
        const World world(std::move(builder.desc));
        const Light& light = world.lights()[LightId{1}];
        test::Random random(32);
        std::vector<double> counts((both_sides ? 2 : 1) * steps * steps);
        for (int i = 0; i < samples; ++i) {
            const auto emitted = light.sample_emission(random.next_2d(), random.next_2d(), 0.0f);
            REQUIRE(emitted.has_value());
            const Vec3 local = Frame::from_normal(emitted->end.ng).to_local(emitted->direction);
            REQUIRE((both_sides || local.z > 0.0f));
            REQUIRE(emitted->pdf_direction.value ==
                    Approx(std::abs(local.z) * inv_pi * (both_sides ? 0.5f : 1.0f)));
            // The square of the cosine is uniform.
            const std::size_t side = local.z > 0.0f ? 0 : steps * steps;
            counts[side +
                   find_bin<2>({static_cast<double>(local.z * local.z),
                                turn(static_cast<double>(local.x), static_cast<double>(local.y))},
                               steps)] += 1.0;
        }
        test::check_uniform(counts);
    }
}

TEST_CASE("directional: rays enter evenly on the disk in front of the scene", "[light]")
{
    test::SceneBuilder builder;
    builder.quad({-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {});
    const Vec3 direction = normalize(Vec3(1.0f, -2.0f, 3.0f));
    builder.light(DirectionalLightDesc{.direction = direction, .illuminance = Rgb(2.0f)});
    const World world(std::move(builder.desc));
    test::Random random(33);
    std::vector<double> counts(steps * steps);
    for (int i = 0; i < samples; ++i) {
        const auto emitted =
            only_light(world).sample_emission(random.next_2d(), random.next_2d(), 0.0f);
        REQUIRE(emitted.has_value());
        REQUIRE(glm::distance(emitted->direction, direction) < 1e-6f);
        counts[find_bin(place_on_disk(world.bounding_sphere(), *emitted), steps)] += 1.0;
    }
    test::check_uniform(counts);
}

TEST_CASE("environment: light comes by luminance, and enters evenly on the disk", "[light]")
{
    Image sky{.width = 8, .height = 4, .pixels = {}};
    for (int i = 0; i < 32; ++i) {
        sky.pixels.emplace_back(i == 11 ? 9.0f : 0.2f * static_cast<float>(i % 5), 0.5f, 0.1f);
    }
    test::SceneBuilder builder;
    builder.quad({-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {});
    builder.light(EnvironmentLightDesc{.radiance = std::move(sky)});
    const World world(std::move(builder.desc));
    const auto& light = std::get<EnvironmentLight>(only_light(world).model());

    const auto bin_of_direction = [](Vec3 w) {
        return find_bin<2>({0.5 + 0.5 * static_cast<double>(w.y),
                            turn(static_cast<double>(w.x), static_cast<double>(w.z))},
                           steps);
    };
    // The density integrated over each bin, in which it is constant in cells.
    std::vector<double> expected(steps * steps);
    constexpr int fine = 1024;
    double sum = 0.0;
    for (int i = 0; i < fine; ++i) {
        const double y = 2.0 * (i + 0.5) / fine - 1.0;
        for (int j = 0; j < fine; ++j) {
            const double phi = 6.283185307179586 * (j + 0.5) / fine;
            const double r = std::sqrt(1.0 - y * y);
            const Vec3 w(r * std::cos(phi), y, r * std::sin(phi));
            const double part =
                static_cast<double>(
                    light.pdf_incident({}, {.p = w}, EnvironmentSampling::plain).value) *
                (12.566370614359172 / (fine * fine));
            expected[bin_of_direction(w)] += part;
            sum += part;
        }
    }
    CHECK(sum == Approx(1.0).epsilon(2e-3));
    for (double& probability : expected) {
        probability /= sum;
    }
    test::Random random(34);
    std::vector<double> directions(expected.size());
    std::vector<double> places(steps * steps);
    for (int i = 0; i < samples; ++i) {
        const auto emitted = light.sample_emission(random.next_2d(), random.next_2d(), 0.0f);
        REQUIRE(emitted.has_value());
        REQUIRE(
            emitted->pdf_position.value ==
            Approx(light.pdf_incident({}, {.p = -emitted->direction}, EnvironmentSampling::plain)
                       .value)
                .epsilon(2e-3));
        directions[bin_of_direction(-emitted->direction)] += 1.0;
        places[find_bin(place_on_disk(world.bounding_sphere(), *emitted), steps)] += 1.0;
    }
    test::check_counts(directions, expected);
    test::check_uniform(places);
}

}  // namespace bdpt::emission_test
