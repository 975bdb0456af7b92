#include "../gltf_fixture.h"
#include "catch.hpp"

#include <bdpt/scene_desc.h>

#include <variant>

namespace bdpt::test::lights_test {
using namespace bdpt::io;

namespace {

/// One node for each light, turned so that -z becomes +x.
GltfFixture with_lights(const nlohmann::json& lights)
{
    GltfFixture fixture;
    fixture.json["extensionsUsed"] = {"KHR_lights_punctual"};
    fixture.json["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        fixture.json["nodes"].push_back(
            {{"name", "holder"},
             {"translation", {1, 2, 3}},
             {"rotation", {0, -0.70710678118654752, 0, 0.70710678118654752}},
             {"scale", {5, 5, 5}},
             {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
        fixture.json["scenes"][0]["nodes"].push_back(i);
    }
    return fixture;
}

template <typename Light>
Light only_light(const LoadedScene& loaded)
{
    REQUIRE(loaded.scene.lights.size() == 1);
    REQUIRE(std::holds_alternative<Light>(loaded.scene.lights[0]));
    return std::get<Light>(loaded.scene.lights[0]);
}

bool close(Vec3 a, Vec3 b)
{
    return std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z) < 1e-6f;
}

}  // namespace

TEST_CASE("a point light is where its node is")
{
    const LoadedScene loaded =
        with_lights(
            {{{"type", "point"}, {"name", "bulb"}, {"color", {1, 0.5, 0}}, {"intensity", 40}}})
            .load();
    const auto light = only_light<PointLightDesc>(loaded);
    CHECK(light.name == "bulb");
    CHECK(light.position == Vec3(1, 2, 3));
    CHECK(light.intensity == Rgb(40, 20, 0));
    CHECK(loaded.facts.lights == 1);
    CHECK(loaded.warnings.empty());
}

TEST_CASE("a directional light travels along -z of its node")
{
    const LoadedScene loaded =
        with_lights({{{"type", "directional"}, {"intensity", 5000000000}}}).load();
    const auto light = only_light<DirectionalLightDesc>(loaded);
    CHECK(light.name == "holder");
    CHECK(close(light.direction, {1, 0, 0}));
    CHECK(light.illuminance == Rgb(5e9f));
}

TEST_CASE("a spot light has its cone angles")
{
    const LoadedScene loaded =
        with_lights({{{"type", "spot"},
                      {"intensity", 3},
                      {"range", 10},
                      {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}})
            .load();
    const auto light = only_light<SpotLightDesc>(loaded);
    CHECK(light.position == Vec3(1, 2, 3));
    CHECK(close(light.direction, {1, 0, 0}));
    CHECK(light.intensity == Rgb(3));
    CHECK(light.inner_cone_angle == 0.25f);
    CHECK(light.outer_cone_angle == 0.5f);
    CHECK(warns(loaded.warnings, {"lights/0/range: 10", "ignored"}));
}

TEST_CASE("a spot light's defaults are those of the extension")
{
    const auto light = only_light<SpotLightDesc>(
        with_lights({{{"type", "spot"}, {"spot", nlohmann::json::object()}}}).load());
    CHECK(light.intensity == Rgb(1));
    CHECK(light.inner_cone_angle == 0.0f);
    CHECK(light.outer_cone_angle == Approx(0.785398163));
}

TEST_CASE("impossible cones and intensities are brought into their ranges")
{
    const LoadedScene wide =
        with_lights({{{"type", "spot"},
                      {"intensity", -1},
                      {"spot", {{"innerConeAngle", 2}, {"outerConeAngle", 3}}}}})
            .load();
    const auto light = only_light<SpotLightDesc>(wide);
    CHECK(light.outer_cone_angle == Approx(1.5707963));
    CHECK(light.inner_cone_angle < light.outer_cone_angle);
    CHECK(light.intensity == Rgb(0));
    CHECK(warns(wide.warnings, {"lights/0/spot: 2 and 3"}));
    CHECK(warns(wide.warnings, {"lights/0: -1"}));

    // Equal angles are allowed; the cone only must not be quite sharp.
    const LoadedScene sharp =
        with_lights(
            {{{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}}}}})
            .load();
    CHECK(only_light<SpotLightDesc>(sharp).inner_cone_angle < 0.5f);
    CHECK(only_light<SpotLightDesc>(sharp).inner_cone_angle > 0.4999f);
}

TEST_CASE("extras.radius makes a sphere, in the units of the node")
{
    const auto point = only_light<PointLightDesc>(
        with_lights({{{"type", "point"}, {"extras", {{"radius", 0.25}}}}}).load());
    CHECK(point.radius == Approx(1.25));
    const auto spot = only_light<SpotLightDesc>(
        with_lights(
            {{{"type", "spot"}, {"spot", nlohmann::json::object()}, {"extras", {{"radius", 2}}}}})
            .load());
    CHECK(spot.radius == Approx(10.0));

    // The mean of the axes is the geometric one; mirrors do not matter, parents count.
    GltfFixture fixture = with_lights({{{"type", "point"}, {"extras", {{"radius", 0.5}}}}});
    fixture.json["nodes"][0]["scale"] = {1, -2, 4};
    fixture.json["nodes"].push_back({{"scale", {3, 3, 3}}, {"children", {0}}});
    fixture.json["scenes"][0]["nodes"] = {1};
    CHECK(only_light<PointLightDesc>(fixture.load()).radius == Approx(3.0));
}

TEST_CASE("a radius that is none is ignored with a warning")
{
    const auto loaded = [](const nlohmann::json& radius, const char* type) {
        return with_lights({{{"type", type}, {"extras", {{"radius", radius}}}}}).load();
    };
    const LoadedScene negative = loaded(-0.5, "point");
    CHECK(only_light<PointLightDesc>(negative).radius == 0.0f);
    CHECK(warns(negative.warnings, {"lights/0/extras/radius: -0.5", "ignored"}));
    const LoadedScene text = loaded("wide", "point");
    CHECK(only_light<PointLightDesc>(text).radius == 0.0f);
    CHECK(warns(text.warnings, {"lights/0/extras/radius", "not a number"}));
    CHECK(warns(loaded(1, "directional").warnings, {"directional", "ignored"}));
    CHECK(loaded(0, "point").warnings.empty());
    // Other extras are nobody's business here.
    const LoadedScene other = with_lights({{{"type", "point"}, {"extras", "anything"}}}).load();
    CHECK(only_light<PointLightDesc>(other).radius == 0.0f);
    CHECK(other.warnings.empty());
}

TEST_CASE("lights that are wrong are refused")
{
    const auto message = [](const nlohmann::json& light, ErrorCode code) {
        const Error error = with_lights(nlohmann::json::array({light})).error();
        CHECK(error.code() == code);
        return std::string(error.what());
    };
    CHECK(contains(message({{"type", "laser"}}, ErrorCode::unsupported),
                   "/extensions/KHR_lights_punctual/lights/0/type: \"laser\""));
    CHECK(contains(message({{"type", "spot"}}, ErrorCode::invalid_input), "\"spot\" is missing"));
    CHECK(contains(message({{"type", "point"}, {"color", {1, 1}}}, ErrorCode::invalid_input),
                   "/lights/0/color: must be 3 numbers"));

    GltfFixture fixture = with_lights({{{"type", "point"}}});
    fixture.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 1;
    CHECK(contains(
        fixture.error().what(),
        "/nodes/0/extensions/KHR_lights_punctual/light: index 1, but the number of lights is 1"));
}

}  // namespace bdpt::test::lights_test
