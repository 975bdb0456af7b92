#include "path/connect.h"

#include "math/low_level.h"
#include "math/rgb.h"
#include "path/densities.h"
#include "path/direct_light.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace bdpt {
namespace {

/// Returns the area density of the neighbour of the end of `path`, sampled from the end with the
/// given density of directions; zero without a neighbour.
AreaPdf at_neighbor(SolidAnglePdf pdf, std::span<const PathVertex> path)
{
    return path.size() < 2 ? AreaPdf{}
                           : AreaPdf{pdf.value * path[path.size() - 2].area_per_solid_angle};
}

/// Returns the density of sampling `end` from a point at squared distance `distance_squared` in
/// direction `w`.
AreaPdf at_end(SolidAnglePdf pdf, const SegmentEnd& end, Vec3 w, float distance_squared)
{
    return to_area(pdf, abs_cosine(end, w), distance_squared);
}

/// Returns the transmission between a vertex and the next one of its walk, or a light at infinity.
SegmentTransmission walked_transmission(const World& world, const PathVertex& vertex,
                                        const PathVertex& other)
{
    if (!world.media().any()) {
        return {};
    }
    if (other.kind == VertexKind::infinite) {
        return world.media().transmission(vertex.end, other.end, other.end.p,
                                          std::numeric_limits<float>::max());
    }
    const Vec3 along = other.end.p - vertex.end.p;
    return world.media().transmission(vertex.end, other.end, along, std::sqrt(dot(along, along)));
}

/// Returns the transmission of the segment that connects two subpaths; nullopt if it is blocked.
std::optional<SegmentTransmission> joining_transmission(const SampleContext& sample,
                                                        std::span<const PathVertex> light,
                                                        std::span<const PathVertex> camera)
{
    const PathVertex& y = light.back();
    const PathVertex& z = camera.back();
    const SegmentKey segment =
        sample.segment(static_cast<int>(light.size()), static_cast<int>(camera.size()));
    ++sample.rays.shadow;
    if (camera.size() == 1) {
        sample.rays.shadow_to_lens += light.size() > 1 ? 1U : 0U;
        return sample.world.transmission(y.end, z.end, segment);
    }
    ++sample.rays.shadow_interior;
    return sample.world.transmission(z.end, y.end, segment);
}

/// Returns the contribution of a connection between the ends of two subpaths. `join` are its
/// densities, excluding the transmission between its ends.
Contribution connection(std::span<const PathVertex> light, std::span<const PathVertex> camera,
                        Rgb value, const SegmentTransmission& transmission, JoinDensities join,
                        PathWeigher& weigher)
{
    const PathVertex& y = light.back();
    const PathVertex& z = camera.back();
    join.light_at_camera_end = join.light_at_camera_end * pdf_of_end(z, transmission);
    join.camera_at_light_end = join.camera_at_light_end * pdf_of_end(y, transmission);
    return {.unweighted = value,
            .weight = weigher.weight(light, camera, join),
            .dispersed = y.dispersed || z.dispersed};
}

/// Connects the ends of two subpaths unless the segment is blocked: `value` is the unattenuated
/// value, `densities()` are those of `connection`.
template <typename Densities>
std::optional<Contribution> join(const SampleContext& sample, std::span<const PathVertex> light,
                                 std::span<const PathVertex> camera, Rgb value,
                                 PathWeigher& weigher, const Densities& densities)
{
    if (is_black(value)) {
        return std::nullopt;
    }
    const auto transmission = joining_transmission(sample, light, camera);
    if (!transmission || is_black(value * transmission->transmittance)) {
        return std::nullopt;
    }
    return connection(light, camera, value * transmission->transmittance, *transmission,
                      densities(), weigher);
}

/// Returns the vertex at a new point on light `id`.
PathVertex light_vertex(const World& world, LightId id, const IncidentSample& incident)
{
    PathVertex x0 = blank<PathVertex>;
    x0.light = id;
    if (world.lights()[id].is_infinite()) {
        x0.kind = VertexKind::infinite;
        x0.end.p = incident.wi;
    } else {
        x0.kind = VertexKind::light;
        x0.end = incident.end;
        x0.barycentrics = incident.barycentrics;
    }
    return x0;
}

/// Draws the random point on the lens of the strategy with `s` light vertices.
Vec2 random_lens_point(SampleContext& sample, std::size_t s)
{
    sample.sampler.start(SampleUse::lens, static_cast<std::uint32_t>(s));
    return sample.camera.has_finite_lens() ? sample.sampler.next_2d() : Vec2(0.0f);
}

PathVertex lens_vertex(const LensSample& to_lens)
{
    PathVertex lens = blank<PathVertex>;
    lens.kind = VertexKind::camera;
    lens.end = to_lens.lens;
    lens.pdf_fwd = to_lens.pdf_lens;
    return lens;
}

}  // namespace

