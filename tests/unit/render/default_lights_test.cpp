#include <bdpt/default_lights.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace bdpt::default_lights_test {
namespace {

const MaterialDesc wall = test::lambertian(Rgb(0.7f));

}  // namespace

TEST_CASE("default environments are grey and 1 nit on average", "[default_lights]")
{
    const bool is_object = GENERATE(false, true);
    const Image sky =
        (is_object ? object_environment() : default_environment()).radiance.to_image();
    REQUIRE(sky.height > 1);
    double sum = 0.0;
    double weights = 0.0;
    for (int y = 0; y < sky.height; ++y) {
        const double polar = std::numbers::pi * (y + 0.5) / sky.height;
        for (int x = 0; x < sky.width; ++x) {
            const Rgb value = sky.at(x, y);
            CHECK(value.r == value.g);
            CHECK(value.g == value.b);
            CHECK(value.r > 0.0f);
            sum += std::sin(polar) * static_cast<double>(value.g);
            weights += std::sin(polar);
        }
    }
    CHECK(sum / weights == Approx(1.0).epsilon(1e-4));
}

/// Radiance of a white diffuse surface [nit], by all texels. Columns go from +z by -x and -z to +x.
double card(const Image& sky, Vec3 normal)
{
    double sum = 0.0;
    for (int y = 0; y < sky.height; ++y) {
        const double polar = std::numbers::pi * (y + 0.5) / sky.height;
        for (int x = 0; x < sky.width; ++x) {
            const double azimuth = 2.0 * std::numbers::pi * (x + 0.5) / sky.width;
            const Vec3 direction(-std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                 std::sin(polar) * std::cos(azimuth));
            const double cosine = std::max(0.0f, dot(direction, normal));
            const double texel = std::sin(polar) * 2.0 * std::numbers::pi * std::numbers::pi /
                                 (sky.width * sky.height);
            sum += cosine * texel * static_cast<double>(sky.at(x, y).g);
        }
    }
    return sum / std::numbers::pi;
}

TEST_CASE("sides of a box that face different ways differ under the default environment",
          "[default_lights]")
{
    const Image sky = default_environment().radiance.to_image();
    const auto irradiance = [&](Vec3 normal) { return card(sky, normal); };
    const double top = irradiance({0.0f, 1.0f, 0.0f});
    const double front = irradiance({0.0f, 0.0f, 1.0f});
    const double right = irradiance({1.0f, 0.0f, 0.0f});
    CHECK(top > 1.15 * front);
    CHECK(front > 1.25 * right);
    CHECK(irradiance({-1.0f, 0.0f, 0.0f}) > 1.25 * right);  // the key is on the left
    CHECK(irradiance({0.0f, -1.0f, 0.0f}) > 0.2 * top);     // but nothing is black
    CHECK(irradiance({0.0f, 0.0f, -1.0f}) > 0.3 * top);
}

TEST_CASE(
    "objects are brighter than what is behind them, and their sides differ, under their light",
    "[default_lights]")
{
    const Image sky = object_environment().radiance.to_image();
    const double top = card(sky, {0.0f, 1.0f, 0.0f});
    const double front = card(sky, {0.0f, 0.0f, 1.0f});
    const double right = card(sky, {1.0f, 0.0f, 0.0f});
    CHECK(top > 1.15 * front);
    CHECK(front > 2.0 * right);
    CHECK(card(sky, {0.0f, -1.0f, 0.0f}) > 0.2 * top);  // nothing is black
    CHECK(card(sky, {0.0f, 0.0f, -1.0f}) > 1.25 * right);
    // What is behind them in views from their right front; white paint reflects 0.8.
    for (int y = sky.height / 2; y < sky.height; ++y) {
        for (int x = sky.width * 5 / 16; x < sky.width / 2; ++x) {
            CHECK(static_cast<double>(sky.at(x, y).g) < 0.8 * 0.7 * front);
        }
    }
}

TEST_CASE("there is no edge at the horizon of default environments", "[default_lights]")
{
    // The radiance changes there as it does a row above and a row below.
    const bool is_object = GENERATE(false, true);
    const Image sky =
        (is_object ? object_environment() : default_environment()).radiance.to_image();
    const int below = sky.height / 2;
    // Lights of objects are so narrow that they change it; behind objects there are none.
    const int first = is_object ? sky.width * 5 / 16 : 0;
    const int last = is_object ? sky.width / 2 : sky.width;
    for (int x = first; x < last; ++x) {
        const auto step = [&](int y) { return sky.at(x, y - 1).g - sky.at(x, y).g; };
        CHECK(std::abs(step(below) - 0.5f * (step(below - 1) + step(below + 1))) < 0.02f);
    }
}

