#include "path/random_walk.h"

#include "math/rgb.h"
#include "path/connect.h"
#include "path/densities.h"
#include "path/direct_light.h"
#include "path/segment_sample.h"

#include <glm/geometric.hpp>

#include <limits>

namespace bdpt {
namespace {

/// Appends the environment, where camera walks end; light walks cannot hit it.
void append_environment(const World& world, const WalkStep& step, const SegmentSample& event,
                        Subpath& path)
{
    const auto id = world.lights().environment();
    if (!id) {
        return;
    }
    const auto& light = std::get<EnvironmentLight>(world.lights()[*id].model());
    const bool dispersed = path.back().dispersed;
    PathVertex& vertex = path.append();
    vertex.kind = VertexKind::infinite;
    vertex.light = id;
    vertex.dispersed = dispersed;
    vertex.end.p = step.direction;
    vertex.beta = step.beta * event.weight();
    vertex.emission = light.radiance(step.direction);
    vertex.pdf_fwd = {step.pdf.value * event.probability()};
}

void append_point(const SurfacePoint& point, float distance_squared, const WalkStep& step,
                  const SegmentSample& event, Subpath& path)
{
    PathVertex& previous = path.back();
    PathVertex& vertex = path.append();
    vertex.end = point.end;
    vertex.kind = event.kind();
    vertex.beta = step.beta * event.weight();
    vertex.emission = point.emission;
    vertex.light = point.light;
    vertex.barycentrics = point.barycentrics;
    vertex.bsdf = &point.bsdf;
    vertex.connectible = point.bsdf.connectible();
    vertex.dispersed = previous.dispersed || point.disperses;
    vertex.opacity = point.opacity;
    const float cosine = abs_cosine(point.end, step.direction);
    vertex.pdf_fwd = step.pdf_of_point(cosine, distance_squared) * event.probability();
    const float cosine_before = abs_cosine(previous.end, step.direction);
    previous.area_per_solid_angle =
        previous.kind == VertexKind::infinite
            ? event.transmission.p_unscattered
            : cosine_before / distance_squared * pdf_of_end(previous, event.transmission);
}

/// Constant parameters of a walk.
struct Walk {
    TransportMode mode;
    SampleUse use;
    WalkLimits limits;
    std::uint64_t& rays;  ///< counts the rays of this walk

