#include "path/connect.h"

#include "math/rgb.h"
#include "path/densities.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace bdpt {
namespace {

const PathVertex& before_last(std::span<const PathVertex> path)
{
    return path[path.size() - 2];
}

/// Density of sampling `neighbor` in the direction whose density is given.
AreaPdf at_neighbor(SolidAnglePdf pdf, const PathVertex& neighbor)
{
    return {pdf.value * neighbor.area_per_solid_angle};
}

/// Density of sampling `end` from a point at squared distance `distance_squared`; `w` joins them.
AreaPdf at_end(SolidAnglePdf pdf, const SegmentEnd& end, Vec3 w, float distance_squared)
{
    return to_area(pdf, abs_cosine(end, w), distance_squared);
}

/// The flight between a vertex and one next to it on a path, or a light at infinity.
Flight flight_between(const World& world, const PathVertex& vertex, const PathVertex& other)
{
    if (!world.media().any()) {
        return {};
    }
    if (other.kind == VertexKind::infinite) {
        return world.media().flight(vertex.end, other.end, other.end.p,
                                    std::numeric_limits<float>::max());
    }
    const Vec3 along = other.end.p - vertex.end.p;
    return world.media().flight(vertex.end, other.end, along, std::sqrt(dot(along, along)));
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
    sample.enter(Phase::weigh);
    const PathVertex& x1 = before_last(camera);
    const LightDensities densities = light_densities(sample, x0, x1.end);
    const Flight flight = flight_between(sample.world, x1, x0);
    return Contribution{
        .unweighted = value,
        .weight = weigher.weight(
            {}, camera,
            {.light_at_camera_end = densities.emit,
             .light_at_camera_neighbor = densities.to_next * probability_to(x1, flight),
             .camera_at_light_end = {},
             .camera_at_light_neighbor = {},
             .next_event = next_event_density(sample, x0, x1, weigher.next_event_sampling())}),
        .dispersed = x0.dispersed};
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
    const World& world = sample.world;
    Sampler& sampler = sample.sampler;
    const PathVertex& z = camera.back();
    if (!scatters(z.kind) || !z.connectible) {
        return std::nullopt;
    }
    const NextEventSampling sampling = weigher.next_event_sampling();
    const auto choice = world.lights().choose_for_context(
        [&z] { return light_sample_context(z); }, u, [&sampler] { return sampler.next_fine(); },
        sampling.lights);
    if (!choice) {
        return std::nullopt;
    }
    const Light& light = world.lights()[choice->id];
    const auto incident =
        light.sample_incident(z.end.p, choice->u, sampling.environments, sample.time);
    if (!incident) {
        return std::nullopt;
    }
    const BsdfEval f = z.bsdf->eval(incident->wi, TransportMode::radiance);
    Rgb value = z.beta * f.f_cos * incident->weight / choice->probability;
    if (is_black(value)) {
        return std::nullopt;
    }
    PathVertex x0;
    x0.light = choice->id;
    if (light.is_infinite()) {
        x0.kind = VertexKind::infinite;
        x0.end.p = incident->wi;
    } else {
        x0.kind = VertexKind::light;
        x0.end = incident->end;
        x0.barycentrics = incident->barycentrics;
    }
    ++sample.rays.shadow;
    const SegmentKey segment = sample.segment(1, static_cast<int>(camera.size()));
    const auto flight = light.is_infinite() ? world.flight_to_infinity(z.end, incident->wi, segment)
                                            : world.flight(z.end, x0.end, segment);
    if (!flight || is_black(value *= flight->transmittance)) {
        return std::nullopt;
    }
    sample.enter(Phase::weigh);
    const LightDensities densities = light_densities(sample, x0, z.end);
    x0.pdf_fwd = densities.emit;
    const AreaPdf from_camera =
        light.is_infinite()
            ? AreaPdf{f.pdf_fwd.value}
            : at_end(f.pdf_fwd, x0.end, incident->wi, incident->distance * incident->distance);
    return Contribution{
        .unweighted = value,
        .weight =
            weigher.weight(std::span(&x0, 1), camera,
                           {.light_at_camera_end = densities.to_next * probability_to(z, *flight),
                            .light_at_camera_neighbor = at_neighbor(f.pdf_rev, before_last(camera)),
                            .camera_at_light_end = from_camera * flight->pass,
                            .camera_at_light_neighbor = {},
                            .next_event = incident->pdf * choice->probability}),
        .dispersed = z.dispersed};
}

std::optional<Splat> connect_light_to_lens(SampleContext& sample, PathWeigher& weigher)
{
    const World& world = sample.world;
    const Camera& camera = sample.camera;
    Sampler& sampler = sample.sampler;
    sampler.start(SampleUse::lens, 1);
    const Vec2 u_lens = camera.has_finite_lens() ? sampler.next_2d() : Vec2(0.0f);
    // The lens is the receiver; where on it is settled before the light is chosen.
    const SegmentEnd receiver = camera.generate_ray(Vec2(0.0f), u_lens).lens;
    sampler.start(SampleUse::next_event, 1);
    const Vec2 u = sampler.next_2d();
    const auto choice = world.lights().choose_for_context(
        LightSampleContext{.p = receiver.p}, u, [&sampler] { return sampler.next_fine(); },
        weigher.next_event_sampling().lights);
    if (!choice || !can_be_seen_directly(world.lights()[choice->id], camera)) {
        return std::nullopt;
    }
    const auto incident = world.lights()[choice->id].sample_incident(
        receiver.p, choice->u, EnvironmentSampling::plain, sample.time);
    if (!incident) {
        return std::nullopt;
    }
    const auto to_lens = camera.sample_lens(incident->end.p, u_lens);
    if (!to_lens) {
        return std::nullopt;
    }
    Rgb value = incident->weight * (to_lens->pdf_direction.value / choice->probability);
    if (is_black(value)) {
        return std::nullopt;
    }
    ++sample.rays.shadow;
    const auto flight = world.flight(incident->end, to_lens->lens, sample.segment(1, 1));
    if (!flight || is_black(value *= flight->transmittance)) {
        return std::nullopt;
    }
    sample.enter(Phase::weigh);
    PathVertex x0;
    x0.light = choice->id;
    x0.kind = VertexKind::light;
    x0.end = incident->end;
    x0.barycentrics = incident->barycentrics;
    const LightDensities densities = light_densities(sample, x0, to_lens->lens);
    x0.pdf_fwd = densities.emit;
    PathVertex lens;
    lens.kind = VertexKind::camera;
    lens.end = to_lens->lens;
    lens.pdf_fwd = to_lens->pdf_lens;
    const float distance_squared = incident->distance * incident->distance;
    const float weight = weigher.weight(
        std::span(&x0, 1), std::span(&lens, 1),
        {.light_at_camera_end = densities.to_next * flight->pass,
         .light_at_camera_neighbor = {},
         .camera_at_light_end =
             at_end(to_lens->pdf_direction, x0.end, to_lens->wi, distance_squared) * flight->pass,
         .camera_at_light_neighbor = {},
         .next_event = incident->pdf * choice->probability});
    return Splat{.contribution = {.unweighted = value, .weight = weight, .dispersed = false},
                 .raster = to_lens->raster};
}

std::optional<Splat> connect_to_lens(SampleContext& sample, std::span<const PathVertex> light,
                                     PathWeigher& weigher)
{
    const Camera& camera = sample.camera;
    Sampler& sampler = sample.sampler;
    const PathVertex& y = light.back();
    if (!y.connectible) {
        return std::nullopt;
    }
    sampler.start(SampleUse::lens, static_cast<std::uint32_t>(light.size()));
    const Vec2 u_lens = camera.has_finite_lens() ? sampler.next_2d() : Vec2(0.0f);
    const auto to_lens = camera.sample_lens(y.end.p, u_lens);
    if (!to_lens) {
        return std::nullopt;
    }
    const BsdfEval f = y.bsdf->eval(to_lens->wi, TransportMode::importance);
    Rgb value = y.beta * f.f_cos * to_lens->weight;
    if (is_black(value)) {
        return std::nullopt;
    }
    ++sample.rays.shadow;
    ++sample.rays.shadow_to_lens;
    const auto flight = sample.world.flight(y.end, to_lens->lens,
                                            sample.segment(static_cast<int>(light.size()), 1));
    if (!flight || is_black(value *= flight->transmittance)) {
        return std::nullopt;
    }
    sample.enter(Phase::weigh);
    const float distance_squared = to_lens->distance * to_lens->distance;
    const float cosine = abs_cosine(y.end, to_lens->wi);
    PathVertex lens;
    lens.kind = VertexKind::camera;
    lens.end = to_lens->lens;
    lens.pdf_fwd = to_lens->pdf_lens;
    const float weight = weigher.weight(
        light, std::span(&lens, 1),
        {.light_at_camera_end =
             at_end(f.pdf_fwd, lens.end, to_lens->wi, distance_squared) * flight->pass,
         .light_at_camera_neighbor = {},
         .camera_at_light_end =
             (to_lens->pdf_plane ? to_area(*to_lens->pdf_plane, cosine)
                                 : to_area(to_lens->pdf_direction, cosine, distance_squared)) *
             probability_to(y, *flight),
         .camera_at_light_neighbor = at_neighbor(f.pdf_rev, before_last(light)),
         .next_event = light[0].pdf_next_event});
    return Splat{.contribution = {.unweighted = value, .weight = weight, .dispersed = y.dispersed},
                 .raster = to_lens->raster};
}

std::optional<Splat> hit_lens(const SampleContext& sample, const Subpath& light_path,
                              const LensCrossing& crossing, PathWeigher& weigher)
{
    const Rgb value = crossing.lens.beta * crossing.importance;
    if (is_black(value)) {
        return std::nullopt;
    }
    sample.enter(Phase::weigh);
    const auto light = light_path.first(crossing.light_vertices);
    const AreaPdf next_event =
        light.size() > 1
            ? light[0].pdf_next_event
            : next_event_density(sample, light[0], crossing.lens, weigher.next_event_sampling());
    const AreaPdf neighbor = light.size() > 1 ? before_last(light).pdf_rev : AreaPdf{};
    const float weight = weigher.weight_of_hit(light, crossing.lens,
                                               {.light_at_camera_end = crossing.lens.pdf_rev,
                                                .light_at_camera_neighbor = {},
                                                .camera_at_light_end = crossing.camera_at_light_end,
                                                .camera_at_light_neighbor = neighbor,
                                                .next_event = next_event});
    return Splat{.contribution = {.unweighted = value,
                                  .weight = weight,
                                  .dispersed = light.back().dispersed},
                 .raster = crossing.raster};
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
    Rgb value = z.beta * f_z.f_cos * f_y.f_cos * y.beta * (1.0f / distance_squared);
    if (is_black(value)) {
        return std::nullopt;
    }
    ++sample.rays.shadow;
    ++sample.rays.shadow_interior;
    const auto flight = sample.world.flight(
        z.end, y.end,
        sample.segment(static_cast<int>(light.size()), static_cast<int>(camera.size())));
    if (!flight || is_black(value *= flight->transmittance)) {
        return std::nullopt;
    }
    sample.enter(Phase::weigh);
    return Contribution{
        .unweighted = value,
        .weight = weigher.weight(
            light, camera,
            {.light_at_camera_end =
                 at_end(f_y.pdf_fwd, z.end, wi, distance_squared) * probability_to(z, *flight),
             .light_at_camera_neighbor = at_neighbor(f_z.pdf_rev, before_last(camera)),
             .camera_at_light_end =
                 at_end(f_z.pdf_fwd, y.end, wi, distance_squared) * probability_to(y, *flight),
             .camera_at_light_neighbor = at_neighbor(f_y.pdf_rev, before_last(light)),
             .next_event = light[0].pdf_next_event}),
        .dispersed = y.dispersed || z.dispersed};
}

}  // namespace bdpt
