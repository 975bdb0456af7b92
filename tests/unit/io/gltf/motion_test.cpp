// What the reader makes of an animation while a shutter is open.

#include "../gltf_fixture.h"
#include "catch.hpp"

#include <bdpt/motion.h>
#include <bdpt/scene_desc.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <variant>

namespace bdpt::test::motion_test {
using namespace bdpt::io;

namespace {

constexpr double pi = 3.141592653589793;

/// Adds a channel that moves `node` to the only animation.
void animate(GltfFixture& fixture, int node, const std::string& path,
             const std::vector<float>& times, const std::string& type,
             const std::vector<float>& values, const std::string& interpolation = "LINEAR")
{
    const std::size_t width = type == "VEC3" ? 3 : type == "VEC4" ? 4 : 1;
    const int input = fixture.add_accessor(f32, "SCALAR", times.size(), bytes_of(times));
    const int output = fixture.add_accessor(f32, type, values.size() / width, bytes_of(values));
    nlohmann::json& animations = fixture.json["animations"];
    if (animations.empty()) {
        animations.push_back(
            {{"channels", nlohmann::json::array()}, {"samplers", nlohmann::json::array()}});
    }
    nlohmann::json& samplers = animations[0]["samplers"];
    animations[0]["channels"].push_back(
        {{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers.push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
}

std::vector<float> about_z(double degrees)
{
    const double half = degrees * pi / 360.0;
    return {0, 0, static_cast<float>(std::sin(half)), static_cast<float>(std::cos(half))};
}

std::vector<float> joined(std::vector<float> a, const std::vector<float>& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// A triangle that slides by (4, 8, -2) from second 1 to 3.
GltfFixture sliding()
{
    GltfFixture fixture = GltfFixture::triangle();
    animate(fixture, 0, "translation", {1, 3}, "VEC3", {0, 0, 0, 4, 8, -2});
    return fixture;
}

GltfOptions open_for(double time, double open, double close)
{
    return {.time = time, .shutter = Shutter{open, close}};
}

}  // namespace

TEST_CASE("what goes straight while the shutter is open goes in one step")
{
    const LoadedScene loaded = sliding().load(open_for(1.5, 0.0, 1.0));
    const InstanceDesc& instance = loaded.scene.instances.at(0);
    CHECK(instance.world_from_object[3] == Vec4(1, 2, -0.5, 1));
    REQUIRE(instance.motion.size() == 1);
    CHECK(instance.motion[0][3] == Vec4(3, 6, -1.5, 1));
    CHECK(loaded.warnings.empty());
    CHECK(loaded.scene.meshes.at(0).motion.empty());
    // Around the frame's time as well, and without a time from the beginning.
    const LoadedScene around = sliding().load(open_for(2.0, -0.5, 0.5));
    CHECK(around.scene.instances.at(0).world_from_object[3] == Vec4(1, 2, -0.5, 1));
    CHECK(around.scene.instances.at(0).motion.at(0)[3] == Vec4(3, 6, -1.5, 1));
    const LoadedScene first = sliding().load({.shutter = Shutter{0.0, 2.0}});
    CHECK(first.scene.instances.at(0).motion.size() > 1);  // it waits until second 1
    CHECK(first.scene.instances.at(0).motion.back()[3] == Vec4(2, 4, -1, 1));
}

TEST_CASE("a shutter of no length, or over nothing that moves, is a moment")
{
    const LoadedScene moment = sliding().load({.time = 2.0});
    for (const auto& options : {open_for(2.0, 0.0, 0.0), open_for(1.75, 0.25, 0.25)}) {
        const LoadedScene loaded = sliding().load(options);
        CHECK(loaded.scene.instances.at(0).motion.empty());
        CHECK(loaded.scene.instances.at(0).world_from_object ==
              moment.scene.instances.at(0).world_from_object);
        CHECK(loaded.warnings.empty());
    }
    const LoadedScene after = sliding().load(open_for(5.0, 0.0, 1.0));
    CHECK(after.scene.instances.at(0).motion.empty());
    CHECK(warns(after.warnings, {"/animations: from 5 s to 6 s", "nothing moves"}));
    CHECK(warns(GltfFixture::triangle().load(open_for(0.0, 0.0, 1.0)).warnings, {"no animations"}));
}

TEST_CASE("what turns goes in as many steps as it takes")
{
    GltfFixture fixture = GltfFixture::triangle();
    animate(fixture, 0, "rotation", {0, 1}, "VEC4", joined(about_z(0), about_z(90)));
    const auto steps = [&fixture](double close) {
        return fixture.load(open_for(0.0, 0.0, close)).scene.instances.at(0).motion.size();
    };
    CHECK(steps(0.02) == 1);  // 1.8 degrees
    CHECK(steps(0.05) == 2);
    CHECK(steps(1.0) == 32);  // 2.8 degrees each
    const LoadedScene loaded = fixture.load(open_for(0.0, 0.0, 1.0));
    const InstanceDesc& instance = loaded.scene.instances.at(0);
    for (std::size_t i = 0; i < instance.motion.size(); ++i) {
        CAPTURE(i);
        const double angle = 0.5 * pi * static_cast<double>(i + 1) / 32.0;
        CHECK(instance.motion[i][0].x == Approx(std::cos(angle)).margin(1e-6));
        CHECK(instance.motion[i][0].y == Approx(std::sin(angle)).margin(1e-6));
    }
    CHECK(can_move(instance.world_from_object, instance.motion));
    // A child goes along, and what stands beside it does not move.
    fixture.json["nodes"].push_back({{"mesh", 0}, {"translation", {5, 0, 0}}});
    fixture.json["nodes"].push_back({{"mesh", 0}});
    fixture.json["nodes"][0]["children"] = {1};
    fixture.json["scenes"][0]["nodes"] = {0, 2};
    const LoadedScene family = fixture.load(open_for(0.0, 0.0, 1.0));
    REQUIRE(family.scene.instances.size() == 3);
    CHECK(family.scene.instances[1].motion.size() == 32);
    CHECK(family.scene.instances[1].motion.back()[3].y == Approx(5.0));
    CHECK(family.scene.instances[2].motion.empty());
}

TEST_CASE("each thing has the steps that it needs")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["nodes"].push_back({{"mesh", 0}});
    fixture.json["scenes"][0]["nodes"] = {0, 1};
    animate(fixture, 0, "rotation", {0, 1}, "VEC4", joined(about_z(0), about_z(90)));
    animate(fixture, 1, "translation", {0, 1}, "VEC3", {0, 0, 0, 1, 0, 0});
    const LoadedScene loaded = fixture.load(open_for(0.0, 0.0, 1.0));
    CHECK(loaded.scene.instances.at(0).motion.size() == 32);
    CHECK(loaded.scene.instances.at(1).motion.size() == 1);
}

TEST_CASE("morph targets deform a mesh while the shutter is open")
{
    GltfFixture fixture = GltfFixture::triangle();
    auto& primitive = fixture.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["NORMAL"] =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}));
    const int up =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({0, 0, 1, 0, 0, 2, 0, 0, 4}));
    const int tilt =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({1, 0, 0, 1, 0, 0, 1, 0, 0}));
    primitive["targets"] = {{{"POSITION", up}, {"NORMAL", tilt}}};
    animate(fixture, 0, "weights", {0, 1}, "SCALAR", {0, 1});
    const LoadedScene loaded = fixture.load(open_for(0.25, 0.0, 0.5));
    const MeshDesc& mesh = loaded.scene.meshes.at(0);
    CHECK(mesh.positions[2] == Vec3(0, 1, 1));
    REQUIRE(mesh.motion.size() == 1);
    CHECK(mesh.motion[0].positions[2] == Vec3(0, 1, 3));
    REQUIRE(mesh.motion[0].normals.size() == 3);
    CHECK(mesh.motion[0].normals[0].x == Approx(0.6));
    CHECK(mesh.motion[0].tangents.empty());
    CHECK(loaded.scene.instances.at(0).motion.empty());
    // If its node turns, too, both have the steps that this takes.
    animate(fixture, 0, "rotation", {0, 1}, "VEC4", joined(about_z(0), about_z(90)));
    const LoadedScene both = fixture.load(open_for(0.0, 0.0, 1.0));
    CHECK(both.scene.instances.at(0).motion.size() == 32);
    CHECK(both.scene.meshes.at(0).motion.size() == 32);
    CHECK(both.scene.meshes[0].motion[15].positions[2].z == Approx(2.0));
}