TEST_CASE("the default lamp gives 1 nit at the camera's distance, whatever the scale",
          "[default_lights]")
{
    const float scale = GENERATE(1e-3f, 1.0f, 1e3f);
    FramedView view;
    view.camera.world_from_camera[3] = Vec4(0.0f, 0.0f, scale * 3.0f, 1.0f);
    view.lamp_position = Vec3(0.0f, scale * 4.0f, 0.0f);
    const PointLightDesc lamp = default_lamp(view);
    CHECK(lamp.position == view.lamp_position);
    const float distance = scale * 5.0f;
    CHECK(lamp.intensity.g / (distance * distance) == Approx(std::numbers::pi));
}

TEST_CASE("light is found where it is", "[default_lights]")
{
    SceneDesc desc;
    desc.materials.resize(2);
    desc.materials[1].emission = Rgb(0.0f, 0.0f, 2.0f);
    desc.instances.resize(1);
    CHECK_FALSE(has_light(desc));
    SECTION("in a material that is used")
    {
        desc.instances[0].material = MaterialId{1};
        CHECK(has_light(desc));
    }
    SECTION("in a lamp")
    {
        desc.lights.emplace_back(PointLightDesc{});
        CHECK(has_light(desc));
    }
}

TEST_CASE("a scene without light is told, and one with light or unlit surfaces is not",
          "[default_lights]")
{
    const std::vector<std::string> told{"no light: the image will be black"};
    test::SceneBuilder dark;
    dark.walls(wall, wall);
    const Scene scene(dark.desc);
    CHECK(scene.warnings() == told);
    CHECK(scene.with_lights({default_environment()}).warnings().empty());
    CHECK(add_default_lights(dark.desc) == DefaultLights::object);
    CHECK(Scene(dark.desc).warnings().empty());
    test::SceneBuilder unlit;
    MaterialDesc text = wall;
    text.unlit = true;
    unlit.walls(text, text);
    CHECK(Scene(unlit.desc).warnings().empty());
}

TEST_CASE("a room without light gets a sky, and a closed one a lamp, too", "[default_lights]")
{
    test::SceneBuilder open;
    open.walls(wall, wall).ceiling(wall);
    CHECK(add_default_lights(open.desc) == DefaultLights::sky);
    REQUIRE(open.desc.lights.size() == 1);
    CHECK(std::holds_alternative<EnvironmentLightDesc>(open.desc.lights[0]));
    CHECK(add_default_lights(open.desc) == DefaultLights::none);
    CHECK(open.desc.lights.size() == 1);

    test::SceneBuilder closed;
    closed.walls(wall, wall).ceiling(wall).front(wall);
    CHECK(add_default_lights(closed.desc) == DefaultLights::sky_and_lamp);
    REQUIRE(closed.desc.lights.size() == 2);
    const Vec3 lamp = std::get<PointLightDesc>(closed.desc.lights[1]).position;
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(std::abs(lamp[axis]) < 1.0f);
    }
}

TEST_CASE("emitters that light an open scene are its light, those that glow are none",
          "[default_lights]")
{
    test::SceneBuilder lit;
    lit.walls(wall, wall).ceiling(wall).lamp(0.98f, 0.3f, Rgb(5.0f));
    CHECK(add_default_lights(lit.desc) == DefaultLights::none);
    CHECK(lit.desc.lights.empty());

    test::SceneBuilder glows;
    glows.sphere({0, 0, 0}, 1.0f, wall).sphere({0, 1.1f, 0}, 0.1f, test::emitter(Rgb(1.0f)));
    CHECK(add_default_lights(glows.desc) == DefaultLights::object);
    CHECK(glows.desc.lights.size() == 1);
}

TEST_CASE("an emitter above a floor is its light if half of the floor is lit", "[default_lights]")
{
    // However bright it is: a small one lights only the part below it.
    const auto lights_beside_emitter = [](float half_side) {
        test::SceneBuilder scene;
        scene.quad({-4, -1, 4}, {4, -1, 4}, {4, -1, -4}, {-4, -1, -4}, wall);
        scene.quad({-half_side, -0.5f, half_side}, {-half_side, -0.5f, -half_side},
                   {half_side, -0.5f, -half_side}, {half_side, -0.5f, half_side},
                   test::emitter(Rgb(50.0f)));
        return add_default_lights(scene.desc);
    };
    CHECK(lights_beside_emitter(0.05f) == DefaultLights::object);
    CHECK(lights_beside_emitter(2.0f) == DefaultLights::none);
}

TEST_CASE("emitters of a closed room are its light, unless they light next to nothing",
          "[default_lights]")
{
    const auto room = [](float radiance) {
        test::SceneBuilder closed;
        closed.walls(wall, wall).ceiling(wall).front(wall).lamp(0.98f, 0.1f, Rgb(radiance));
        return closed.desc;
    };
    SceneDesc dim = room(1.0f);
    CHECK(add_default_lights(dim) == DefaultLights::none);
    CHECK(dim.lights.empty());
    SceneDesc dark = room(1e-3f);
    CHECK(add_default_lights(dark) == DefaultLights::sky_and_lamp);
    CHECK(dark.lights.size() == 2);
}

}  // namespace bdpt::default_lights_test
