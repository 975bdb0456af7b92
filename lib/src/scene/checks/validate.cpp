#include "scene/checks/validate.h"

#include "geometry/placed_mesh.h"
#include "math/rgb.h"
#include "scene/checks/value_checks.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace bdpt {
namespace {

template <typename T>
void check_attribute(const std::string& item, const char* what, const std::vector<T>& values,
                     std::size_t vertices)
{
    if (!values.empty() && values.size() != vertices) {
        fail(item, ": ", values.size(), " ", what, ", but the number of vertices is ", vertices);
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!all_finite(&values[i][0], T::length())) {
            fail(item, ": ", what, " ", i, " is not finite");
        }
    }
}

void check(const MeshDesc& mesh, const std::string& item)
{
    const std::size_t vertices = mesh.positions.size();
    check_attribute(item, "positions", mesh.positions, vertices);
    check_attribute(item, "normals", mesh.normals, vertices);
    check_attribute(item, "tangents", mesh.tangents, vertices);
    check_attribute(item, "texture coordinates (set 0)", mesh.uvs[0], vertices);
    check_attribute(item, "texture coordinates (set 1)", mesh.uvs[1], vertices);
    check_attribute(item, "colours", mesh.colors, vertices);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner) {
            if (mesh.triangles[t][corner] >= vertices) {
                fail(item, ": triangle ", t, " has index ", mesh.triangles[t][corner],
                     ", but the number of vertices is ", vertices);
            }
        }
    }
}

void check(const TextureRef& texture, const std::string& item, std::size_t image_count)
{
    if (static_cast<std::size_t>(texture.image) >= image_count) {
        fail(item, ": image ", static_cast<std::size_t>(texture.image),
             ", but the number of images is ", image_count);
    }
    if (texture.uv_set != 0 && texture.uv_set != 1) {
        fail(item, ": texture coordinate set ", texture.uv_set, " is neither 0 nor 1");
    }
    if (!all_finite(&texture.offset[0], 2) || !all_finite(&texture.scale[0], 2) ||
        !std::isfinite(texture.rotation)) {
        fail(item, ": texture transform is not finite");
    }
}

/// Checks the numbers of a material, or of one of its layers.
template <HasFields Desc>
void check_numbers(const Desc& desc, const std::string& item)
{
    for_each_field(desc, [&item](const auto& field, const auto& value) {
        using T = std::remove_cvref_t<decltype(value)>;
        if constexpr (requires { field.limits; }) {
            check_limits(item, field.name, value, field.limits);
        } else if constexpr (HasFields<T>) {
            check_numbers(value, item);
        } else {
            constexpr bool is_number = std::is_floating_point_v<T> || requires
            {
                value[0];
            };
            static_assert(!is_number || std::is_same_v<T, std::string>,
                          "a number of a material needs limits in its list of fields");
        }
    });
}

void check(const MaterialDesc& material, const std::string& item, std::size_t image_count)
{
    check_numbers(material, item);
    for_each_texture(material, [&](const std::optional<TextureRef>& texture) {
        if (texture) {
            check(*texture, item, image_count);
        }
    });
}

void check_transform(const Mat4& m, const std::string& item)
{
    if (!all_finite(&m[0][0], 16)) {
        fail(item, ": transform is not finite");
    }
    const float determinant = glm::determinant(Mat3(m));
    if (!std::isnormal(determinant)) {
        fail(item, ": transform has no inverse (determinant ", determinant, ")");
    }
}

void check(const VolumeDesc& volume, const std::string& item)
{
    check_own_limits(item, volume);
    check_transform(volume.world_from_grid, item);
    const UVec3& size = volume.size;
    const std::size_t voxels = std::size_t{size.x} * size.y * size.z;
    constexpr std::uint32_t most = 1U << 15U;  // along each side
    if (std::max({size.x, size.y, size.z}) > most || voxels == 0 ||
        volume.density.size() != voxels) {
        fail(item, ": ", size.x, " x ", size.y, " x ", size.z, " voxels, but ",
             volume.density.size(), " densities");
    }
    double densest = 0.0;
    for (std::size_t i = 0; i < voxels; ++i) {
        check_limits(item, "density", volume.density[i], Limits::at_least(0.0f));
        densest = std::max(densest, static_cast<double>(volume.density[i]));
    }
    // Limits the number of collisions of a ray.
    constexpr double max_depth = 1e5;
    const glm::dvec3 diagonal = glm::dmat3(volume.world_from_grid) * glm::dvec3(size);
    const double depth =
        densest * static_cast<double>(max_component(volume.extinction)) * glm::length(diagonal);
    if (!(depth <= max_depth)) {
        fail(item, ": its maximum extinction along its diagonal gives an optical depth of ", depth,
             ", but must be at most ", max_depth);
    }
}