TEST_CASE("joints deform a mesh while the shutter is open")
{
    GltfFixture fixture = GltfFixture::triangle();
    auto& attributes = fixture.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = fixture.add_accessor(
        u8, "VEC4", 3, bytes_of<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}));
    attributes["WEIGHTS_0"] = fixture.add_accessor(
        f32, "VEC4", 3, bytes_of<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}));
    fixture.json["nodes"][0]["skin"] = 0;
    fixture.json["nodes"].push_back({{"name", "a"}});
    fixture.json["nodes"].push_back({{"name", "b"}});
    fixture.json["scenes"][0]["nodes"] = {0, 1, 2};
    fixture.json["skins"] = {{{"joints", {1, 2}}}};
    animate(fixture, 2, "translation", {0, 1}, "VEC3", {0, 0, 0, 0, 0, 6});
    animate(fixture, 0, "translation", {0, 1}, "VEC3", {0, 0, 0, 100, 0, 0});  // does not count
    const LoadedScene loaded = fixture.load(open_for(0.0, 0.0, 0.5));
    const MeshDesc& mesh = loaded.scene.meshes.at(0);
    REQUIRE(mesh.motion.size() == 1);
    CHECK(mesh.motion[0].positions[0] == Vec3(0, 0, 0));
    CHECK(mesh.motion[0].positions[1] == Vec3(1, 0, 3));
    CHECK(mesh.motion[0].positions[2] == Vec3(0, 1, 1.5f));
    CHECK(loaded.scene.instances.at(0).motion.empty());
    CHECK(fixture.load(open_for(3.0, 0.0, 0.5)).scene.meshes.at(0).motion.empty());
}

