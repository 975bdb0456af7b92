#include "stage/scene_memory.h"

#include <cstddef>
#include <vector>

namespace bdpt::app {
namespace {

// Measured by benchmarks/scale_table.py; checked by tests/apps/files/memory_test.py.
constexpr std::uint64_t light_bytes = 2000;
constexpr std::uint64_t emissive_triangle_bytes = 430;

template <typename T>
std::uint64_t size_of(const std::vector<T>& values)
{
    return values.size() * sizeof(T);
}

std::uint64_t bytes_of(const std::vector<TexelImage>& images)
{
    std::uint64_t bytes = 0;
    for (const TexelImage& image : images) {
        bytes += image.bytes.size();
    }
    return bytes;
}

std::uint64_t bytes_of(const std::vector<MeshDesc>& meshes)
{
    std::uint64_t bytes = 0;
    for (const MeshDesc& mesh : meshes) {
        bytes += size_of(mesh.positions) + size_of(mesh.normals) + size_of(mesh.tangents) +
                 size_of(mesh.uvs[0]) + size_of(mesh.uvs[1]) + size_of(mesh.colors) +
                 size_of(mesh.triangles);
        for (const MeshPose& pose : mesh.motion) {
            bytes += size_of(pose.positions) + size_of(pose.normals) + size_of(pose.tangents);
        }
    }
    return bytes;
}

std::uint64_t bytes_of(const std::vector<VolumeDesc>& volumes)
{
    std::uint64_t bytes = 0;
    for (const VolumeDesc& volume : volumes) {
        bytes += size_of(volume.density);
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
        "what lights are chosen by",
        scene.lights.size() * light_bytes + emissive_triangles(scene) * emissive_triangle_bytes);
    if (scene.texture_filter == TextureFilter::mip_mapped) {
        memory.spend("smaller copies of images", bytes_of(scene.images) / 3);
    }
    if (copies == Copies::two) {
        memory.spend("a copy of the scene, to find out how it should be lit",
                     bytes_of(scene.images) + bytes_of(scene.meshes) + bytes_of(scene.volumes) +
                         size_of(scene.instances));
    }
}

}  // namespace bdpt::app