void check(const InstanceDesc& instance, const std::string& item, const SharedSceneDesc& desc)
{
    if (static_cast<std::size_t>(instance.mesh) >= desc.meshes.size()) {
        fail(item, ": mesh ", static_cast<std::size_t>(instance.mesh),
             ", but the number of meshes is ", desc.meshes.size());
    }
    if (static_cast<std::size_t>(instance.material) >= desc.materials.size()) {
        fail(item, ": material ", static_cast<std::size_t>(instance.material),
             ", but the number of materials is ", desc.materials.size());
    }
    check_transform(instance.world_from_object, item);
}

/// Checks that all coordinates are within the reach of rays, which are single-precision.
void check_coordinates(const SharedSceneDesc& desc, float reach)
{
    std::vector<Vec3> extents;
    extents.reserve(desc.meshes.size());
    for (const MeshDesc& mesh : desc.meshes) {
        extents.push_back(compute_extent(mesh));
    }
    for (std::size_t i = 0; i < desc.instances.size(); ++i) {
        const InstanceDesc& instance = desc.instances[i];
        const float extent = placed_extent(extents[static_cast<std::size_t>(instance.mesh)],
                                           instance.world_from_object);
        if (!(extent <= reach)) {
            fail(label("instance", i, instance.name), ": reaches ", extent, limit_text(reach));
        }
    }
    for (std::size_t i = 0; i < desc.volumes.size(); ++i) {
        const VolumeDesc& volume = desc.volumes[i];
        const float extent = placed_extent(Vec3(volume.size), volume.world_from_grid);
        if (!(extent <= reach)) {
            fail(label("volume", i, volume.name), ": reaches ", extent, limit_text(reach));
        }
    }
}

bool is_degenerate(const MeshDesc& mesh, const UVec3& triangle)
{
    const Vec3& a = mesh.positions[triangle.x];
    const Vec3 normal = cross(mesh.positions[triangle.y] - a, mesh.positions[triangle.z] - a);
    return normal == Vec3(0.0f);
}

}  // namespace

void validate(const SharedSceneDesc& desc, const SharedSceneDesc& valid)
{
    const bool same_images = desc.images.is_shared_with(valid.images);
    const bool same_meshes = desc.meshes.is_shared_with(valid.meshes);
    const bool same_instances = desc.instances.is_shared_with(valid.instances);
    const bool same_volumes = desc.volumes.is_shared_with(valid.volumes);
    for (std::size_t i = 0; !same_images && i < desc.images.size(); ++i) {
        check_texels(desc.images[i], label("image", i, ""));
    }
    for (std::size_t i = 0; i < desc.materials.size(); ++i) {
        const MaterialDesc& material = desc.materials[i];
        check(material, label("material", i, material.name), desc.images.size());
    }
    for (std::size_t i = 0; !same_meshes && i < desc.meshes.size(); ++i) {
        check(desc.meshes[i], label("mesh", i, desc.meshes[i].name));
    }
    const bool same_numbers = same_meshes && desc.materials.size() == valid.materials.size();
    for (std::size_t i = 0; !(same_instances && same_numbers) && i < desc.instances.size(); ++i) {
        check(desc.instances[i], label("instance", i, desc.instances[i].name), desc);
    }
    for (std::size_t i = 0; !same_volumes && i < desc.volumes.size(); ++i) {
        check(desc.volumes[i], label("volume", i, desc.volumes[i].name));
    }
    if (desc.fog) {
        check_own_limits("fog", *desc.fog);
    }
    const bool same_places = same_meshes && same_instances;
    const float reach = compute_coordinate_limit(desc.instances.values(), desc.meshes.size());
    if (!same_places || !same_volumes) {
        check_coordinates(desc, reach);
    }
    const bool same_lights = same_places && desc.lights.is_shared_with(valid.lights) &&
                             desc.profiles.is_shared_with(valid.profiles);
    if (!same_lights) {
        validate_lights(desc, reach);
        check_motion(desc, reach, same_places);
    }
}

SceneCounts count(const SharedSceneDesc& desc)
{
    SceneCounts counts;
    for (const MeshDesc& mesh : desc.meshes) {
        counts.triangles += mesh.triangles.size();
        for (const UVec3& triangle : mesh.triangles) {
            counts.degenerate_triangles += is_degenerate(mesh, triangle) ? 1U : 0U;
        }
    }
    for (const InstanceDesc& instance : desc.instances) {
        counts.instanced_triangles +=
            desc.meshes[static_cast<std::size_t>(instance.mesh)].triangles.size();
    }
    return counts;
}

}  // namespace bdpt
