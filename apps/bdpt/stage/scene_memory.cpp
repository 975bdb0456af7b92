#include "stage/scene_memory.h"

#include <cstddef>
#include <vector>

namespace bdpt::app {
namespace {

// Measured by benchmarks/scale_table.py; checked by tests/apps/files/memory_test.py.
constexpr std::uint64_t light_bytes = 2000;
constexpr std::uint64_t emissive_triangle_bytes = 430;

template <typename T>
std::uint64_t compute_size(const std::vector<T>& values)
{
    return values.size() * sizeof(T);
}

std::uint64_t count_bytes(const std::vector<TexelImage>& images)
{
    std::uint64_t bytes = 0;
    for (const TexelImage& image : images) {
        bytes += image.bytes.size();
    }
    return bytes;
}

std::uint64_t count_bytes(const std::vector<MeshDesc>& meshes)
{
    std::uint64_t bytes = 0;
    for (const MeshDesc& mesh : meshes) {
        bytes += compute_size(mesh.positions) + compute_size(mesh.normals) +
                 compute_size(mesh.tangents) + compute_size(mesh.uvs[0]) +
                 compute_size(mesh.uvs[1]) + compute_size(mesh.colors) +
                 compute_size(mesh.triangles);
        for (const MeshPose& pose : mesh.motion) {
            bytes += compute_size(pose.positions) + compute_size(pose.normals) +
                     compute_size(pose.tangents);
        }
    }
    return bytes;
}

std::uint64_t count_bytes(const std::vector<VolumeDesc>& volumes)
{
    std::uint64_t bytes = 0;
    for (const VolumeDesc& volume : volumes) {
        bytes += compute_size(volume.density);
    }
    return bytes;
}

std::uint64_t emissive_triangles(const SceneDesc& scene)
{
    std::uint64_t count = 0;
    for (const InstanceDesc& instance : scene.instances) {
        const MaterialDesc& material = scene.materials[static_cast<std::size_t>(instance.material)];
        if (material.emission != Rgb(0.0f)) {
            count += scene.meshes[static_cast<std::size_t>(instance.mesh)].triangles.size();
        }
    }
    return count;
}

}  // namespace

void spend_building(io::MemoryBudget& memory, const SceneDesc& scene, Copies copies)
{
    memory.spend(
        "the tables of light sampling",
        scene.lights.size() * light_bytes + emissive_triangles(scene) * emissive_triangle_bytes);
    if (scene.texture_filter == TextureFilter::mip_mapped) {
        memory.spend("the mip maps of images", count_bytes(scene.images) / 3);
    }
    if (copies == Copies::two) {
        memory.spend("a copy of the scene, to choose its lighting",
                     count_bytes(scene.images) + count_bytes(scene.meshes) +
                         count_bytes(scene.volumes) + compute_size(scene.instances));
    }
}

}  // namespace bdpt::app
