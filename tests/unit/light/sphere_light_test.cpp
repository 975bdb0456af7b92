#include "light/sphere_light.h"

#include "catch.hpp"
#include "even_bins.h"
#include "math/elementary.h"
#include "math/frame.h"
#include "scene/world.h"
#include "scene_builder.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace bdpt::sphere_light_test {
namespace {

using test::check_uniform;
using test::find_bin;
using test::turn;

PointLightDesc bulb(float radius)
{
    return {.position = {0.3f, -0.2f, 0.5f}, .intensity = Rgb(2.0f), .radius = radius};
}

SpotLightDesc lamp(float radius)
{
    return {.position = {0.3f, -0.2f, 0.5f},
            .direction = {0.3f, -1.0f, 0.4f},
            .intensity = Rgb(2.0f),
            .inner_cone_angle = 0.3f,
            .outer_cone_angle = 0.9f,
            .radius = radius};
}

}  // namespace

TEST_CASE("sphere: next-event directions are uniform in the cone that the sphere fills", "[light]")
{
    // From far away to nearly touching; distances in radii.
    for (const double distance : {1e4, 30.0, 2.0, 1.1, 1.0001}) {
        constexpr float radius = 0.25f;
        test::Random random(11);
        const Vec3 axis = random.direction();
        const PointLightDesc desc{.intensity = Rgb(1.0f), .radius = radius};
        const SphereLight light(desc, 0);
        const Vec3 receiver = static_cast<float>(distance * static_cast<double>(radius)) * axis;
        // What the rounded receiver really is at.
        const double exact = length(glm::dvec3(receiver)) / static_cast<double>(radius);
        const glm::dvec3 towards = -normalize(glm::dvec3(receiver));
        const Frame frame = Frame::from_normal(Vec3(towards));
        const double sine_squared = 1.0 / (exact * exact);
        const double height = sine_squared / (1.0 + std::sqrt(1.0 - sine_squared));
        std::vector<double> counts(64);
        for (int i = 0; i < 200000; ++i) {
            const auto incident = light.sample_incident({.p = receiver}, random.next_2d(),
                                                        EnvironmentSampling::plain, 0.0f);
            REQUIRE(incident.has_value());
            const glm::dvec3 w = normalize(glm::dvec3(incident->end.p) - glm::dvec3(receiver));
            const glm::dvec3 across = w - dot(w, towards) * towards;
            const double s2 = dot(across, across);
            const double depth = s2 / (1.0 + std::sqrt(1.0 - s2));  // 1 - cos
            counts[find_bin<2>({depth / height, turn(dot(across, glm::dvec3(frame.x)),
                                                     dot(across, glm::dvec3(frame.y)))},
                               8)] += 1.0;
            REQUIRE(static_cast<double>(incident->pdf_solid_angle.value) ==
                    Approx(1.0 / (2.0 * 3.14159265358979 * height)).epsilon(1e-5));
            // A strategy that finds the point by chance computes the same density.
            REQUIRE(
                light.pdf_incident({.p = receiver}, {.p = incident->end.p, .ng = incident->end.ng})
                    .value == Approx(incident->pdf.value).epsilon(1e-4));
        }
        INFO("distance " << distance);
        check_uniform(counts);
    }
}

TEST_CASE("sphere: the density of next-event points integrates to one", "[light]")
{
    const SphereLight light(bulb(0.25f), 0);
    for (const float distance : {100.0f, 3.0f, 1.05f}) {
        const Vec3 receiver = bulb(0.0f).position + 0.25f * distance * Vec3(0.6f, 0.0f, 0.8f);
        test::Random random(12);
        test::Moments integral;
        for (int i = 0; i < 2000000; ++i) {
            const SegmentEnd at = light.surface(random.direction(), 0.0f);
            integral.add(static_cast<double>(
                light.pdf_incident({.p = receiver}, {.p = at.p, .ng = at.ng}).value /
                light.pdf_position().value));
        }
        INFO("distance " << distance);
        CHECK(std::abs(integral.mean() - 1.0) < 4.0 * integral.standard_error());
        CHECK(integral.standard_error() < 0.02);
    }
}

