#include "scene/scene_geometry.h"

#include "identity/same_bits.h"
#include "scene/checks/validate.h"
#include "scene/light_set.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <span>

namespace bdpt {
namespace {

Bounds compute_bounds(std::span<const PlacedMesh> placed, std::span<const Sphere> spheres,
                      std::span<const VolumeDesc> volumes)
{
    Bounds bounds{.min = Vec3(std::numeric_limits<float>::infinity()),
                  .max = Vec3(-std::numeric_limits<float>::infinity())};
    for (const PlacedMesh& mesh : placed) {
        for (const UVec3& triangle : mesh.mesh().triangles) {
            for (int corner = 0; corner < 3; ++corner) {
                for (std::size_t step = 0; step <= mesh.steps(); ++step) {
                    const Vec3 p = mesh.world_point_at(step, triangle[corner]);
                    bounds.min = min(bounds.min, p);
                    bounds.max = max(bounds.max, p);
                }
            }
        }
    }
    const auto add_sphere = [&bounds](Vec3 center, float radius) {
        bounds.min = min(bounds.min, center - radius);
        bounds.max = max(bounds.max, center + radius);
    };
    for (const Sphere& sphere : spheres) {
        add_sphere(sphere.center, sphere.radius);
        for (const Vec3& center : sphere.motion) {
            add_sphere(center, sphere.radius);
        }
    }
    for (const VolumeDesc& volume : volumes) {
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 sides((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
            const Vec3 p(volume.world_from_grid * Vec4(sides * Vec3(volume.size), 1.0f));
            bounds.min = min(bounds.min, p);
            bounds.max = max(bounds.max, p);
        }
    }
    return bounds.min.x <= bounds.max.x ? bounds : Bounds{};
}

BoundingSphere sphere_around(const Bounds& bounds)
{
    const float radius = 0.5f * glm::length(bounds.max - bounds.min);
    // Slightly enlarged for rounding.
    return {.center = 0.5f * (bounds.min + bounds.max),
            .radius = radius > 0.0f ? 1.0001f * radius : 1.0f};
}

std::optional<MeshBox> compute_box(const MeshDesc& mesh)
{
    if (mesh.triangles.empty()) {
        return std::nullopt;
    }
    Vec3 low(std::numeric_limits<float>::max());
    Vec3 high(-std::numeric_limits<float>::max());
    for (const Vec3& position : mesh.positions) {
        low = min(low, position);
        high = max(high, position);
    }
    return MeshBox{.center = 0.5f * low + 0.5f * high, .half = 0.5f * high - 0.5f * low};
}

bool same_place(const InstanceDesc& a, const InstanceDesc& b)
{
    return a.mesh == b.mesh && same_bits(a.world_from_object, b.world_from_object) &&
           same_bits(a.motion, b.motion);
}

bool same_places(const SharedList<InstanceDesc>& a, const SharedList<InstanceDesc>& b)
{
    return a.is_shared_with(b) || std::equal(a.begin(), a.end(), b.begin(), b.end(), same_place);
}

bool same_sphere(const Sphere& a, const Sphere& b)
{
    const auto same = [](const Vec3& p, const Vec3& q) { return same_bits(p, q); };
    return same_bits(a.center, b.center) && same_bits(a.radius, b.radius) &&
           std::equal(a.motion.begin(), a.motion.end(), b.motion.begin(), b.motion.end(), same);
}

}  // namespace

SceneGeometry::SceneGeometry(const SharedSceneDesc& desc, const SceneGeometry* like)
    : meshes(desc.meshes),
      instances(desc.instances),
      traced(desc.instances),
      lights(desc.lights),
      volumes(desc.volumes),
      contact_kind(desc.contacts),
      parts(contact_parts(desc)),
      shells(find_shells(desc, parts,
                         like != nullptr && like->meshes.is_shared_with(desc.meshes)
                             ? like->shells
                             : ShellTable())),
      spheres(light_spheres(lights)),
      counts(count(desc))
{
    placed.reserve(instances.size());
    for (const InstanceDesc& instance : instances) {
        placed.emplace_back(meshes[static_cast<std::size_t>(instance.mesh)], instance);
    }
    contacts = separate_contacts(desc, placed, parts, shells);
    counts.contacts = contacts.pairs;
    counts.bonds = contacts.bonded_pairs;
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const auto mesh = contacts.meshes.find(static_cast<std::size_t>(instances[i].mesh));
        if (mesh != contacts.meshes.end()) {
            placed[i] = PlacedMesh(mesh->second, instances[i]);
        }
    }
    if (!contacts.open.empty()) {
        std::vector<InstanceDesc> own = instances;
        std::size_t mesh = meshes.size();
        for (const auto& [i, open] : contacts.open) {
            own[i].mesh = static_cast<MeshId>(mesh++);
            placed[i] = PlacedMesh(open, instances[i]);
        }
        traced = own;
    }
    boxes.reserve(meshes.size());
    for (const MeshDesc& mesh : meshes) {
        boxes.push_back(compute_box(mesh));
    }
    bounds = compute_bounds(placed, spheres, volumes);
    sphere = sphere_around(bounds);
}

bool SceneGeometry::same_contacts(const SharedSceneDesc& desc) const
{
    const std::vector<ContactPart> others = contact_parts(desc);
    if (parts == others && contact_kind == desc.contacts) {
        return true;
    }
    const Contacts found =
        separate_contacts(desc, placed, others, find_shells(desc, others, shells));
    const auto moves_any = [](const Contacts& c) { return !c.meshes.empty() || !c.bonds.empty(); };
    return !moves_any(contacts) && !moves_any(found) && contacts.thin == found.thin;
}

bool SceneGeometry::fits(const SharedSceneDesc& desc) const
{
    if (!meshes.is_shared_with(desc.meshes) || !volumes.is_shared_with(desc.volumes) ||
        !same_places(instances, desc.instances) || !same_contacts(desc)) {
        return false;
    }
    const std::vector<Sphere> others = light_spheres(desc.lights);
    return std::equal(spheres.begin(), spheres.end(), others.begin(), others.end(), same_sphere);
}

void SceneGeometry::build(const AnyHitFilter& filter, Isa isa, const SceneGeometry* like)
{
    const bool same_meshes = like != nullptr && meshes.is_shared_with(like->meshes) &&
                             contacts.meshes.empty() && like->contacts.meshes.empty() &&
                             contacts.open.empty() && like->contacts.open.empty();
    trees.emplace(traced, placed, traced_meshes(), spheres, filter, isa,
                  same_meshes ? &*like->trees : nullptr);
}

}  // namespace bdpt
