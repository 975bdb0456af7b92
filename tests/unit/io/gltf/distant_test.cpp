// Scenes far from the origin, as on a map.

#include "../gltf_fixture.h"
#include "catch.hpp"

#include <bdpt/aov.h>
#include <bdpt/render.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace bdpt::test::distant_test {
using namespace bdpt::io;

namespace {

/// Hangs all of the scene on a node at this place.
GltfFixture moved(GltfFixture fixture, const DVec3& to)
{
    nlohmann::json& roots = fixture.json["scenes"][0]["nodes"];
    fixture.json["nodes"].push_back({{"translation", {to.x, to.y, to.z}}, {"children", roots}});
    roots = {fixture.json["nodes"].size() - 1};
    return fixture;
}

/// Places in the file, all of which the loader converts: vertices, cameras and lights at all times.
std::vector<DVec3> places_of(const LoadedScene& loaded)
{
    std::vector<DVec3> places;
    const auto add = [&](const Mat4& world, Vec3 point) {
        places.push_back(DVec3(glm::dmat4(world) * glm::dvec4(DVec3(point), 1.0)) +
                         loaded.scene.origin);
    };
    for (const InstanceDesc& instance : loaded.scene.instances) {
        const MeshDesc& mesh = loaded.scene.meshes.at(static_cast<std::size_t>(instance.mesh));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            add(instance.world_from_object, mesh.positions[i]);
            for (const Mat4& later : instance.motion) {
                add(later, mesh.positions[i]);
            }
            for (const MeshPose& pose : mesh.motion) {
                add(instance.world_from_object, pose.positions[i]);
            }
        }
    }
    for (const CameraDesc& camera : loaded.cameras) {
        add(camera.world_from_camera, Vec3(0.0f));
        for (const Mat4& later : camera.motion) {
            add(later, Vec3(0.0f));
        }
    }
    for (const LightDesc& light : loaded.scene.lights) {
        std::visit(
            [&](const auto& of_kind) {
                if constexpr (requires { of_kind.position; }) {
                    add(Mat4(1.0f), of_kind.position);
                    for (const Vec3& later : of_kind.motion) {
                        add(Mat4(1.0f), later);
                    }
                }
            },
            light);
    }
    return places;
}

double greatest_difference(const std::vector<DVec3>& a, const std::vector<DVec3>& b,
                           const DVec3& offset)
{
    REQUIRE(a.size() == b.size());
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        greatest = std::max(greatest, glm::length(a[i] - offset - b[i]));
    }
    return greatest;
}

/// Moves these nodes by (4, 8, -2) within a second.
void slide(GltfFixture& fixture, const std::vector<int>& nodes)
{
    const int times = fixture.add_accessor(f32, "SCALAR", 2, bytes_of<float>({0, 1}));
    const int values = fixture.add_accessor(f32, "VEC3", 2, bytes_of<float>({0, 0, 1, 4, 8, -1}));
    nlohmann::json channels = nlohmann::json::array();
    for (const int node : nodes) {
        channels.push_back({{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}});
    }
    fixture.json["animations"] = {
        {{"channels", channels},
         {"samplers", {{{"input", times}, {"output", values}, {"interpolation", "LINEAR"}}}}}};
}