std::optional<Contribution> hit_light(const SampleContext& sample,
                                      std::span<const PathVertex> camera, PathWeigher& weigher)
{
    const PathVertex& x0 = camera.back();
    const Rgb value = x0.beta * x0.emission;
    if (!x0.light || is_black(value)) {
        return std::nullopt;
    }
    if (camera.size() == 2 && weigher.is_seen_by_walks_alone(*x0.light)) {
        return Contribution{.unweighted = value, .weight = 1.0f, .dispersed = x0.dispersed};
    }
    const PathVertex& x1 = camera[camera.size() - 2];
    const LightDensities densities =
        light_densities(sample, x0, x1.end, weigher.next_event_sampling());
    const float arrival = pdf_of_end(x1, walked_transmission(sample.world, x1, x0));
    const float weight = weigher.weight(
        {}, camera,
        {.light_at_camera_end = densities.emit,
         .light_at_camera_neighbor = densities.to_next * arrival,
         .camera_at_light_end = {},
         .camera_at_light_neighbor = {},
         .next_event = next_event_density(sample, x0, x1, weigher.next_event_sampling())});
    return Contribution{.unweighted = value, .weight = weight, .dispersed = x0.dispersed};
}

Vec2 first_light_sample(SampleContext& sample, int t)
{
    sample.sampler.start(SampleUse::next_event, static_cast<std::uint32_t>(t));
    return sample.sampler.next_2d();
}

std::optional<Contribution> connect_to_light(SampleContext& sample,
                                             std::span<const PathVertex> camera, Vec2 u,
                                             PathWeigher& weigher)
{
    const PathVertex& z = camera.back();
    if (!scatters(z.kind) || !z.connectible) {
        return std::nullopt;
    }
    const auto next = sample.world.lights().sample_next_event(
        light_sample_context(z), u, [&sample] { return sample.sampler.next_fine(); },
        weigher.next_event_sampling(), sample.time);
    if (!next.incident) {
        return std::nullopt;
    }
    const IncidentSample& incident = *next.incident;
    const DirectLight found = direct_light(sample, z.end, *z.bsdf, next,
                                           sample.segment(1, static_cast<int>(camera.size())));
    const Rgb value = z.beta * found.value;
    if (is_black(value)) {
        return std::nullopt;
    }
    PathVertex x0 = light_vertex(sample.world, next.light, incident);
    const LightDensities densities =
        light_densities(sample, x0, z.end, weigher.next_event_sampling());
    x0.pdf_fwd = densities.emit;
    return connection(std::span(&x0, 1), camera, value, *found.transmission,
                      {.light_at_camera_end = densities.to_next,
                       .light_at_camera_neighbor = at_neighbor(found.f.pdf_rev, camera),
                       .camera_at_light_end = x0.kind == VertexKind::infinite
                                                  ? AreaPdf{found.f.pdf_fwd.value}
                                                  : at_end(found.f.pdf_fwd, x0.end, incident.wi,
                                                           incident.distance * incident.distance),
                       .camera_at_light_neighbor = {},
                       .next_event = next.pdf()},
                      weigher);
}

