#include "catch.hpp"
#include "gltf/compression/compression.h"
#include "gltf_fixture.h"

#include <bdpt/framing.h>
#include <bdpt/io/read_image.h>
#include <bdpt/render.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

namespace bdpt::test::assets_test {
using namespace bdpt::io;

namespace {

std::optional<std::filesystem::path> assets()
{
    const char* folder = std::getenv("BDPT_TEST_ASSETS");
    if (folder == nullptr || *folder == '\0') {
        WARN("skipped: BDPT_TEST_ASSETS does not name a folder with glTF files");
        return std::nullopt;
    }
    return folder;
}

/// What does not depend on the order of triangles, in world space.
struct Sums {
    std::size_t triangles = 0;
    double area = 0.0;
    glm::dvec3 centre{0.0};    // of the surface
    glm::dvec3 outwards{0.0};  // mean of normal times position: the sign tells the front
};

Sums sums_of(const LoadedScene& loaded)
{
    Sums sums;
    for (const InstanceDesc& instance : loaded.scene.instances) {
        const MeshDesc& mesh = loaded.scene.meshes.at(static_cast<std::size_t>(instance.mesh));
        for (const UVec3& triangle : mesh.triangles) {
            const auto corner = [&](int c) {
                return glm::dvec3(instance.world_from_object *
                                  Vec4(mesh.positions[triangle[c]], 1.0f));
            };
            const glm::dvec3 normal = cross(corner(1) - corner(0), corner(2) - corner(0)) / 2.0;
            const glm::dvec3 centre = (corner(0) + corner(1) + corner(2)) / 3.0;
            ++sums.triangles;
            sums.area += length(normal);
            sums.centre += length(normal) * centre;
            sums.outwards += normal * centre;
        }
    }
    sums.centre /= sums.area;
    sums.outwards /= sums.area;
    return sums;
}

struct Asset {
    const char* file;
    std::size_t triangles;  // each mesh once
    std::size_t images = 0;
    std::size_t lights = 0;
    std::size_t cameras = 0;
};

constexpr Asset known_assets[] = {
    {"AttenuationTest/AttenuationTest.glb", 232, 2},
    {"BoxWithSpaces/Box With Spaces.gltf", 12, 3},
    {"Cameras/Cameras.gltf", 2, 0, 0, 2},
    {"CesiumMan/CesiumMan.glb", 4672, 1},
    {"CornellBox_bevy/CornellBox.glb", 36},
    {"CornellBox_kajiya/scene.gltf", 32},
    {"Duck/Duck.glb", 4212, 1, 0, 1},
    {"EmissiveTriangle/triangle.glb", 1},
    {"EnvironmentTest/EnvironmentTest.gltf", 25344, 2, 0, 1},
    {"Fox/Fox.gltf", 576, 1},
    {"Garage/garage.gltf", 11358},
    {"GodotLivingRoom/living_room.glb", 5088},
    {"LightsPunctual_playcanvas/Lights.glb", 12, 0, 4, 1},
    {"ManyCubes/many-cubes.gltf", 6012, 0, 0, 1},
    {"RoughnessScale/scene.gltf", 51200, 5},
    {"SimpleInstancing/simple-instancing.glb", 12},
    {"SimpleSparseAccessor/SimpleSparseAccessor.gltf", 12},
    {"ShaderBall_nvidia/shader_ball.gltf", 9450, 0, 0, 1},
    {"Suzi/suzi.glb", 15744},
    {"TextureTransformTest/TextureTransformTest.gltf", 18, 5},
    {"TransmissionRoughnessTest/TransmissionRoughnessTest.glb", 77792, 5},
    {"TwoSidedPlane/TwoSidedPlane.gltf", 2, 3},
    {"VertexColorTest/VertexColorTest.gltf", 36, 2},
};

}  // namespace

TEST_CASE("real files load with what is in them")
{
    const std::optional<std::filesystem::path> folder = assets();
    if (!folder) {
        return;
    }
    for (const Asset& asset : known_assets) {
        CAPTURE(asset.file);
        const LoadedScene loaded = load_gltf(*folder / asset.file);
        std::size_t triangles = 0;
        for (const MeshDesc& mesh : loaded.scene.meshes) {
            triangles += mesh.triangles.size();
        }
        CHECK(triangles == asset.triangles);
        CHECK(loaded.scene.instances.size() >= loaded.scene.meshes.size());
        CHECK(loaded.scene.images.size() == asset.images);
        CHECK(loaded.scene.lights.size() == asset.lights);
        CHECK(loaded.cameras.size() == asset.cameras);
    }
}

TEST_CASE("real compressed files are equal to their plain twins")
{
    const std::optional<std::filesystem::path> folder = assets();
    if (!folder) {
        return;
    }
    struct Pair {
        const char* packed;
        const char* plain;
        bool possible;
    };
    const Pair pairs[] = {
        {"BoxDraco/Box_Draco.glb", "Box/Box.glb", has_draco()},
        {"BoxMeshopt/BoxMeshopt.glb", "Box/Box.glb", has_meshopt()},
        {"DuckMeshoptQuantized/Duck-vp-12-vt-12-vn-12.glb", "Duck/Duck.glb", has_meshopt()}};
    for (const Pair& pair : pairs) {
        CAPTURE(pair.packed);
        if (!pair.possible) {
            WARN("skipped: this build cannot read " << pair.packed);
            continue;
        }
        const Sums packed = sums_of(load_gltf(*folder / pair.packed));
        const Sums plain = sums_of(load_gltf(*folder / pair.plain));
        CHECK(packed.triangles == plain.triangles);
        CHECK(packed.area == Approx(plain.area).epsilon(2e-3));
        for (int c = 0; c < 3; ++c) {
            CHECK(packed.centre[c] == Approx(plain.centre[c]).margin(1e-3));
            CHECK(packed.outwards[c] == Approx(plain.outwards[c]).margin(1e-3));
        }
    }
}

TEST_CASE("instances of real files are placed")
{
    const std::optional<std::filesystem::path> folder = assets();
    if (!folder) {
        return;
    }
    const LoadedScene loaded = load_gltf(*folder / "SimpleInstancing/simple-instancing.glb");
    CHECK(loaded.scene.meshes.size() == 1);
    CHECK(loaded.scene.instances.size() == 125);
}

TEST_CASE("real environments load")
{
    const std::optional<std::filesystem::path> folder = assets();
    if (!folder) {
        return;
    }
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(*folder / "hdr")) {
        if (entry.path().extension() != ".exr" && entry.path().extension() != ".hdr") {
            continue;
        }
        CAPTURE(entry.path().string());
        const Image image = load_environment(entry.path()).light.radiance.to_image();
        CHECK(image.width == 1024);
        CHECK(image.height == 512);
        double sum = 0.0;
        for (const Rgb& pixel : image.pixels) {
            sum += static_cast<double>(pixel.r + pixel.g + pixel.b);
        }
        CHECK(sum > 0.0);
        ++count;
    }
    CHECK(count >= 6);
}