TEST_CASE("sphere: there is no light inside of the sphere", "[light]")
{
    const SphereLight light(bulb(0.25f), 0);
    const SegmentEnd top = light.surface({0.0f, 1.0f, 0.0f}, 0.0f);
    const Vec3 center = bulb(0.0f).position;
    for (const Vec3 receiver : {center, center + Vec3(0.2f, 0.0f, 0.0f)}) {
        CHECK_FALSE(
            light.sample_incident({.p = receiver}, {0.3f, 0.6f}, EnvironmentSampling::plain, 0.0f)
                .has_value());
        CHECK(light.pdf_incident({.p = receiver}, {.p = top.p, .ng = top.ng}).value == 0.0f);
    }
    // Nor on the far side.
    CHECK(light.pdf_incident({.p = {0.3f, -4.0f, 0.5f}}, {.p = top.p, .ng = top.ng}).value == 0.0f);
}

TEST_CASE("sphere: light that leaves has the density that is claimed", "[light]")
{
    // Directions are uniform in the cone and points uniform on the disk across them.
    const Vec3 axis = normalize(lamp(1.0f).direction);
    const double cone_height = 1.0 - std::cos(0.9);
    for (const bool spot : {false, true}) {
        const SphereLight light = spot ? SphereLight(lamp(0.25f), 0) : SphereLight(bulb(0.25f), 0);
        const double height = spot ? cone_height : 2.0;
        const Frame cone = Frame::from_normal(spot ? axis : Vec3(0.0f, 0.0f, 1.0f));
        test::Random random(13);
        std::vector<double> counts(256);
        for (int i = 0; i < 400000; ++i) {
            const auto emitted = light.sample_emission(random.next_2d(), random.next_2d(), 0.0f);
            if (!emitted) {
                continue;  // right at the disk's edge
            }
            const Vec3 local = cone.to_local(emitted->direction);
            const Vec3 on_disk = Frame::from_normal(emitted->direction).to_local(emitted->end.ng);
            const auto radius_squared =
                static_cast<double>(on_disk.x * on_disk.x + on_disk.y * on_disk.y);
            REQUIRE(on_disk.z > 0.0f);
            counts[find_bin<4>(
                {(1.0 - static_cast<double>(local.z)) / height,
                 turn(static_cast<double>(local.x), static_cast<double>(local.y)), radius_squared,
                 turn(static_cast<double>(on_disk.x), static_cast<double>(on_disk.y))},
                4)] += 1.0;
            const double joint = static_cast<double>(on_disk.z) /
                                 (3.14159265358979 * 0.0625 * 6.28318530717959 * height);
            REQUIRE(
                static_cast<double>(emitted->pdf_position.value * emitted->pdf_direction.value) ==
                Approx(joint).epsilon(1e-4));
        }
        INFO((spot ? "spot" : "point"));
        check_uniform(counts);
    }
}

TEST_CASE("sphere: the joint density of light paths integrates to one", "[light]")
{
    for (const bool spot : {false, true}) {
        const SphereLight light = spot ? SphereLight(lamp(0.25f), 0) : SphereLight(bulb(0.25f), 0);
        test::Random random(14);
        test::Moments integral;
        for (int i = 0; i < 400000; ++i) {
            const Vec3 ng = random.direction();
            const Vec3 w = random.direction();
            const float area = 4.0f * pi * 0.0625f;
            integral.add(static_cast<double>(light.pdf_position().value * area *
                                             light.pdf_direction(ng, w, 0.0f).value * 4.0f * pi));
        }
        CHECK(std::abs(integral.mean() - 1.0) < 4.0 * integral.standard_error());
        CHECK(integral.standard_error() < 0.01);
    }
}

TEST_CASE("sphere: from afar it is the point or spot light", "[light]")
{
    test::Random random(15);
    const SphereLight ball(lamp(1e-3f), 0);
    const PunctualLight point(lamp(0.0f));
    int lit = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 receiver = lamp(0.0f).position + 3.0f * random.direction();
        const auto expected =
            point.sample_incident({.p = receiver}, {}, EnvironmentSampling::plain, 0.0f);
        const auto found = ball.sample_incident({.p = receiver}, random.next_2d(),
                                                EnvironmentSampling::plain, 0.0f);
        if (expected && expected->weight.r > 1e-3f) {
            ++lit;
            REQUIRE(found.has_value());
            REQUIRE(found->weight.r == Approx(expected->weight.r).epsilon(0.02));
        } else {
            REQUIRE((!found || found->weight.r < 2e-3f));
        }
    }
    CHECK(lit > 100);
    CHECK(ball.power() == point.power());
}

