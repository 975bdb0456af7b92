#include "scene/world.h"

#include "geometry/ray.h"
#include "math/rgb.h"
#include "scene/world_builder.h"

#include <bdpt/thread_limit.h>

#include <glm/geometric.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <functional>
#include <utility>

namespace bdpt {
namespace {

Ray ray_from(const SegmentEnd& from, Vec3 direction, SegmentKey segment)
{
    return {.origin = offset_origin(from.p, from.error, from.ng, direction),
            .direction = direction,
            .ignored_sphere = from.sphere,
            .segment = segment};
}

/// Constructs a scattering point of a medium or volume; `around` is the medium at that point.
SurfacePoint scattering_point(Vec3 p, Vec3 direction, MediumId around,
                              const HenyeyGreenstein& phase)
{
    const Vec3 wo = -direction;
    SurfacePoint point;
    point.end.p = p;
    point.end.media = SideMedia::around(around);
    point.bsdf = Bsdf(wo, Frame::from_normal(wo), wo, phase);
    return point;
}

/// A type of its own, because the type of a plain function would be visible outside of the library.
struct ForRowsAtOnce {
    void operator()(int count, const std::function<void(int, int)>& work) const
    {
        tbb::parallel_for(tbb::blocked_range<int>(0, count, 16),
                          [&work](const auto& rows) { work(rows.begin(), rows.end()); });
    }
};

}  // namespace

World::World(SharedSceneDesc desc, Isa isa, const World* like)
    : desc_(std::move(desc)),
      mip_maps_(ForRowsAtOnce{}),
      all_materials_(std::make_shared<std::vector<Material>>())
{
    limit_threads(0);
    WorldBuilder(*this, like).build(isa);
}

void World::set_geometry(std::shared_ptr<const SceneGeometry> geometry)
{
    geometry_ = std::move(geometry);
    placed_ = geometry_->placed;
}

MediumId World::medium_at(Vec3 p) const
{
    const auto body = bodies_ ? bodies_->volumes->at(p) : std::nullopt;
    return body ? material_sources_[static_cast<std::size_t>(material_ids_[*body])].within : fog_;
}

const Material& World::find_material(std::uint32_t instance) const noexcept
{
    return materials_[static_cast<std::size_t>(material_ids_[instance])];
}

const Material& World::find_material(const RayHit& hit) const noexcept
{
    if (!bond_materials_.empty()) [[unlikely]] {
        const std::span<const Bond> bonds = geometry_->contacts.bonds;
        if (const Bond* bond = find_bond(bonds, hit.instance, hit.triangle)) {
            return materials_[static_cast<std::size_t>(
                bond_materials_[static_cast<std::size_t>(bond - bonds.data())])];
        }
    }
    return find_material(hit.instance);
}

bool World::may_be_passed(std::uint32_t instance) const noexcept
{
    const Material& material = find_material(instance);
    if (material.clear_sheet() != nullptr) {
        return true;
    }
    return material.alpha_mode() != AlphaMode::opaque &&
           (material.min_opacity() < 1.0f || !placed_[instance].mesh().colors.empty());
}

bool World::may_tint(std::uint32_t instance) const noexcept
{
    const Material& material = find_material(instance);
    return material.clear_sheet() != nullptr &&
           !(material.is_untinted() && placed_[instance].mesh().colors.empty());
}

float World::opacity_at(const AnyHit& surface) const noexcept
{
    const Material& material = find_material(surface.instance);
    if (const ClearSheet* sheet = material.clear_sheet()) {
        const Vec3 direction = surface.direction;
        const Vec3 ns = shading_normal(placed_[surface.instance], surface.triangle,
                                       surface.barycentrics, surface.ng, surface.segment.time);
        return sheet->reflectance(std::abs(dot(ns, direction)) /
                                  std::sqrt(dot(direction, direction)));
    }
    if (material.alpha_mode() == AlphaMode::opaque) {
        return 1.0f;  // instance of a shared mesh
    }
    return material.opacity(
        texture_point(placed_[surface.instance], surface.triangle, surface.barycentrics));
}

Rgb World::tint_at(const AnyHit& surface) const noexcept
{
    const Material& material = find_material(surface.instance);
    return material.clear_sheet() == nullptr
               ? Rgb(1.0f)
               : material.tint(texture_point(placed_[surface.instance], surface.triangle,
                                             surface.barycentrics));
}

AnyHitFilter World::any_hit_filter() const noexcept
{
    return {.owner = this,
            .concerns =
                [](const void* world, std::uint32_t instance) noexcept {
                    return static_cast<const World*>(world)->may_be_passed(instance);
                },
            .opacity =
                [](const void* world, const AnyHit& surface) noexcept {
                    return static_cast<const World*>(world)->opacity_at(surface);
                },
            .tint =
                [](const void* world, const AnyHit& surface) noexcept {
                    return static_cast<const World*>(world)->tint_at(surface);
                }};
}

std::optional<RayHit> World::first_hit(const SegmentEnd& from, Vec3 direction, SegmentKey segment,
                                       bool* is_tinted) const noexcept
{
    if (!has_tinted_surfaces_ || is_tinted == nullptr) [[likely]] {
        return embree_->intersect(ray_from(from, direction, segment));
    }
    RayPassage passage(PassageRule::chance);
    passage.look_for_tints();
    const auto hit = embree_->intersect(ray_from(from, direction, segment), &passage);
    *is_tinted = passage.is_tinted();
    return hit;
}

std::optional<RayHit> World::first_hit(const SegmentEnd& from, Vec3 direction, SegmentKey segment,
                                       RayPassage& passage) const noexcept
{
    return embree_->intersect(ray_from(from, direction, segment), &passage);
}

RayHit World::hit_at(const SegmentEnd& from, Vec3 direction, SegmentKey segment,
                     const Crossing& crossing) const noexcept
{
    return embree_->hit_at(ray_from(from, direction, segment), crossing);
}

Rgb World::tint(const SegmentEnd& from, Vec3 direction, float distance, SegmentKey segment,
                const std::optional<RayHit>& end) const noexcept
{
    RayPassage passage(PassageRule::tint);
    if (end && end->sphere == no_sphere) {
        passage.leave_out(end->instance, end->triangle);
    }
    Ray ray = ray_from(from, direction, segment);
    ray.t_max = distance;
    static_cast<void>(embree_->intersect(ray, &passage));
    return passage.factor();
}

SurfacePoint World::surface_at(const RayHit& hit, Vec3 direction, SegmentKey segment,
                               const PixelCone& pixel) const noexcept
{
    if (hit.sphere != no_sphere) [[unlikely]] {
        return sphere_point(hit, direction, segment.time);
    }
    return mesh_point(hit, direction, segment, pixel);
}

Vec2 World::uv_at(const RayHit& hit) const noexcept
{
    return hit.sphere != no_sphere ? Vec2(0.0f)
                                   : placed_[hit.instance].uv(hit.triangle, hit.at.barycentrics)[0];
}

/// Constructs a point on a sphere, which is a light: it emits on its outside and reflects nothing.
SurfacePoint World::sphere_point(const RayHit& hit, Vec3 direction, float time) const noexcept
{
    const LightId id = lights_->of_sphere(hit.sphere);
    const auto& light = std::get<SphereLight>((*lights_)[id].model());
    const bool outside = dot(hit.at.ng, direction) < 0.0f;
    SurfacePoint result;
    result.end = end_at(hit, direction, time);
    result.emission = outside ? light.radiance(-direction, time) : Rgb(0.0f);
    result.light = id;
    return result;
}

/// Returns the BSDF of a surface that varies: textures, vertex colours, tangents.
Bsdf World::varying_bsdf(const RayHit& hit, const ShadingNormals& normals, Vec3 wo,
                         SegmentKey segment, const PixelCone& pixel) const noexcept
{
    const Material& material = find_material(hit);
    if (const ClearSheet* sheet = material.clear_sheet()) {
        return {normals.ng, Frame::from_normal(normals.ns), wo, *sheet};
    }
    const PlacedMesh& mesh = placed_[hit.instance];
    const TexturePoint at = texture_point(mesh, hit.triangle, hit.at.barycentrics);
    material.prefetch(at.uv);
    const auto tangent_uv_set = material.tangent_uv_set();
    std::optional<UvFootprint> footprint;
    if (material.needs_footprint()) [[unlikely]] {
        footprint = mesh.uv_footprint(hit.triangle, pixel.width_at(hit.at.point.p), segment.time);
    }
    return material.bsdf({.ng = normals.ng,
                          .ns = normals.ns,
                          .tangent = tangent_uv_set
                                         ? mesh.tangent(hit.triangle, hit.at.barycentrics,
                                                        *tangent_uv_set, segment.time)
                                         : Vec4(0.0f),
                          .uv = at.uv,
                          .color = at.color,
                          .wavelength = segment.wavelength,
                          .wo = wo,
                          .footprint = footprint ? &*footprint : nullptr});
}

Vec3 World::shading_normal(const PlacedMesh& mesh, std::uint32_t triangle, Vec2 barycentrics,
                           Vec3 ng, float time) const noexcept
{
    if (mesh.mesh().normals.empty()) {
        return ng;
    }
    const Vec3 ns = mesh.shading_normal(triangle, barycentrics, time);
    const float side = dot(ns, ng);
    return side > 0.0f ? ns : side < 0.0f ? -ns : ng;
}

SurfacePoint World::mesh_point(const RayHit& hit, Vec3 direction, SegmentKey segment,
                               const PixelCone& pixel) const noexcept
{
    const PlacedMesh& mesh = placed_[hit.instance];
    const Material& material = find_material(hit);

    const Vec3 wo = -direction;
    // By components, to keep them in registers.
    const bool has_area = hit.at.ng != Vec3(0.0f);
    const Vec3 ng(has_area ? hit.at.ng.x : wo.x, has_area ? hit.at.ng.y : wo.y,
                  has_area ? hit.at.ng.z : wo.z);
    const Vec3 ns = shading_normal(mesh, hit.triangle, hit.at.barycentrics, ng, segment.time);
    const bool even = material.is_even() && mesh.mesh().colors.empty();
    SurfacePoint result([&] {
        return even ? material.even_bsdf(ng, ns, wo)
                    : varying_bsdf(hit, {ng, ns}, wo, segment, pixel);
    });
    result.end.p = hit.at.point.p;
    result.end.error = hit.at.point.error;
    result.end.ng = ng;
    result.end.media = material.media();
    result.light = lights_->of_triangle(hit.instance, hit.triangle);
    result.barycentrics = hit.at.barycentrics;
    result.disperses = material.disperses();
    if (result.light && (dot(ng, direction) < 0.0f || material.emits_from_both_sides())) {
        result.emission = material.emission(texture_point(mesh, hit.triangle, hit.at.barycentrics));
    }
    if (material.alpha_mode() == AlphaMode::blend) [[unlikely]] {
        result.opacity = material.opacity(texture_point(mesh, hit.triangle, hit.at.barycentrics));
    } else if (!even) {
        if (const ClearSheet* sheet = material.clear_sheet()) {
            const Rgb tint = material.tint(texture_point(mesh, hit.triangle, hit.at.barycentrics));
            result.opacity =
                1.0f - luminance(tint) * (1.0f - sheet->reflectance(std::abs(dot(ns, wo))));
        }
    }
    return result;
}

SegmentEnd World::end_at(const RayHit& hit, Vec3 direction, float time) const noexcept
{
    if (hit.sphere != no_sphere) [[unlikely]] {
        const Light& light = (*lights_)[lights_->of_sphere(hit.sphere)];
        SegmentEnd end = std::get<SphereLight>(light.model()).surface(hit.at.ng, time);
        end.media = light.media();
        return end;
    }
    return {.p = hit.at.point.p,
            .error = hit.at.point.error,
            .ng = hit.at.ng != Vec3(0.0f) ? hit.at.ng : -direction,
            .media = find_material(hit).media()};
}

SurfacePoint World::medium_point(const SegmentEnd& from, Vec3 direction,
                                 const MediumEvent& event) const noexcept
{
    const Medium& medium = media_[event.medium];
    return scattering_point(from.p + event.distance * direction, direction, event.medium,
                            HenyeyGreenstein(medium.scattering, medium.anisotropy));
}

SurfacePoint World::volume_point(const SegmentEnd& from, Vec3 direction, const VolumeEvent& event,
                                 MediumId around) const noexcept
{
    const Volume& volume = volumes_[event.volume];
    return scattering_point(
        from.p + event.distance * direction, direction, around,
        HenyeyGreenstein(volume.extinction(event.density) * volume.albedo(), volume.anisotropy()));
}

bool World::is_blocked(const Ray& ray, Rgb& passing) const noexcept
{
    if (!has_passable_surfaces_) [[likely]] {
        return embree_->occluded(ray);
    }
    RayPassage passage(ray.segment.has_chance() ? PassageRule::expectation : PassageRule::chance);
    if (embree_->occluded(ray, &passage)) {
        return true;
    }
    passing *= passage.factor();
    return false;
}

std::optional<SegmentTransmission> World::transmission(const SegmentEnd& a, const SegmentEnd& b,
                                                       SegmentKey segment) const noexcept
{
    // Both ends are offset to their own side of their surfaces, so the whole segment between them
    // is tested; the factor only keeps the ray from reaching beyond the end by rounding.
    constexpr float short_of_end = 1.0f - 8.0f * std::numeric_limits<float>::epsilon();
    const Vec3 to_b = b.p - a.p;
    const Vec3 origin = offset_origin(a.p, a.error, a.ng, to_b);
    const Vec3 target = offset_origin(b.p, b.error, b.ng, -to_b);
    // Spheres only emit, so at most one end is on a sphere, where light leaves it.
    const Ray ray{.origin = origin,
                  .direction = target - origin,
                  .t_max = short_of_end,
                  .ignored_sphere = a.sphere != no_sphere ? a.sphere : b.sphere,
                  .segment = segment};
    Rgb passing(1.0f);
    if (is_blocked(ray, passing)) {
        return std::nullopt;
    }
    if (!media_.any() && !volumes_.any()) {
        return SegmentTransmission{.transmittance = passing};
    }
    const float distance = std::sqrt(dot(to_b, to_b));
    SegmentTransmission transmission = media_.transmission(a, b, to_b, distance);
    if (volumes_.any()) {
        transmission.transmittance *=
            volumes_.transmittance(a.p, to_b / distance, distance, segment);
    }
    transmission.transmittance *= passing;
    return transmission;
}

std::optional<SegmentTransmission> World::transmission_to_infinity(
    const SegmentEnd& a, Vec3 direction, SegmentKey segment) const noexcept
{
    const Ray ray = ray_from(a, direction, segment);
    Rgb passing(1.0f);
    if (is_blocked(ray, passing)) {
        return std::nullopt;
    }
    constexpr float infinite = std::numeric_limits<float>::max();
    SegmentTransmission transmission = media_.transmission(a, {}, direction, infinite);
    if (volumes_.any()) {
        transmission.transmittance *= volumes_.transmittance(a.p, direction, infinite, segment);
    }
    transmission.transmittance *= passing;
    return transmission;
}

Rgb World::transmittance(const SegmentEnd& a, const SegmentEnd& b,
                         SegmentKey segment) const noexcept
{
    const auto free = transmission(a, b, segment);
    return free ? free->transmittance : Rgb(0.0f);
}

Rgb World::transmittance_to_infinity(const SegmentEnd& a, Vec3 direction,
                                     SegmentKey segment) const noexcept
{
    const auto free = transmission_to_infinity(a, direction, segment);
    return free ? free->transmittance : Rgb(0.0f);
}

}  // namespace bdpt