TEST_CASE("hostile files are refused or load, but nothing else")
{
    const std::optional<std::filesystem::path> folder = assets();
    if (!folder) {
        return;
    }
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(*folder / "hostile")) {
        const std::filesystem::path extension = entry.path().extension();
        if (!entry.is_regular_file()) {
            continue;
        }
        CAPTURE(entry.path().string());
        if (extension == ".gltf" || extension == ".glb") {
            // `internal` with a message would be an exception that nobody foresaw.
            const Error error = load_error(entry.path());
            CHECK((error.code() != ErrorCode::internal || std::string(error.what()).empty()));
            CHECK(error.code() != ErrorCode::out_of_memory);
            CHECK_FALSE(contains(error.what(), "\n"));
            ++count;
        } else if (extension == ".exr") {
            try {
                static_cast<void>(load_environment(entry.path()));
            } catch (const Error& error) {
                CHECK(error.code() != ErrorCode::internal);
                CHECK(error.code() != ErrorCode::out_of_memory);
            }
            ++count;
        }
    }
    CHECK(count > 0);
}

// A few paths that only light paths find are 2000 times as bright as their surroundings.
TEST_CASE("auto takes cheap light paths for a car with small lamps in a studio")
{
    const auto folder = assets();
    if (!folder) {
        return;
    }
    LoadedScene car = load_gltf(*folder / "Lamborghini/scene.glb");
    car.scene.lights.emplace_back(load_environment(*folder / "hdr/studio.exr").light);
    const Scene scene(std::move(car.scene));
    RenderOptions options;
    options.film.width = 240;
    options.film.height = 135;
    const CameraDesc camera = frame_scene(scene, 240.0f / 135.0f).camera;
    // Dots of path tracing are certain there, and connections bring nothing.
    const RenderOptions chosen = chosen_options(scene, camera, options);
    CHECK(chosen.integrator == IntegratorKind::bdpt);
    CHECK(chosen.bidirectional.light_paths == 0.0625);
    CHECK(chosen.bidirectional.connections == 0.0);
}

}  // namespace bdpt::test::assets_test