TEST_CASE("sphere lights are surfaces: seen, in the way, black", "[world]")
{
    test::SceneBuilder builder;
    builder.light(bulb(0.25f)).light(PointLightDesc{}).light(lamp(0.5f));
    builder.desc.lights[2] = SpotLightDesc{.position = {5.0f, 0.0f, 0.0f},
                                           .direction = {0.0f, -1.0f, 0.0f},
                                           .intensity = Rgb(3.0f),
                                           .inner_cone_angle = 0.5f,
                                           .outer_cone_angle = 0.6f,
                                           .radius = 0.5f};
    const World world(std::move(builder.desc));
    CHECK(world.bounds().min.x == Approx(0.05f));
    CHECK(world.bounds().max.x == Approx(5.5f));
    CHECK(world.counts().emissive_triangles == 0);
    CHECK(world.lights()[LightId{1}].is_delta());

    const auto seen = world.intersect({.p = {0.3f, -0.2f, 4.0f}}, {0, 0, -1}, {});
    REQUIRE(seen.has_value());
    CHECK(seen->light == LightId{0});
    CHECK_FALSE(world.lights()[*seen->light].is_delta());
    CHECK(seen->emission.r == Approx(2.0f / (pi * 0.0625f)));
    CHECK(seen->end.p.z == Approx(0.75f));
    CHECK_FALSE(seen->bsdf.connectible());
    CHECK_FALSE(seen->bsdf.sample(0.5f, {0.3f, 0.4f}, TransportMode::radiance));
    const auto inside = world.intersect({.p = {0.3f, -0.2f, 0.5f}}, {0, 0, -1}, {});
    REQUIRE(inside.has_value());
    CHECK(inside->emission == Rgb(0.0f));
    CHECK(world.transmittance({.p = {0.3f, -0.2f, 4.0f}}, {.p = {0.3f, -0.2f, -4.0f}}, {}) ==
          Rgb(0.0f));

    // The spot shines down from all of its sphere, and nowhere else.
    const auto below = world.intersect({.p = {5.3f, -4.0f, 0.0f}}, {0, 1, 0}, {});
    REQUIRE(below.has_value());
    CHECK(below->light == LightId{2});
    CHECK(below->emission.r == Approx(3.0f / (pi * 0.25f)));
    CHECK(world.intersect({.p = {9.0f, 0.0f, 0.0f}}, {-1, 0, 0}, {})->emission == Rgb(0.0f));
}

TEST_CASE("a sphere never hides its own sampled points, from wherever it is lit", "[world]")
{
    test::Random random(16);
    for (const float radius : {1e-4f, 0.1f, 30.0f}) {
        for (const float shift : {0.0f, 50.0f}) {
            PointLightDesc desc = bulb(radius);
            desc.position += shift;
            test::SceneBuilder builder;
            builder.light(desc);
            const World world(std::move(builder.desc));
            const Light& light = world.lights()[LightId{0}];
            for (int i = 0; i < 3000; ++i) {
                const float distance = radius * (1.001f + 1000.0f * random.next());
                const Vec3 receiver = desc.position + distance * random.direction();
                const auto incident = light.sample_incident({.p = receiver}, random.next_2d(),
                                                            EnvironmentSampling::plain, 0.0f);
                if (incident) {
                    REQUIRE(world.transmittance({.p = receiver}, incident->end, {}) == Rgb(1.0f));
                }
                const auto emitted =
                    light.sample_emission(random.next_2d(), random.next_2d(), 0.0f);
                if (emitted) {
                    REQUIRE_FALSE(
                        world.intersect(emitted->end, emitted->direction, {}).has_value());
                }
            }
        }
    }
}

TEST_CASE("a sphere never hides its own outline from far away", "[world]")
{
    test::Random random(17);
    test::SceneBuilder builder;
    builder.light(PointLightDesc{.intensity = Rgb(1.0f), .radius = 0.1f});
    const World world(std::move(builder.desc));
    const Light& light = world.lights()[LightId{0}];
    int seen = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 receiver = (10.0f + 1000.0f * random.next()) * random.direction();
        // The square's border is that of the cone.
        const float near_border = 1.0f - 1e-4f * random.next();
        const auto incident = light.sample_incident({.p = receiver}, {near_border, random.next()},
                                                    EnvironmentSampling::plain, 0.0f);
        if (incident) {
            ++seen;
            REQUIRE(world.transmittance({.p = receiver}, incident->end, {}) == Rgb(1.0f));
        }
    }
    CHECK(seen > 10000);
}

}  // namespace bdpt::sphere_light_test