    [[nodiscard]] bool from_camera() const { return mode == TransportMode::radiance; }
};

/// Returns the interaction at the end of the segment, stored as the next vertex of `path`; null if
/// there is none. `by_lens`: the segment begins at the lens.
const SurfacePoint* shade(const SampleContext& sample, const WalkStep& step,
                          const SegmentSample& event, SegmentKey segment, bool by_lens,
                          Subpath& path)
{
    if (event.is_nothing()) {
        return nullptr;
    }
    return &path.emplace_surface([&] {
        SurfacePoint point = make_interaction(sample, event, *step.origin, step.direction, segment);
        if (by_lens) {
            point.bsdf.see_from_lens();
        }
        return point;
    });
}

/// Continues from the first vertex until the path is full, leaves the scene or is absorbed.
void walk(SampleContext& sample, const Walk& rules, WalkStep step, Subpath& path)
{
    float full = max_component(step.beta);  // reference throughput of Russian roulette
    const bool watches_lens = !rules.from_camera() && sample.camera.has_finite_lens();
    const int max_vertices = rules.limits.max_vertices;
    // A walk with the maximum number of vertices may still cross the lens.
    while (path.size() < max_vertices || (watches_lens && path.size() == max_vertices)) {
        ++rules.rays;
        const SegmentKey segment =
            rules.from_camera() ? sample.segment(0, path.size()) : sample.segment(path.size(), 0);
        // The interaction may lie beyond the last vertex; then it only bounds the search for the
        // lens.
        const SegmentSample event = sample_segment(
            sample, *step.origin, step.direction, segment,
            {.from_camera = rules.from_camera(), .vertices = path.size(), .beta = step.beta});
        const bool by_lens = rules.from_camera() && path.size() == 1;
        const SurfacePoint* hit = shade(sample, step, event, segment, by_lens, path);
        if (watches_lens) {
            look_for_lens(sample, step,
                          hit ? glm::distance(hit->end.p, step.origin->p)
                              : std::numeric_limits<float>::infinity(),
                          segment, path);
        }
        if (path.size() == max_vertices) {
            return;
        }
        if (!hit) {
            if (rules.from_camera()) {
                append_environment(sample.world, step, event, path);
            }
            return;
        }
        const Vec3 along = hit->end.p - step.origin->p;
        const float distance_squared = dot(along, along);
        if (distance_squared < coincident) {
            return;
        }
        append_point(*hit, distance_squared, step, event, path);
        if (path.size() == max_vertices && !watches_lens) {
            return;
        }
        PathVertex& vertex = path.back();
        Sampler& sampler = sample.sampler;
        sampler.start(rules.use, static_cast<std::uint32_t>(path.size()));
        const Vec2 u_direction = sampler.next_2d();
        const float u_lobe = vertex.bsdf->has_one_lobe() ? 0.0f : sampler.next_1d();
        const auto scattered = vertex.bsdf->sample(u_lobe, u_direction, rules.mode);
        const Rgb beta = scattered ? vertex.beta * scattered->weight : Rgb(0.0f);
        if (is_black(beta)) {
            return;
        }
        vertex.scattered_delta = scattered->delta;
        PathVertex& previous = path[path.size() - 2];
        previous.pdf_rev = {scattered->pdf_rev.value * previous.area_per_solid_angle};
        step = {.direction = scattered->wi,
                .beta = beta,
                .pdf = scattered->pdf_fwd,
                .pdf_plane = std::nullopt,
                .origin = &vertex.end};
        // Russian roulette compares with the throughput after the first hit, so that dark surfaces
        // are not starved.
        const bool seen_first = rules.from_camera() && path.size() == 2;
        full = seen_first ? max_component(step.beta) : full;
        if (path.size() > rules.limits.rr_start &&
            !survives(step.beta, full, rules.limits.rr_survival, sampler)) {
            return;
        }
    }
}

}  // namespace

void trace_camera_subpath(SampleContext& sample, Vec2 raster, const WalkLimits& limits,
                          Subpath& path)
{
    path.clear();
    sample.sampler.start(SampleUse::lens);
    const Vec2 u_lens = sample.camera.has_finite_lens() ? sample.sampler.next_2d() : Vec2(0.0f);
    const CameraRay ray = sample.camera.generate_ray(raster, u_lens);
    PathVertex& lens = path.append();
    lens.kind = VertexKind::camera;
    lens.end = ray.lens;
    lens.pdf_fwd = ray.pdf_lens;
    walk(sample,
         {.mode = TransportMode::radiance,
          .use = SampleUse::camera_walk,
          .limits = limits,
          .rays = sample.rays.camera},
         {.direction = ray.direction,
          .beta = Rgb(1.0f),
          .pdf = ray.pdf_direction,
          .pdf_plane = ray.pdf_plane,
          .origin = &lens.end},
         path);
}

void trace_light_subpath(SampleContext& sample, const WalkLimits& limits,
                         NextEventSampling sampling, Subpath& path)
{
    path.clear();
    const World& world = sample.world;
    Sampler& sampler = sample.sampler;
    sampler.start(SampleUse::light_start);
    const Vec2 u_position = sampler.next_2d();
    const auto choice = world.lights().choose_for_emission(
        u_position, [&sampler] { return sampler.next_fine(); }, sampling.learned);
    if (!choice || limits.max_vertices < 1) {
        return;
    }
    const Light& light = world.lights()[choice->id];
    sampler.start(SampleUse::light_start, 1);
    const auto emitted =
        world.lights().sample_emission(*choice, sampler.next_2d(), sampling.learned, sample.time);
    if (!emitted || is_black(emitted->weight)) {
        return;
    }
    const bool infinite = light.is_infinite();
    PathVertex& start = path.append();
    start.kind = infinite ? VertexKind::infinite : VertexKind::light;
    start.end = emitted->end;
    if (infinite) {
        start.end.p = -emitted->direction;
    }
    start.light = choice->id;
    start.barycentrics = emitted->barycentrics;
    start.pdf_fwd = emitted->pdf_position * choice->probability;

    WalkStep step{.direction = emitted->direction,
                  .beta = emitted->weight / choice->probability,
                  .pdf = emitted->pdf_direction,
                  .pdf_plane = std::nullopt,
                  .origin = &emitted->end};
    if (infinite) {
        step.pdf_plane = emitted->pdf_entry;
    }
    walk(sample,
         {.mode = TransportMode::importance,
          .use = SampleUse::light_walk,
          .limits = limits,
          .rays = sample.rays.light},
         step, path);
    if (path.size() > 1) {
        start.pdf_next_event = next_event_density(sample, start, path[1], sampling);
    }
}

}  // namespace bdpt
