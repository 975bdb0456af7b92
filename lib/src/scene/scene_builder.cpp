#include "math/elementary.h"

#include <bdpt/error.h>
#include <bdpt/tools/scene_builder.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace bdpt {
namespace {

template <typename Id, typename T>
Id append_to(std::vector<T>& list, T value)
{
    list.push_back(std::move(value));
    return Id{static_cast<std::uint32_t>(list.size() - 1)};
}

template <typename Id, typename T>
void require_index(const char* what, Id id, const std::vector<T>& list)
{
    const auto index = static_cast<std::uint32_t>(id);
    if (index >= list.size()) {
        throw Error(ErrorCode::usage, std::string("scene builder: there is no ") + what + " " +
                                          std::to_string(index));
    }
}

}  // namespace

MeshDesc quad_mesh(Vec3 a, Vec3 b, Vec3 c, Vec3 d)
{
    MeshDesc mesh;
    mesh.positions = {a, b, c, d};
    mesh.uvs[0] = {{0.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, 0.0f}, {0.0f, 0.0f}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

MeshDesc box_mesh(Vec3 min, Vec3 max)
{
    MeshDesc mesh;
    for (unsigned i = 0; i < 8; ++i) {
        mesh.positions.emplace_back((i & 1U) != 0 ? max.x : min.x, (i & 2U) != 0 ? max.y : min.y,
                                    (i & 4U) != 0 ? max.z : min.z);
    }
    mesh.triangles = {{4, 5, 7}, {4, 7, 6}, {1, 0, 2}, {1, 2, 3}, {5, 1, 3}, {5, 3, 7},
                      {0, 4, 6}, {0, 6, 2}, {6, 7, 3}, {6, 3, 2}, {0, 1, 5}, {0, 5, 4}};
    return mesh;
}

MeshDesc sphere_mesh(float radius, unsigned segments)
{
    constexpr unsigned max_segments = 4096;
    if (!(radius > 0.0f) || !std::isfinite(radius) || segments < 4 || segments > max_segments) {
        throw Error(ErrorCode::usage, "sphere mesh: radius " + std::to_string(radius) + " with " +
                                          std::to_string(segments) +
                                          " segments; expected a radius above 0 and 4 to 4096");
    }
    MeshDesc mesh;
    const unsigned rings = segments / 2;
    const auto share = [](unsigned part, unsigned whole) {
        return static_cast<float>(part) / static_cast<float>(whole);
    };
    for (unsigned ring = 0; ring <= rings; ++ring) {
        const SinCos polar = sin_cos(pi * share(ring, rings));
        for (unsigned i = 0; i <= segments; ++i) {
            const SinCos azimuth = sin_cos(2.0f * pi * share(i % segments, segments));
            const Vec3 normal =
                ring == 0 || ring == rings
                    ? Vec3(0.0f, ring == 0 ? 1.0f : -1.0f, 0.0f)
                    : Vec3(polar.sin * azimuth.sin, polar.cos, polar.sin * azimuth.cos);
            mesh.normals.push_back(normal);
            mesh.positions.push_back(radius * normal);
            mesh.uvs[0].emplace_back(share(i, segments), share(ring, rings));
        }
    }
    for (unsigned ring = 0; ring < rings; ++ring) {
        for (unsigned i = 0; i < segments; ++i) {
            const unsigned a = ring * (segments + 1) + i;
            const unsigned b = a + segments + 1;
            if (ring > 0) {
                mesh.triangles.emplace_back(a, b, a + 1);
            }
            if (ring + 1 < rings) {
                mesh.triangles.emplace_back(a + 1, b, b + 1);
            }
        }
    }
    return mesh;
}

CameraDesc look_at(Vec3 from, Vec3 to, float vertical_fov)
{
    // Closer to the vertical than this, -z is up in the image instead of +y.
    constexpr float vertical = 0.9999f;
    const Vec3 forward = to - from;
    if (!(glm::dot(forward, forward) > 0.0f)) {
        throw Error(ErrorCode::usage, "a camera cannot look at its own position");
    }
    const Vec3 back = -glm::normalize(forward);
    const Vec3 up = std::abs(back.y) < vertical ? Vec3(0.0f, 1.0f, 0.0f) : Vec3(0.0f, 0.0f, -1.0f);
    const Vec3 right = glm::normalize(glm::cross(up, back));
    CameraDesc camera;
    camera.world_from_camera = Mat4(Vec4(right, 0.0f), Vec4(glm::cross(back, right), 0.0f),
                                    Vec4(back, 0.0f), Vec4(from, 1.0f));
    camera.vertical_fov = vertical_fov;
    return camera;
}

MaterialId SceneBuilder::add(MaterialDesc material)
{
    return append_to<MaterialId>(desc_.materials, std::move(material));
}

MeshId SceneBuilder::add(MeshDesc mesh)
{
    return append_to<MeshId>(desc_.meshes, std::move(mesh));
}

ImageId SceneBuilder::add(TexelImage image)
{
    return append_to<ImageId>(desc_.images, std::move(image));
}

void SceneBuilder::add(LightDesc light)
{
    desc_.lights.push_back(std::move(light));
}

InstanceDesc& SceneBuilder::place(MeshId mesh, MaterialId material, const Mat4& world_from_object)
{
    require_index("mesh", mesh, desc_.meshes);
    require_index("material", material, desc_.materials);
    InstanceDesc instance;
    instance.mesh = mesh;
    instance.material = material;
    instance.world_from_object = world_from_object;
    return desc_.instances.emplace_back(std::move(instance));
}

SceneDesc SceneBuilder::take()
{
    return std::exchange(desc_, {});
}

}  // namespace bdpt
