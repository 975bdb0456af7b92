#include "scene/world_builder.h"

#include "material/specular_albedo.h"
#include "scene/checks/check_powers.h"
#include "scene/checks/validate.h"
#include "scene/precision.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <span>
#include <variant>

namespace bdpt {
namespace {

Bounds bounds_of(std::span<const PlacedMesh> placed, std::span<const Sphere> spheres,
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

bool light_moves(const LightDesc& light)
{
    return std::visit(
        [](const auto& l) {
            bool moves = false;
            if constexpr (requires { l.motion; }) {
                moves = moves || !l.motion.empty();
            }
            if constexpr (requires { l.turn; }) {
                moves = moves || !l.turn.empty();
            }
            return moves;
        },
        light);
}

BoundingSphere sphere_around(const Bounds& bounds)
{
    const float radius = 0.5f * glm::length(bounds.max - bounds.min);
    // A little more, so that rounding leaves no corner outside.
    return {.center = 0.5f * (bounds.min + bounds.max),
            .radius = radius > 0.0f ? 1.0001f * radius : 1.0f};
}

}  // namespace

void WorldBuilder::build(Isa isa)
{
    World& w = world_;
    validate(w.desc_);
    place_meshes();
    if (w.desc_.fog) {
        w.fog_ = w.media_.add_fog(medium_of(*w.desc_.fog), w.sphere_);
    }
    w.volumes_ = Volumes(w.desc_.volumes);
    add_materials();
    w.embree_ = std::make_unique<const EmbreeScene>(
        w.desc_.instances, w.placed_, w.desc_.meshes.size(), w.spheres_, w.any_hit_filter(), isa);
    w.warnings_ = precision_warnings(w.desc_);
    find_enclosing_volumes();
    add_lights();
}

void WorldBuilder::add_materials()
{
    const std::vector<MaterialDesc>& materials = world_.desc_.materials;
    if (std::any_of(materials.begin(), materials.end(), has_layers)) {
        world_.layer_tables_ = std::make_unique<const LayerTables>(materials);
    }
    for (const MaterialDesc& material : materials) {
        add_material(material, {.medium = world_.fog_});
    }
}

void WorldBuilder::add_material(const MaterialDesc& desc, const Exterior& exterior)
{
    const MediumId within = world_.media_.add(medium_within(desc));
    world_.materials_.push_back(make_material(desc, exterior, within));
    world_.within_.push_back(within);
}

Material WorldBuilder::make_material(const MaterialDesc& desc, const Exterior& exterior,
                                     MediumId within)
{
    World& w = world_;
    const auto [red, green, blue] = boundary_indices(desc, exterior).greater_by_less;
    const bool mip_mapped = w.desc_.texture_filter == TextureFilter::mip_mapped;
    const TextureImages texture_images(w.desc_.images, mip_mapped ? &w.mip_maps_ : nullptr);
    Material material(desc, texture_images, {albedo_of(red), albedo_of(green), albedo_of(blue)},
                      w.layer_tables_.get(), exterior, within);
    w.disperses_ = w.disperses_ || material.disperses();
    return material;
}

const SpecularAlbedo& WorldBuilder::albedo_of(float ior)
{
    auto& albedo = world_.albedos_[ior];
    if (!albedo) {
        albedo = std::make_unique<const SpecularAlbedo>(ior);
    }
    return *albedo;
}

void WorldBuilder::place_meshes()
{
    World& w = world_;
    const SceneDesc& desc = w.desc_;
    w.placed_.reserve(desc.instances.size());
    for (const InstanceDesc& instance : desc.instances) {
        w.placed_.emplace_back(desc.meshes[static_cast<std::size_t>(instance.mesh)], instance);
    }
    w.moves_ = std::any_of(w.placed_.begin(), w.placed_.end(),
                           [](const PlacedMesh& mesh) { return mesh.moves(); }) ||
               std::any_of(desc.lights.begin(), desc.lights.end(), light_moves);
    w.spheres_ = light_spheres(desc.lights);
    w.bounds_ = bounds_of(w.placed_, w.spheres_, desc.volumes);
    w.sphere_ = sphere_around(w.bounds_);
}

/// What is around each light; around those at infinity, where their rays enter the scene.
std::vector<MediumId> WorldBuilder::media_around(const std::vector<LightDesc>& lights) const
{
    std::vector<MediumId> media;
    for (const LightDesc& light : lights) {
        media.push_back(std::visit(
            [this](const auto& desc) {
                if constexpr (requires { desc.position; }) {
                    return world_.medium_at(desc.position);
                }
                return world_.fog_;
            },
            light));
    }
    return media;
}

void WorldBuilder::add_lights()
{
    World& w = world_;
    const SceneDesc& desc = w.desc_;
    w.profiles_.reserve(desc.profiles.size());
    for (const LightProfile& profile : desc.profiles) {
        w.profiles_.emplace_back(profile);
    }
    w.lights_ =
        std::make_unique<const LightSet>(desc.instances, w.placed_, w.materials_, desc.lights,
                                         w.profiles_, w.sphere_, media_around(desc.lights));
    check_powers(desc, w.materials_, *w.lights_);
    w.counts_ = count(desc);
    w.counts_.lights = w.lights_->size();
    w.counts_.emissive_triangles = w.lights_->size() - desc.lights.size();
}

}  // namespace bdpt