TEST_CASE("cameras and lights move with their nodes")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    fixture.json["extensionsUsed"] = {"KHR_lights_punctual"};
    fixture.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", nlohmann::json::object()}},
        {{"type", "point"}},
        {{"type", "directional"}}};
    const auto light = [](int index) {
        return nlohmann::json{{"KHR_lights_punctual", {{"light", index}}}};
    };
    fixture.json["nodes"].push_back({{"camera", 0}});
    for (int i = 0; i < 3; ++i) {
        fixture.json["nodes"].push_back({{"extensions", light(i)}, {"translation", {1, 0, 0}}});
    }
    fixture.json["nodes"][1]["children"] = {2, 3, 4};
    fixture.json["scenes"][0]["nodes"] = {0, 1};
    const float s = std::sqrt(0.5f);
    animate(fixture, 1, "rotation", {0, 1}, "VEC4", {0, 0, 0, 1, 0, s, 0, s});  // 90 degrees
    const LoadedScene loaded = fixture.load(open_for(0.0, 0.0, 1.0));
    REQUIRE(loaded.cameras.size() == 1);
    CHECK(loaded.cameras[0].motion.size() == 32);
    CHECK(loaded.cameras[0].motion.back()[2].x == Approx(1.0));
    REQUIRE(loaded.scene.lights.size() == 3);
    const auto& spot = std::get<SpotLightDesc>(loaded.scene.lights[0]);
    REQUIRE(spot.motion.size() > 1);
    CHECK(spot.motion.back().z == Approx(-1.0));
    REQUIRE(spot.later_directions.size() >= 8);
    CHECK(spot.later_directions.back().x == Approx(-1.0));
    const auto& point = std::get<PointLightDesc>(loaded.scene.lights[1]);
    CHECK(point.motion.back().z == Approx(-1.0));
    CHECK(std::get<DirectionalLightDesc>(loaded.scene.lights[2]).later_directions.size() >= 8);
    CHECK(loaded.scene.instances.at(0).motion.empty());
}