/// One of everything that has a place: meshes that are turned, mirrored, flat, instanced, moving
/// and skinned, cameras and lights.
GltfFixture everything()
{
    GltfFixture fixture = GltfFixture::triangle();
    const int offsets = fixture.add_accessor(f32, "VEC3", 2, bytes_of<float>({0, 1, 0, 0, 2, 0}));
    const int joints = fixture.add_accessor(
        u8, "VEC4", 3, bytes_of<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}));
    const int weights = fixture.add_accessor(
        f32, "VEC4", 3, bytes_of<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.25f, 0.75f, 0, 0}));
    nlohmann::json skinned = fixture.json["meshes"][0];
    skinned["primitives"][0]["attributes"]["JOINTS_0"] = joints;
    skinned["primitives"][0]["attributes"]["WEIGHTS_0"] = weights;
    fixture.json["meshes"].push_back(skinned);
    fixture.json["skins"] = {{{"joints", {6, 7}}}};
    fixture.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.01}}}}};
    fixture.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}}, {{"type", "spot"}, {"spot", nlohmann::json::object()}}};
    const auto light = [](int index) {
        return nlohmann::json{{"KHR_lights_punctual", {{"light", index}}}};
    };
    fixture.json["extensionsUsed"] = {"KHR_lights_punctual", "EXT_mesh_gpu_instancing"};
    fixture.json["nodes"] = {
        {{"mesh", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, 0, 2, 2}}},
        {{"mesh", 0}, {"scale", {-1, 1, 2}}, {"translation", {-2, 0, 0}}},
        {{"mesh", 0}, {"scale", {1, 1, 0}}, {"translation", {0, 1, -2}}},
        {{"mesh", 0},
         {"extensions",
          {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", offsets}}}}}}}},
        {{"mesh", 0}},
        {{"mesh", 1}, {"skin", 0}},
        {{"translation", {0, 0, -3}}, {"children", {7}}},
        {{"translation", {0, 3, 0}}},
        {{"camera", 0}, {"translation", {0, 0, 5}}},
        {{"camera", 0}},
        {{"extensions", light(0)}, {"translation", {0, 4, 0}}},
        {{"extensions", light(1)}}};
    fixture.json["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5, 6, 8, 9, 10, 11};
    slide(fixture, {4, 7, 9, 11});
    return fixture;
}

GltfOptions with_motion(std::shared_ptr<MemoryBudget> memory)
{
    GltfOptions options;
    options.shutter = Shutter{.open = 0.0, .close = 1.0};
    options.memory = std::move(memory);
    return options;
}

std::shared_ptr<MemoryBudget> ample_memory()
{
    return std::make_shared<MemoryBudget>(
        MemoryLimit{.bytes = std::uint64_t{1} << 30U, .source = "test"});
}

/// Adds a box with its faces outwards and a material.
void add_box(GltfFixture& fixture, Vec3 min, Vec3 max, const nlohmann::json& material)
{
    std::vector<float> corners;
    for (unsigned vertex = 0; vertex < 8; ++vertex) {
        for (unsigned axis = 0; axis < 3; ++axis) {
            corners.push_back((vertex >> axis & 1U) != 0 ? max[static_cast<int>(axis)]
                                                         : min[static_cast<int>(axis)]);
        }
    }
    const std::vector<std::uint16_t> indices{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                             2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    const int positions = fixture.add_accessor(f32, "VEC3", 8, bytes_of(corners));
    const int faces = fixture.add_accessor(u16, "SCALAR", indices.size(), bytes_of(indices));
    fixture.json["materials"].push_back(material);
    fixture.add_mesh_node({{"attributes", {{"POSITION", positions}}},
                           {"indices", faces},
                           {"material", fixture.json["materials"].size() - 1}});
}

void add_camera(GltfFixture& fixture, const nlohmann::json& camera, float z)
{
    fixture.json["cameras"].push_back(camera);
    fixture.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, z}}});
    fixture.json["scenes"][0]["nodes"].push_back(fixture.json["nodes"].size() - 1);
}

/// A room of 2 m with a lamp 1 cm below its ceiling.
GltfFixture room()
{
    GltfFixture fixture;
    add_box(fixture, Vec3(-1.0f), Vec3(1.0f),
            {{"doubleSided", true},
             {"pbrMetallicRoughness",
              {{"baseColorFactor", {0.7, 0.7, 0.7, 1}}, {"metallicFactor", 0}}}});
    add_box(fixture, {-0.3f, 0.99f, -0.3f}, {0.3f, 0.992f, 0.3f},
            {{"emissiveFactor", {1, 1, 1}}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}});
    add_camera(fixture,
               {{"type", "perspective"}, {"perspective", {{"yfov", 1.2}, {"znear", 0.01}}}}, 0.95f);
    return fixture;
}

/// A pane of glass before a wall of 1 nit.
GltfFixture pane(float thickness)
{
    GltfFixture fixture;
    fixture.json["extensionsUsed"] = {"KHR_materials_transmission", "KHR_materials_volume"};
    add_box(fixture, {-1.0f, -1.0f, 0.0f}, {1.0f, 1.0f, thickness},
            {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0}}},
             {"extensions",
              {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
               {"KHR_materials_volume", {{"thicknessFactor", 1}}}}}});
    add_box(fixture, {-3.0f, -3.0f, -2.0f}, {3.0f, 3.0f, -1.0f},
            {{"emissiveFactor", {1, 1, 1}},
             {"pbrMetallicRoughness",
              {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}});
    add_camera(fixture,
               {{"type", "orthographic"},
                {"orthographic", {{"xmag", 0.5}, {"ymag", 0.5}, {"znear", 0}, {"zfar", 10}}}},
               2.0f);
    return fixture;
}

Image picture_of(const LoadedScene& loaded, IntegratorKind integrator)
{
    RenderOptions options;
    options.film.width = 4;
    options.film.height = 4;
    options.sampling.samples = {0, 64};
    options.integrator = integrator;
    return render(Scene(loaded.scene), loaded.cameras.at(0), options).film.develop();
}