std::optional<Contribution> connect_light_to_lens(SampleContext& sample, PathWeigher& weigher)
{
    // The lens is the receiver; its point is sampled before the light is chosen.
    const Vec2 u_lens = random_lens_point(sample, 1);
    const Vec3 receiver = sample.camera.generate_ray(Vec2(0.0f), u_lens).lens.p;
    const Vec2 u = first_light_sample(sample, 1);
    const LightSet& lights = sample.world.lights();
    const auto sampled = lights.sample_next_event(
        {.p = receiver}, u, [&sample] { return sample.sampler.next_fine(); },
        weigher.next_event_sampling(), sample.time);
    if (!sampled.incident || !can_be_seen_directly(lights[sampled.light], sample.camera)) {
        return std::nullopt;
    }
    const IncidentSample& incident = *sampled.incident;
    const auto to_lens = sample.camera.sample_lens(incident.end.p, u_lens);
    if (!to_lens) {
        return std::nullopt;
    }
    PathVertex x0 = light_vertex(sample.world, sampled.light, incident);
    const PathVertex lens = lens_vertex(*to_lens);
    const Rgb value = lights[sampled.light].incident_weight(incident) *
                      (to_lens->pdf_direction.value / sampled.probability);
    auto found = join(sample, std::span(&x0, 1), std::span(&lens, 1), value, weigher, [&] {
        const LightDensities densities =
            light_densities(sample, x0, lens.end, weigher.next_event_sampling());
        x0.pdf_fwd = densities.emit;
        return JoinDensities{
            .light_at_camera_end = densities.to_next,
            .light_at_camera_neighbor = {},
            .camera_at_light_end = at_end(to_lens->pdf_direction, x0.end, to_lens->wi,
                                          incident.distance * incident.distance),
            .camera_at_light_neighbor = {},
            .next_event = sampled.pdf()};
    });
    if (found) {
        found->raster = to_lens->raster;
    }
    return found;
}

std::optional<Contribution> connect_to_lens(SampleContext& sample,
                                            std::span<const PathVertex> light, PathWeigher& weigher)
{
    const PathVertex& y = light.back();
    if (!y.connectible) {
        return std::nullopt;
    }
    const auto to_lens =
        sample.camera.sample_lens(y.end.p, random_lens_point(sample, light.size()));
    if (!to_lens) {
        return std::nullopt;
    }
    const PathVertex lens = lens_vertex(*to_lens);
    // Light subpaths scatter by the adjoint BSDF (docs/mis.md, 5).
    const BsdfEval f = y.bsdf->eval_to_lens(to_lens->wi);
    const Rgb value = y.beta * f.f_cos * to_lens->weight;
    auto found = join(sample, light, std::span(&lens, 1), value, weigher, [&] {
        const float distance_squared = to_lens->distance * to_lens->distance;
        return JoinDensities{
            .light_at_camera_end = at_end(f.pdf_fwd, lens.end, to_lens->wi, distance_squared),
            .light_at_camera_neighbor = {},
            .camera_at_light_end =
                to_lens->pdf_plane
                    ? to_area(*to_lens->pdf_plane, abs_cosine(y.end, to_lens->wi))
                    : at_end(to_lens->pdf_direction, y.end, to_lens->wi, distance_squared),
            .camera_at_light_neighbor = at_neighbor(f.pdf_rev, light),
            .next_event = light[0].pdf_next_event};
    });
    if (found) {
        found->raster = to_lens->raster;
    }
    return found;
}

std::optional<Contribution> connect_interior(const SampleContext& sample,
                                             std::span<const PathVertex> light,
                                             std::span<const PathVertex> camera,
                                             PathWeigher& weigher)
{
    const PathVertex& y = light.back();
    const PathVertex& z = camera.back();
    if (!scatters(z.kind) || !z.connectible || !y.connectible) {
        return std::nullopt;
    }
    const Vec3 to_y = y.end.p - z.end.p;
    const float distance_squared = dot(to_y, to_y);
    if (distance_squared < coincident) {
        return std::nullopt;
    }
    const Vec3 wi = to_y * (1.0f / std::sqrt(distance_squared));
    const BsdfEval f_z = z.bsdf->eval(wi, TransportMode::radiance);
    if (is_black(f_z.f_cos)) {
        return std::nullopt;
    }
    const BsdfEval f_y = y.bsdf->eval(-wi, TransportMode::importance);
    const Rgb value = z.beta * f_z.f_cos * f_y.f_cos * y.beta * (1.0f / distance_squared);
    return join(sample, light, camera, value, weigher, [&] {
        return JoinDensities{
            .light_at_camera_end = at_end(f_y.pdf_fwd, z.end, wi, distance_squared),
            .light_at_camera_neighbor = at_neighbor(f_z.pdf_rev, camera),
            .camera_at_light_end = at_end(f_z.pdf_fwd, y.end, wi, distance_squared),
            .camera_at_light_neighbor = at_neighbor(f_y.pdf_rev, light),
            .next_event = light[0].pdf_next_event};
    });
}

}  // namespace bdpt
