// Lights that move: what is sampled at a time has the densities of that time.

#include "catch.hpp"
#include "light/light.h"
#include "math/rgb.h"
#include "moving_scenes.h"
#include "scene/world.h"
#include "statistics.h"

#include <glm/geometric.hpp>

#include <cstdint>
#include <utility>
#include <variant>

namespace bdpt::moving_light_test {
namespace {

using test::SceneBuilder;

/// Triangles that turn and grow, spheres and points that travel, spots and a sun that turn.
World lights_that_move()
{
    SceneBuilder builder = test::moving_stage();
    const PointLightDesc point{.position = {0.0f, 0.3f, 0.3f},
                               .intensity = Rgb(0.5f),
                               .motion = {{0.8f, 0.3f, 0.3f}, {0.2f, 0.9f, 0.3f}}};
    const SpotLightDesc spot{.position = {0.0f, 0.5f, 0.3f},
                             .direction = {0.0f, -1.0f, 0.0f},
                             .intensity = Rgb(0.5f),
                             .inner_cone_angle = 0.2f,
                             .outer_cone_angle = 0.6f,
                             .motion = {{0.9f, 0.5f, 0.3f}},
                             .later_directions = {{1.0f, -1.0f, 0.0f}, {1.0f, 0.5f, 0.0f}}};
    builder.light(point).light(spot);
    PointLightDesc ball = point;
    ball.radius = 0.2f;
    SpotLightDesc spot_sphere = spot;
    spot_sphere.radius = 0.1f;
    builder.light(ball).light(spot_sphere);
    builder.light(DirectionalLightDesc{.direction = {0.0f, -1.0f, -0.5f},
                                       .illuminance = Rgb(0.5f),
                                       .later_directions = {{0.9f, -1.0f, -0.5f}}});
    builder.desc.profiles.push_back(
        {.polar_angles = {0.0f, 3.0f}, .azimuths = {0.0f}, .intensities = {1.0f, 0.5f}});
    builder.light(
        ProfileLightDesc{.position = {-0.8f, -0.8f, 0.8f}, .motion = {{-0.8f, 0.8f, 0.8f}}});
    // A small plate that turns on the spot.
    MeshDesc plate;
    plate.positions = {{-0.1f, 0, -0.1f}, {0.1f, 0, -0.1f}, {0.1f, 0, 0.1f}};
    plate.triangles = {{0, 1, 2}};
    builder.place(builder.add_mesh(plate), test::emitter(Rgb(0.5f)), Mat4(1.0f));
    test::move_last(builder, 8, [](float t) {
        return glm::rotate(test::translation({-0.7f, 0.6f, -0.5f}), 2.5f * t, Vec3(1, 0, 0));
    });
    return World(std::move(builder.desc));
}

}  // namespace

TEST_CASE("densities of lights that move are those of their time", "[motion][light]")
{
    const World world = lights_that_move();
    test::Random random(4);
    constexpr int min_incident = 20;
    for (std::uint32_t i = 0; i < world.lights().size(); ++i) {
        const Light& light = world.lights()[LightId{i}];
        if (light.is_infinite()) {
            continue;
        }
        int incident_samples = 0;
        int emitted_samples = 0;
        for (int k = 0; k < 300; ++k) {
            CAPTURE(i, k);
            const float time = random.next();
            const Vec3 receiver = 2.0f * random.direction();
            const auto incident = light.sample_incident({.p = receiver}, random.next_2d(),
                                                        EnvironmentSampling::plain, time);
            if (incident) {
                ++incident_samples;
                const LightPoint x0{.p = incident->end.p,
                                    .ng = incident->end.ng,
                                    .barycentrics = incident->barycentrics,
                                    .time = time};
                REQUIRE(light.pdf_incident({.p = receiver}, x0).value ==
                        Approx(incident->pdf.value).epsilon(2e-3));
            }
            const auto emitted = light.sample_emission(random.next_2d(), random.next_2d(), time);
            if (emitted) {
                ++emitted_samples;
                const LightPoint x0{.p = emitted->end.p,
                                    .ng = emitted->end.ng,
                                    .barycentrics = emitted->barycentrics,
                                    .time = time};
                const SolidAnglePdf direction =
                    light.pdf_direction(emitted->end.ng, emitted->direction, time);
                REQUIRE(light.pdf_position(x0).value * direction.value ==
                        Approx(emitted->pdf_position.value * emitted->pdf_direction.value)
                            .epsilon(2e-3));
            }
        }
        // One-sided triangles and spots light less than half of all points.
        CAPTURE(i);
        CHECK(incident_samples >= min_incident);
        CHECK(emitted_samples == 300);
    }
}

TEST_CASE("lights that move shine from where they are, by both ways of sampling", "[motion][light]")
{
    const World world = lights_that_move();
    test::Random random(5);
    int compared = 0;
    for (std::uint32_t i = 0; i < world.lights().size(); ++i) {
        const Light& light = world.lights()[LightId{i}];
        if (!std::holds_alternative<PunctualLight>(light.model()) &&
            !std::holds_alternative<DirectionalLight>(light.model()) &&
            !std::holds_alternative<ProfileLight>(light.model())) {
            continue;  // of a surface other points may be sampled
        }
        ++compared;
        for (const float time : {0.0f, 0.4f, 0.9f}) {
            CAPTURE(i, time);
            const auto emitted = light.sample_emission(random.next_2d(), random.next_2d(), time);
            REQUIRE(emitted.has_value());
            const auto incident =
                light.sample_incident({.p = emitted->end.p + 0.3f * emitted->direction}, Vec2(0.5f),
                                      EnvironmentSampling::plain, time);
            REQUIRE(incident.has_value());
            CHECK(dot(incident->wi, emitted->direction) == Approx(-1.0f));
        }
    }
    CHECK(compared == 4);  // a point, a spot, a sun and a luminaire
}

TEST_CASE("the tree of lights loses none of those that move, at any time", "[motion][light][tree]")
{
    const World world = lights_that_move();
    const LightSet& lights = world.lights();
    test::Random random(5);
    int contributions = 0;
    for (int k = 0; k < 2000; ++k) {
        const Vec3 p = 3.0f * Vec3(random.next(), random.next(), random.next()) - 1.5f;
        const LightSampleContext receiver{.p = p, .normal = random.direction()};
        for (std::uint32_t i = 0; i < lights.size(); ++i) {
            const float chosen =
                lights.context_probability(LightId{i}, receiver, LightSampling::tree);
            const float time = random.next();
            const auto incident = lights[LightId{i}].sample_incident(
                receiver, random.next_2d(), EnvironmentSampling::plain, time);
            if (incident && !is_black(incident->weight) &&
                dot(*receiver.normal, incident->wi) > 0.0f) {
                ++contributions;
                CAPTURE(k, i, time);
                REQUIRE(chosen > 0.0f);
            }
        }
    }
    CHECK(contributions > 2000);
}

}  // namespace bdpt::moving_light_test
