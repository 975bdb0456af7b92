#include "render/aov_pass.h"

#include "camera/moving_camera.h"
#include "integrator/sample_start.h"
#include "math/sampler.h"
#include "scene/world.h"

#include <glm/geometric.hpp>

namespace bdpt {

AovPass::AovPass(const World& world, const MovingCamera& camera, const RenderOptions& options)
    : world_(world), camera_(camera), options_(options), filter_(options.filter)
{}

RenderStats AovPass::render_tile(const Tile& tile, SampleRange samples, AovFilm& film) const
{
    RenderStats stats;
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
        for (int x = tile.x_begin; x < tile.x_end; ++x) {
            if (!film.region().contains(x, y)) {
                continue;
            }
            for (std::int64_t index = samples.begin; index < samples.end; ++index) {
                ++stats.rays.aov;
                if (const auto hit = first_hit(x, y, index)) {
                    film.add(x, y, *hit);
                }
            }
        }
    }
    return stats;
}

std::optional<PrimaryHit> AovPass::first_hit(int x, int y, std::int64_t sample_index) const
{
    // The random numbers of the integrators' camera rays.
    Sampler sampler(options_.sampler, options_.seed, x, y, sample_index);
    const Vec2 raster = start_sample(sampler, filter_, world_, camera_, x, y);
    const TimedCamera timed(camera_, sampler.time());
    const Camera& camera = timed.get();
    sampler.start(SampleUse::lens);
    const Vec2 u_lens = camera.has_finite_lens() ? sampler.next_2d() : Vec2(0.0f);
    const CameraRay ray = camera.generate_ray(raster, u_lens);
    NoProbe probe;
    const auto point = world_.intersect(ray.lens, ray.direction, sampler.segment_key(0, 1),
                                        camera.pixel_cone(), probe);
    if (!point) {
        return std::nullopt;
    }
    const Vec3 normal = point->bsdf.shading_normal();
    return PrimaryHit{.albedo = point->bsdf.base_color(),
                      .normal = dot(normal, ray.direction) > 0.0f ? -normal : normal,
                      .position = point->end.p,
                      .depth = camera.depth(point->end.p)};
}

}  // namespace bdpt
