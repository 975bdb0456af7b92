#include "scene/world.h"

#include "geometry/rounding.h"
#include "material/specular_albedo.h"
#include "scene/validate.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace bdpt {
namespace {

Bounds bounds_of(std::span<const PlacedMesh> placed, std::span<const Sphere> spheres)
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
    const auto add_ball = [&bounds](Vec3 center, float radius) {
        bounds.min = min(bounds.min, center - radius);
        bounds.max = max(bounds.max, center + radius);
    };
    for (const Sphere& sphere : spheres) {
        add_ball(sphere.center, sphere.radius);
        for (const Vec3& center : sphere.motion) {
            add_ball(center, sphere.radius);
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

/// A type of its own, as that of a plain function would be visible from outside of the library.
struct ForRowsAtOnce {
    void operator()(int count, const std::function<void(int, int)>& work) const
    {
        tbb::parallel_for(tbb::blocked_range<int>(0, count, 16),
                          [&work](const auto& rows) { work(rows.begin(), rows.end()); });
    }
};

}  // namespace

World::World(SceneDesc desc, Isa isa) : desc_(std::move(desc)), mip_maps_(ForRowsAtOnce{})
{
    validate(desc_);
    if (std::any_of(desc_.materials.begin(), desc_.materials.end(), has_layers)) {
        layer_tables_ = std::make_unique<const LayerTables>(desc_.materials);
    }
    for (const MaterialDesc& material : desc_.materials) {
        materials_.push_back(make_material(material, {}));
    }
    placed_.reserve(desc_.instances.size());
    for (const InstanceDesc& instance : desc_.instances) {
        placed_.emplace_back(desc_.meshes[static_cast<std::size_t>(instance.mesh)], instance);
    }
    moves_ = std::any_of(placed_.begin(), placed_.end(),
                         [](const PlacedMesh& mesh) { return mesh.moves(); }) ||
             std::any_of(desc_.lights.begin(), desc_.lights.end(), light_moves);
    spheres_ = light_spheres(desc_.lights);
    bounds_ = bounds_of(placed_, spheres_);
    sphere_ = sphere_around(bounds_);
    embree_ = std::make_unique<const EmbreeScene>(desc_.instances, placed_, desc_.meshes.size(),
                                                  spheres_, pass_rule(), isa);
    profiles_.reserve(desc_.profiles.size());
    for (const LightProfile& profile : desc_.profiles) {
        profiles_.emplace_back(profile);
    }
    find_bodies();
    lights_ = std::make_unique<const LightSet>(desc_.instances, placed_, materials_, desc_.lights,
                                               profiles_, sphere_);
    counts_ = count(desc_);
    counts_.lights = lights_->size();
    counts_.emissive_triangles = lights_->size() - desc_.lights.size();
}

Material World::make_material(const MaterialDesc& desc, const Exterior& exterior)
{
    const auto [red, green, blue] = boundary_indices(desc, exterior).greater_by_less;
    const bool mip_mapped = desc_.texture_filter == TextureFilter::mip_mapped;
    const Pictures pictures(desc_.images, mip_mapped ? &mip_maps_ : nullptr);
    Material material(desc, pictures, {albedo_of(red), albedo_of(green), albedo_of(blue)},
                      layer_tables_.get(), exterior);
    disperses_ = disperses_ || material.disperses();
    return material;
}

const SideMedia* World::medium_at(Vec3 p) const
{
    const auto body = bodies_ ? bodies_->at(p) : std::nullopt;
    return body ? material_of(*body).media_within() : nullptr;
}

const SpecularAlbedo& World::albedo_of(float ior)
{
    auto& albedo = albedos_[ior];
    if (!albedo) {
        albedo = std::make_unique<const SpecularAlbedo>(ior);
    }
    return *albedo;
}

const Material& World::material_of(std::uint32_t instance) const noexcept
{
    return materials_[static_cast<std::size_t>(desc_.instances[instance].material)];
}

bool World::may_be_passed(std::uint32_t instance) const noexcept
{
    const Material& material = material_of(instance);
    return material.alpha_mode() != AlphaMode::opaque &&
           (material.least_opacity() < 1.0f || !placed_[instance].mesh().colors.empty());
}

bool World::is_passed(const Crossing& crossing) const noexcept
{
    const Material& material = material_of(crossing.instance);
    if (material.alpha_mode() == AlphaMode::opaque) {
        return false;  // an instance of a mesh that others share
    }
    const float opacity = material.opacity(
        texture_point(placed_[crossing.instance], crossing.triangle, crossing.barycentrics));
    return crossing.segment.at_surface(crossing.instance, crossing.triangle) >= opacity;
}

PassRule World::pass_rule() const noexcept
{
    return {.owner = this,
            .concerns =
                [](const void* world, std::uint32_t instance) noexcept {
                    return static_cast<const World*>(world)->may_be_passed(instance);
                },
            .passes =
                [](const void* world, const Crossing& crossing) noexcept {
                    return static_cast<const World*>(world)->is_passed(crossing);
                }};
}

std::optional<RayHit> World::first_hit(const SegmentEnd& from, Vec3 direction,
                                       SegmentKey segment) const noexcept
{
    return embree_->intersect({.origin = offset_origin(from.p, from.error, from.ng, direction),
                               .direction = direction,
                               .ignored_sphere = from.sphere,
                               .segment = segment});
}

SurfacePoint World::surface_at(const RayHit& hit, Vec3 direction, SegmentKey segment,
                               const PixelCone& pixel) const noexcept
{
    if (hit.sphere != no_sphere) [[unlikely]] {
        return sphere_point(hit, direction, segment.time);
    }
    return mesh_point(hit, direction, segment, pixel);
}

/// Spheres are lights: they emit from their outside and reflect nothing.
SurfacePoint World::sphere_point(const RayHit& hit, Vec3 direction, float time) const noexcept
{
    const LightId id = lights_->of_sphere(hit.sphere);
    const auto& light = std::get<SphereLight>((*lights_)[id].model());
    const bool outside = dot(hit.at.normal, direction) < 0.0f;
    return {.end = light.surface(hit.at.normal, time),
            .bsdf = Bsdf(),
            .emission = outside ? light.radiance(-direction, time) : Rgb(0.0f),
            .light = id};
}

SurfacePoint World::mesh_point(const RayHit& hit, Vec3 direction, SegmentKey segment,
                               const PixelCone& pixel) const noexcept
{
    const PlacedMesh& mesh = placed_[hit.instance];
    const Material& material = material_of(hit.instance);

    const float length_squared = dot(hit.at.normal, hit.at.normal);
    const Vec3 ng = length_squared > 0.0f ? hit.at.normal / std::sqrt(length_squared) : -direction;
    Vec3 ns = mesh.shading_normal(hit.triangle, hit.at.barycentrics, segment.time);
    const float side = dot(ns, ng);
    ns = side > 0.0f ? ns : side < 0.0f ? -ns : ng;

    const bool varies = material.has_textures() || !mesh.mesh().colors.empty();
    const TexturePoint at =
        varies ? texture_point(mesh, hit.triangle, hit.at.barycentrics) : TexturePoint{};
    const auto tangent_uv_set = material.tangent_uv_set();
    std::optional<UvFootprint> footprint;
    if (material.needs_footprint()) [[unlikely]] {
        footprint = mesh.uv_footprint(hit.triangle, pixel.width_at(hit.at.point.p), segment.time);
    }
    const ShadingPoint shading{.ng = ng,
                               .ns = ns,
                               .tangent = tangent_uv_set
                                              ? mesh.tangent(hit.triangle, hit.at.barycentrics,
                                                             *tangent_uv_set, segment.time)
                                              : Vec4(0.0f),
                               .uv = at.uv,
                               .color = at.color,
                               .wavelength = segment.wavelength,
                               .wo = -direction,
                               .footprint = footprint ? &*footprint : nullptr};

    SurfacePoint result{.end = {.p = hit.at.point.p,
                                .error = hit.at.point.error,
                                .ng = ng,
                                .media = material.media()},
                        .bsdf = material.bsdf(shading),
                        .emission = Rgb(0.0f),
                        .light = lights_->of_triangle(hit.instance, hit.triangle),
                        .barycentrics = hit.at.barycentrics,
                        .disperses = material.disperses()};
    if (result.light && (dot(ng, direction) < 0.0f || material.emits_from_both_sides())) {
        result.emission = material.emission(at);
    }
    return result;
}

Rgb World::transmittance(const SegmentEnd& a, const SegmentEnd& b,
                         SegmentKey segment) const noexcept
{
    // Both ends are moved to their own side of their surfaces, so the whole segment between them is
    // tested; the factor only keeps rounding of the end from reaching through.
    constexpr float short_of_end = 1.0f - 8.0f * std::numeric_limits<float>::epsilon();
    const Vec3 to_b = b.p - a.p;
    const Vec3 origin = offset_origin(a.p, a.error, a.ng, to_b);
    const Vec3 target = offset_origin(b.p, b.error, b.ng, -to_b);
    // Spheres only emit, so at most one end is on one, where light leaves it.
    if (embree_->occluded({.origin = origin,
                           .direction = target - origin,
                           .t_max = short_of_end,
                           .ignored_sphere = a.sphere != no_sphere ? a.sphere : b.sphere,
                           .segment = segment})) {
        return Rgb(0.0f);
    }
    return a.media == nullptr && b.media == nullptr
               ? Rgb(1.0f)
               : medium_transmittance(a, b, to_b, std::sqrt(dot(to_b, to_b)));
}

Rgb World::transmittance_to_infinity(const SegmentEnd& a, Vec3 direction,
                                     SegmentKey segment) const noexcept
{
    if (embree_->occluded({.origin = offset_origin(a.p, a.error, a.ng, direction),
                           .direction = direction,
                           .segment = segment})) {
        return Rgb(0.0f);
    }
    return medium_transmittance(a, {}, direction, std::numeric_limits<float>::max());
}

}  // namespace bdpt