TEST_CASE("cameras and lights start where they are when the shutter opens")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    fixture.json["extensionsUsed"] = {"KHR_lights_punctual"};
    fixture.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", nlohmann::json::object()}},
        {{"type", "point"}},
        {{"type", "directional"}}};
    fixture.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 2}}});
    for (int i = 0; i < 3; ++i) {
        fixture.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}},
                                         {"translation", {1, 0, 0}}});
    }
    fixture.json["nodes"].push_back({{"children", {1, 2, 3, 4}}});
    fixture.json["scenes"][0]["nodes"] = {0, 5};
    const float s = std::sqrt(0.5f);
    animate(fixture, 5, "rotation", {0, 1}, "VEC4", {0, 0, 0, 1, 0, s, 0, s});  // +z goes to +x
    // At rest, when the shutter opens and when it closes it looks in three directions.
    const LoadedScene loaded = fixture.load(open_for(0.5, 0.0, 0.5));
    const Vec3 back(s, 0, s);
    const auto check = [](Vec3 value, Vec3 expected) {
        CAPTURE(value.x, value.y, value.z);
        CHECK(glm::distance(value, expected) < 1e-5f);
    };
    REQUIRE(loaded.cameras.size() == 1);
    REQUIRE_FALSE(loaded.cameras[0].motion.empty());
    check(Vec3(loaded.cameras[0].world_from_camera[2]), back);
    check(Vec3(loaded.cameras[0].world_from_camera[3]), 2.0f * back);
    check(Vec3(loaded.cameras[0].motion.back()[2]), {1, 0, 0});
    REQUIRE(loaded.scene.lights.size() == 3);
    const auto& spot = std::get<SpotLightDesc>(loaded.scene.lights[0]);
    check(spot.position, {s, 0, -s});
    check(spot.direction, -back);
    check(spot.later_directions.back(), {-1, 0, 0});
    check(std::get<PointLightDesc>(loaded.scene.lights[1]).position, {s, 0, -s});
    check(std::get<DirectionalLightDesc>(loaded.scene.lights[2]).direction, -back);
}

TEST_CASE("what has no inverse on its way deforms instead")
{
    GltfFixture fixture = GltfFixture::triangle();
    animate(fixture, 0, "scale", {0, 1}, "VEC3", {0, 0, 0, 2, 2, 2});
    const LoadedScene loaded = fixture.load(open_for(0.0, 0.0, 1.0));
    const InstanceDesc& instance = loaded.scene.instances.at(0);
    CHECK(instance.motion.empty());
    CHECK(instance.world_from_object == Mat4(1.0f));
    const MeshDesc& mesh = loaded.scene.meshes.at(static_cast<std::size_t>(instance.mesh));
    CHECK(mesh.positions[1] == Vec3(0.0f));
    REQUIRE(mesh.motion.size() == 1);
    CHECK(mesh.motion[0].positions[1] == Vec3(2, 0, 0));

    // Through a mirror: the front is that of the opening.
    GltfFixture flip = GltfFixture::triangle();
    animate(flip, 0, "scale", {0, 1}, "VEC3", {-1, 1, 1, 1, 1, 1});
    const LoadedScene flipped = flip.load(open_for(0.0, 0.0, 1.0));
    const InstanceDesc& turned = flipped.scene.instances.at(0);
    const MeshDesc& shown = flipped.scene.meshes.at(static_cast<std::size_t>(turned.mesh));
    const UVec3 corners = shown.triangles.at(0);
    const Vec3 a = shown.positions[corners.x];
    CHECK(cross(shown.positions[corners.y] - a, shown.positions[corners.z] - a).z > 0.0f);
}

TEST_CASE("what jumps while the shutter is open stands still if it must")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}}};
    fixture.json["nodes"].push_back({{"camera", 0}});
    fixture.json["scenes"][0]["nodes"] = {0, 1};
    animate(fixture, 1, "rotation", {0, 0.5, 1}, "VEC4",
            joined(joined(about_z(0), about_z(180)), about_z(180)), "STEP");
    const LoadedScene loaded = fixture.load(open_for(0.0, 0.0, 1.0));
    CHECK(loaded.cameras.at(0).motion.empty());
    CHECK(warns(loaded.warnings, {"/nodes/1", "a camera whose direction jumps stands still"}));
}

TEST_CASE("shutters that make no sense are refused")
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Shutter& shutter : {Shutter{0.0, -0.1}, Shutter{nan, 1.0}, Shutter{0.0, nan},
                                   Shutter{0.0, std::numeric_limits<double>::infinity()}}) {
        const Error error = sliding().error({.time = 1.0, .shutter = shutter});
        CHECK(error.code() == ErrorCode::usage);
        CHECK(contains(error.what(), "invalid shutter"));
    }
}

}  // namespace bdpt::test::motion_test
