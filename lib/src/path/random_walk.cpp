#include "path/random_walk.h"

#include "camera/camera.h"
#include "math/rgb.h"
#include "math/sampler.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace bdpt {
namespace {

/// |cos| at a vertex; 1 where there is no surface to be foreshortened.
float abs_cosine(Vec3 ng, Vec3 w)
{
    return ng == Vec3(0.0f) ? 1.0f : std::abs(dot(ng, w));
}

/// The state of a walk that is about to look for its next vertex.
struct Step {
    Vec3 direction{0.0f};
    Rgb beta{1.0f};
    SolidAnglePdf pdf;
    /// Set for the first step from a light at infinity, which has no density of directions.
    std::optional<PlanarPdf> pdf_plane;
    SegmentEnd origin;  ///< where the ray starts: the last vertex, or the edge of the scene
};

/// Camera walks end on the environment, which light walks cannot see.
void append_environment(const World& world, const Step& step, Subpath& path)
{
    const auto id = world.lights().environment();
    if (!id) {
        return;
    }
    const auto& light = std::get<EnvironmentLight>(world.lights()[*id].model());
    PathVertex& vertex = path.append();
    vertex.kind = VertexKind::infinite;
    vertex.light = id;
    vertex.end.p = step.direction;
    vertex.wo = -step.direction;
    vertex.beta = step.beta * medium_transmittance(step.origin, {}, step.direction,
                                                   std::numeric_limits<float>::max());
    vertex.emission = light.radiance(step.direction);
    vertex.pdf_fwd = {step.pdf.value};
}

void append_surface(const SurfacePoint& point, float distance_squared, const Step& step,
                    Subpath& path)
{
    PathVertex& previous = path[path.size() - 1];
    PathVertex& vertex = path.append();
    vertex.end = point.end;
    vertex.wo = -step.direction;
    vertex.beta = step.beta * medium_transmittance(step.origin, point.end, step.direction,
                                                   std::sqrt(distance_squared));
    vertex.emission = point.emission;
    vertex.light = point.light;
    vertex.barycentrics = point.barycentrics;
    vertex.bsdf = point.bsdf;
    vertex.connectible = point.bsdf.connectible();
    const float cosine = std::abs(dot(point.end.ng, step.direction));
    vertex.pdf_fwd = step.pdf_plane ? to_area(*step.pdf_plane, cosine)
                                    : to_area(step.pdf, cosine, distance_squared);
    if (previous.kind != VertexKind::infinite) {
        previous.area_per_solid_angle =
            abs_cosine(previous.end.ng, step.direction) / distance_squared;
    }
}

/// Goes on from the first vertex until the path is full, leaves the scene or is absorbed.
void walk(const World& world, Step step, TransportMode mode, SampleUse use, int max_vertices,
          Sampler& sampler, Subpath& path)
{
    while (path.size() < max_vertices) {
        path.count_ray();
        const auto hit = world.intersect(step.origin, step.direction);
        if (!hit) {
            if (mode == TransportMode::radiance) {
                append_environment(world, step, path);
            }
            return;
        }
        const Vec3 along = hit->end.p - step.origin.p;
        const float distance_squared = dot(along, along);
        if (distance_squared < coincident) {
            return;
        }
        append_surface(*hit, distance_squared, step, path);
        if (path.size() == max_vertices) {
            return;
        }
        PathVertex& vertex = path[path.size() - 1];
        sampler.start(use, static_cast<std::uint32_t>(path.size()));
        const Vec2 u_direction = sampler.next_2d();
        const auto scattered = vertex.bsdf.sample(vertex.wo, sampler.next_1d(), u_direction, mode);
        if (!scattered || is_black(scattered->weight)) {
            return;
        }
        vertex.scattered_delta = scattered->delta;
        PathVertex& previous = path[path.size() - 2];
        previous.pdf_rev = {scattered->pdf_rev.value * previous.area_per_solid_angle};
        step = {.direction = scattered->wi,
                .beta = vertex.beta * scattered->weight,
                .pdf = scattered->pdf_fwd,
                .pdf_plane = std::nullopt,
                .origin = vertex.end};
    }
}

}  // namespace

void trace_camera_subpath(const World& world, const Camera& camera, Vec2 raster, int max_vertices,
                          Sampler& sampler, Subpath& path)
{
    path.clear();
    const CameraRay ray = camera.generate_ray(raster);
    PathVertex& lens = path.append();
    lens.kind = VertexKind::camera;
    lens.end.p = ray.ray.origin;
    lens.pdf_fwd = {1.0f};  // the Dirac factor of the pinhole is left out
    walk(world,
         {.direction = ray.ray.direction,
          .beta = Rgb(1.0f),
          .pdf = ray.pdf_direction,
          .pdf_plane = std::nullopt,
          .origin = lens.end},
         TransportMode::radiance, SampleUse::camera_walk, max_vertices, sampler, path);
}

void trace_light_subpath(const World& world, int max_vertices, Sampler& sampler, Subpath& path)
{
    path.clear();
    sampler.start(SampleUse::light_start);
    const Vec2 u_position = sampler.next_2d();
    const auto choice = world.lights().choose_for_emission(sampler.next_fine());
    if (!choice || max_vertices < 1) {
        return;
    }
    const Light& light = world.lights()[choice->id];
    const auto emitted = light.sample_emission(u_position, sampler.next_2d());
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

    Step step{.direction = emitted->direction,
              .beta = emitted->weight / choice->probability,
              .pdf = emitted->pdf_direction,
              .pdf_plane = std::nullopt,
              .origin = emitted->end};
    if (infinite) {
        step.pdf_plane = world.bounding_sphere().pdf_disk();
    }
    walk(world, step, TransportMode::importance, SampleUse::light_walk, max_vertices, sampler,
         path);
}

}  // namespace bdpt
