// Measures the cost of loading a file beyond building its BVH: from the file to a scene that is
// ready to trace, against Embree's commit of the same triangles alone, interleaved.

#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>

#include <CLI/CLI.hpp>

#include "geometry/embree.h"

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "measure.h"
#include "subject.h"

namespace {

using namespace bdpt;

struct Settings {
    std::string scene;
    int rounds = 5;
};

/// Triangles in world space, as Embree reads them.
struct BareMesh {
    std::vector<Vec3> positions;  // and one more, as Embree reads 16 bytes of each
    const std::vector<UVec3>* triangles = nullptr;
};

std::vector<BareMesh> bare_meshes(const SceneDesc& desc)
{
    std::vector<BareMesh> meshes;
    for (const InstanceDesc& instance : desc.instances) {
        const MeshDesc& mesh = desc.meshes[static_cast<std::size_t>(instance.mesh)];
        BareMesh bare{.positions = {}, .triangles = &mesh.triangles};
        for (const Vec3& p : mesh.positions) {
            bare.positions.emplace_back(instance.world_from_object * Vec4(p, 1.0f));
        }
        bare.positions.emplace_back(0.0f);
        meshes.push_back(std::move(bare));
    }
    return meshes;
}

/// Commits the meshes with the flags and the quality of bdpt's own scenes.
void commit(const std::vector<BareMesh>& meshes)
{
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    for (const BareMesh& mesh : meshes) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   mesh.positions.data(), 0, sizeof(Vec3),
                                   mesh.positions.size() - 1);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   mesh.triangles->data(), 0, sizeof(UVec3),
                                   mesh.triangles->size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}

double seconds_since(std::chrono::steady_clock::time_point begin)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void measure(const Settings& settings)
{
    const io::LoadedScene loaded = io::load_gltf(settings.scene);
    const std::vector<BareMesh> meshes = bare_meshes(loaded.scene);
    std::vector<double> reading;
    const auto seconds = in_turn(2, settings.rounds, [&](std::size_t variant, int) {
        const auto begin = std::chrono::steady_clock::now();
        if (variant == 0) {
            io::LoadedScene fresh = io::load_gltf(settings.scene);
            reading.push_back(seconds_since(begin));
            const Scene scene(std::move(fresh.scene));
            return seconds_since(begin);
        }
        commit(meshes);
        return seconds_since(begin);
    });
    const Scene scene(loaded.scene);
    std::printf("%s: %zu triangles\n", settings.scene.c_str(), scene.counts().instanced_triangles);
    std::printf(
        "  loading %.3f s (%.3f s of it reading the file), bare commit %.3f s: %.2f times\n",
        median(seconds[0]), median(reading), median(seconds[1]),
        median_ratio(seconds[0], seconds[1]));
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Time from a glTF file to a scene against that of Embree's commit alone"};
    app.add_option("scene", settings.scene, "A glTF file")->required();
    app.add_option("--rounds", settings.rounds, "How often each is done")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    return report_errors([&] {
        measure(settings);
        return 0;
    });
}