constexpr std::array kinds{IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt};
const std::array<DVec3, 4> far_places{DVec3(12800, 0, 8000), DVec3(-128000, 0, 64000),
                                      DVec3(0, 0, 512000), DVec3(448000, 96, -5411840)};

}  // namespace

TEST_CASE("everything far from the origin is as precise as near it", "[distant]")
{
    const auto near_memory = ample_memory();
    const LoadedScene near = everything().load(with_motion(near_memory));
    CHECK(near.scene.origin == DVec3(0.0));
    REQUIRE(near.scene.instances.size() == 7);
    for (const DVec3& place : far_places) {
        CAPTURE(place.x, place.y, place.z);
        const auto memory = ample_memory();
        const LoadedScene far = moved(everything(), place).load(with_motion(memory));
        CHECK(glm::length(far.scene.origin - place) < 20.0);
        CHECK(greatest_difference(places_of(far), places_of(near), place) < 4e-6);
        // What the first reading told and took does not count twice.
        CHECK(far.warnings == near.warnings);
        CHECK(memory->spent() - near_memory->spent() < 2'000);
    }
}

TEST_CASE("vertices on a map are stored around their centre", "[distant]")
{
    const std::vector<float> vertices{448000.03125f, 96.5f,     5411840.5f, 448001.5f, 96.5f,
                                      5411840.5f,    448000.5f, 97.25f,     5411842.0f};
    GltfFixture fixture;
    const int positions = fixture.add_accessor(f32, "VEC3", 3, bytes_of(vertices));
    const int rise =
        fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({0, 1, 0, 0, 1, 0, 0, 1, 0}));
    fixture.add_mesh_node(
        {{"attributes", {{"POSITION", positions}}}, {"targets", {{{"POSITION", rise}}}}});
    const int times = fixture.add_accessor(f32, "SCALAR", 2, bytes_of<float>({0, 1}));
    const int weights = fixture.add_accessor(f32, "SCALAR", 2, bytes_of<float>({0, 1}));
    fixture.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers", {{{"input", times}, {"output", weights}, {"interpolation", "LINEAR"}}}}}};
    fixture.json["meshes"][0]["weights"] = {0};
    // With identity, and with a node that undoes the coordinates.
    for (const DVec3& node : {DVec3(0.0), DVec3(-448000, -96, -5411840)}) {
        CAPTURE(node.x);
        fixture.json["nodes"][0]["translation"] = {node.x, node.y, node.z};
        const LoadedScene loaded = fixture.load(with_motion(ample_memory()));
        CHECK((loaded.scene.origin == DVec3(0.0)) == (node != DVec3(0.0)));
        const MeshDesc& mesh = loaded.scene.meshes.at(0);
        REQUIRE(mesh.motion.size() == 1);
        std::vector<DVec3> expected;
        for (std::size_t i = 0; i < 3; ++i) {
            const DVec3 vertex(Vec3(vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]));
            expected.push_back(vertex + node);
            expected.push_back(vertex + node + DVec3(0, 1, 0));
            CHECK(glm::length(mesh.positions[i]) < 100.0f);
            CHECK(glm::length(mesh.motion[0].positions[i]) < 100.0f);
        }
        CHECK(places_of(loaded) == expected);
        CHECK(glm::length(Vec3(loaded.scene.instances.at(0).world_from_object[3])) < 100.0f);
    }
}

TEST_CASE("only what is far away gets an origin", "[distant]")
{
    GltfFixture fixture = GltfFixture::triangle();
    CHECK(fixture.load().scene.origin == DVec3(0.0));
    const auto origin_at = [&fixture](double x) {
        return moved(fixture, {x, 0.0, 0.0}).load().scene.origin;
    };
    CHECK(origin_at(12.0) == DVec3(0.0));
    CHECK(glm::length(origin_at(-1000.0) - DVec3(-1000.0, 0.0, 0.0)) < 1.0);
    // Coordinates that are refused are not made small first.
    CHECK(origin_at(2e15) == DVec3(0.0));
    CHECK_THROWS_AS(Scene(moved(fixture, {2e15, 0.0, 0.0}).load().scene), bdpt::Error);
    // A lamp or a camera is no scene.
    fixture.json["extensionsUsed"] = {"KHR_lights_punctual"};
    fixture.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    fixture.json["nodes"].push_back(
        {{"translation", {1e6, 0, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    fixture.json["scenes"][0]["nodes"] = {0, 1};
    CHECK(fixture.load().scene.origin == DVec3(0.0));
    CHECK(glm::length(origin_at(-1000.0) - DVec3(-1000.0, 0.0, 0.0)) < 1.0);
}

TEST_CASE("a room far from the origin gets the bits of one at the origin", "[distant]")
{
    for (const IntegratorKind kind : kinds) {
        const Image near = picture_of(room().load(), kind);
        for (const DVec3& place : far_places) {
            CAPTURE(static_cast<int>(kind), place.x, place.z);
            CHECK(picture_of(moved(room(), place).load(), kind).pixels == near.pixels);
        }
    }
}

TEST_CASE("a thin pane far from the origin lets through what physics says", "[distant]")
{
    for (const float thickness : {4e-3f, 1e-4f}) {
        const LoadedScene far = moved(pane(thickness), {10000, 0, 3000}).load();
        for (const IntegratorKind kind : kinds) {
            CAPTURE(thickness, static_cast<int>(kind));
            const Image image = picture_of(far, kind);
            double mean = 0.0;
            for (const Rgb& pixel : image.pixels) {
                mean += static_cast<double>(pixel.g) / static_cast<double>(image.pixels.size());
            }
            CHECK(mean == Approx(0.96 / 1.04).epsilon(0.01));  // R = 0.04
        }
    }
}

TEST_CASE("a tessellated sphere on a map is drawn once, and its positions are on the map",
          "[distant]")
{
    // Vertices are multiples of 2^-4 m, as coordinates of a map in single precision.
    constexpr double radius = 40.0;
    constexpr int rings = 24;
    const DVec3 place(448000, 0, 512000);
    const auto sphere = [&](const DVec3& center) {
        std::vector<float> vertices;
        std::vector<std::uint16_t> indices;
        for (int i = 0; i <= rings; ++i) {
            for (int k = 0; k <= 2 * rings; ++k) {
                const double theta = 3.14159265358979 * i / rings;
                const double phi = 3.14159265358979 * k / rings;
                const DVec3 offset =
                    radius * DVec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                   -std::sin(theta) * std::sin(phi));
                for (int axis = 0; axis < 3; ++axis) {
                    vertices.push_back(
                        static_cast<float>(center[axis] + std::round(16.0 * offset[axis]) / 16.0));
                }
                if (i < rings && k < 2 * rings) {
                    const int a = (2 * rings + 1) * i + k;
                    for (const int corner : {a, a + 2 * rings + 1, a + 1, a + 1, a + 2 * rings + 1,
                                             a + 2 * rings + 2}) {
                        indices.push_back(static_cast<std::uint16_t>(corner));
                    }
                }
            }
        }
        GltfFixture fixture;
        const int positions =
            fixture.add_accessor(f32, "VEC3", vertices.size() / 3, bytes_of(vertices));
        const int faces = fixture.add_accessor(u16, "SCALAR", indices.size(), bytes_of(indices));
        fixture.add_mesh_node({{"attributes", {{"POSITION", positions}}}, {"indices", faces}});
        fixture.json["cameras"] = {
            {{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.01}}}}};
        fixture.json["nodes"].push_back(
            {{"camera", 0}, {"translation", {center.x, center.y, center.z + 120.0}}});
        fixture.json["scenes"][0]["nodes"].push_back(1);
        return fixture.load();
    };
    const auto aovs = [](const LoadedScene& loaded) {
        RenderOptions options;
        options.film.width = 32;
        options.film.height = 32;
        options.sampling.samples = {0, 4};
        options.film.aovs = {Aov::depth, Aov::position, Aov::normal};
        const RenderResult result = render(Scene(loaded.scene), loaded.cameras.at(0), options);
        std::map<std::string, std::vector<float>> layers;
        for (Layer& layer : result.aovs.develop(result.film)) {
            layers[layer.name] = std::move(layer.values);
        }
        return layers;
    };
    const auto near = aovs(sphere(DVec3(0.0)));
    const auto far = aovs(sphere(place));
    CHECK(far.at("depth") == near.at("depth"));
    CHECK(far.at("normal") == near.at("normal"));
    const std::vector<float>& there = far.at("position");
    const std::vector<float>& here = near.at("position");
    std::size_t hits = 0;
    for (std::size_t i = 0; i < here.size(); i += 3) {
        if (std::isfinite(near.at("depth")[i / 3])) {
            ++hits;
            for (int axis = 0; axis < 3; ++axis) {
                const std::size_t at = i + static_cast<std::size_t>(axis);
                CHECK(static_cast<double>(there[at]) - place[axis] ==
                      Approx(here[at]).margin(0.05));
            }
        }
    }
    CHECK(hits > 200);
}

}  // namespace bdpt::test::distant_test
