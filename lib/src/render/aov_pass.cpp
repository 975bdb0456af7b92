#include "render/aov_pass.h"

#include "camera/camera.h"
#include "integrator/sample_schedule.h"
#include "math/frame.h"
#include "math/rgb.h"
#include "math/sampler.h"
#include "path/segment_sample.h"
#include "scene/world.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace bdpt {

SceneOutline::SceneOutline(const MovingCamera& camera, const Bounds& bounds)
{
    if (camera.moves() || camera.first().has_finite_lens()) {
        return;
    }
    const PixelCone& cone = camera.first().pixel_cone();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    RasterBounds outline{.min = Vec2(infinity), .max = Vec2(-infinity)};
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 sides((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
        const Vec3 p = bounds.min + sides * (bounds.max - bounds.min);
        const auto raster = camera.first().project(p);
        if (!raster || !std::isfinite(raster->x + raster->y)) {
            return;
        }
        // Rounding errors of rays and projections [pixels]: small but for telephoto lenses, and
        // where the film is seen at a slant.
        const float way = glm::length(p - cone.eye);
        const float reach = glm::length(cone.eye) + way;
        const float slant = camera.first().is_perspective() ? way / camera.first().depth(p) : 1.0f;
        const float rounding = 0.25f + 0x1p-20f * slant * slant * reach / cone.width_at(p);
        outline.min = min(outline.min, *raster - rounding);
        outline.max = max(outline.max, *raster + rounding);
    }
    outline_ = outline;
}

bool SceneOutline::is_beside(const RasterBounds& area) const noexcept
{
    return outline_ && (area.max.x < outline_->min.x || area.min.x > outline_->max.x ||
                        area.max.y < outline_->min.y || area.min.y > outline_->max.y);
}

AovPass::AovPass(const World& world, const MovingCamera& camera, const RenderOptions& options)
    : world_(world),
      camera_(camera),
      options_(options),
      filter_(options.film.filter),
      needs_surfaces_(asks_for_surfaces(options.film.aovs)),
      outline_(camera, world.bounds()),
      ground_(world, options)
{
    options_.sampling.rates.reset();  // first surfaces have one sample a round in all pixels
    if (asks_for_ids(options.film.aovs)) {
        names_.emplace(world.description());
    }
}

IdNames AovPass::names() const
{
    return names_ ? names_->names(options_.film.aovs) : IdNames{};
}

RenderStats AovPass::render_tile(const Tile& tile, SampleRange samples, AovFilm& film,
                                 IdFilm& ids) const
{
    RenderStats stats;
    std::vector<SurfaceIds> met;  // ids hit by the rays of a pixel
    met.reserve(names_ ? static_cast<std::size_t>(samples.end - samples.begin) : 0);
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
        for (int x = tile.x_begin; x < tile.x_end; ++x) {
            if (!film.region().contains(x, y)) {
                continue;
            }
            const Vec2 center = Vec2(x, y) + 0.5f;
            const RasterBounds footprint{center - filter_.radius(), center + filter_.radius()};
            if (outline_.is_beside(footprint)) {
                if (!film.needs_ground()) {
                    continue;
                }
                if (const auto ground = ground_in(footprint)) {
                    add_ground(x, y, samples, *ground, film, stats.rays);
                    continue;
                }
            }
            met.clear();
            for (std::int64_t index = samples.begin; index < samples.end; ++index) {
                add_sample(x, y, index, film, met, stats.rays);
            }
            ids.add(x, y, met);
        }
    }
    return stats;
}

std::optional<GroundShadow::Part> AovPass::ground_in(const RasterBounds& footprint) const
{
    const auto& [min, max] = footprint;
    const auto ray = [this](float x, float y) {
        return camera_.first().generate_ray({x, y}, Vec2(0.0f));
    };
    return ground_.part_between(
        {ray(min.x, min.y), ray(max.x, min.y), ray(min.x, max.y), ray(max.x, max.y)});
}

void AovPass::add_ground(int x, int y, SampleRange samples, const GroundShadow::Part& ground,
                         AovFilm& film, RayCounts& rays) const
{
    std::vector<SurfaceIds> none;
    std::int64_t open = 0;
    for (std::int64_t index = samples.begin; index < samples.end; ++index) {
        const Sampler sampler(options_.sampling.sampler, options_.sampling.seed, x, y, index,
                              log_samples(options_.sampling, x, y));
        if (ground_.may_sample(ground, sampler)) {
            add_sample(x, y, index, film, none, rays);
        } else {
            ++open;
        }
    }
    film.add_open_ground(x, y, ground.irradiance, open);
}

void AovPass::add_sample(int x, int y, std::int64_t sample_index, AovFilm& film,
                         std::vector<SurfaceIds>& met, RayCounts& rays) const
{
    // These are the random numbers of the integrators' camera rays.
    SampleStart start(options_, filter_, world_, camera_, x, y, sample_index);
    const TimedCamera timed(camera_, start.moment.time);
    const Camera& camera = timed.get();
    start.sampler.start(SampleUse::lens);
    const Vec2 u_lens = camera.has_finite_lens() ? start.sampler.next_2d() : Vec2(0.0f);
    const CameraRay ray = camera.generate_ray(start.raster, u_lens);
    SegmentKey segment = start.sampler.segment_key(0, 1);
    segment.wavelength = start.moment.wavelength;
    segment.time = start.moment.time;
    bool is_opaque = false;
    if (const auto hit = hit_of(ray, segment, start.sampler, rays)) {
        if (needs_surfaces_ || film.needs_opacity()) {
            const SurfacePoint point =
                world_.surface_at(*hit, ray.direction, segment, camera.pixel_cone());
            is_opaque = point.opacity >= 1.0f;
            const Vec3 normal = point.bsdf.shading_normal();
            PrimaryHit first;
            first[Aov::albedo] = point.bsdf.base_color();
            first[Aov::normal] = dot(normal, ray.direction) > 0.0f ? -normal : normal;
            first[Aov::camera_normal] = camera.to_local(first[Aov::normal]);
            first[Aov::position] = Vec3(DVec3(point.end.p) + world_.description().origin);
            first[Aov::depth].x = camera.depth(point.end.p);
            first[Aov::distance].x = glm::distance(ray.lens.p, point.end.p);
            if (options_.film.aovs.contains(Aov::uv)) {
                first[Aov::uv] = Vec3(world_.uv_at(*hit), 0.0f);
            }
            film.add(x, y, first);
        } else {
            film.add(x, y, {});
        }
        if (names_) {
            met.push_back(names_->surface_ids(*hit));
        }
    } else if (film.needs_ground()) {
        if (const auto light = ground_.light_at(ray, start.moment, start.sampler, rays)) {
            film.add_ground(x, y, *light);
        }
    }
    if (film.needs_opacity()) {
        film.add_opacity(x, y, is_opaque ? 1.0f : opacity_along(ray, segment, rays));
    }
}

std::optional<RayHit> AovPass::hit_of(const CameraRay& ray, SegmentKey segment, Sampler& sampler,
                                      RayCounts& rays) const
{
    ++rays.aov;
    if (!world_.has_passable_surfaces()) {
        return world_.first_hit(ray.lens, ray.direction, segment);
    }
    bool is_tinted = false;
    const auto hit = first_camera_hit(world_, sampler, ray.lens, ray.direction, segment, is_tinted);
    if (hit || !is_tinted) {
        return hit;
    }
    constexpr float infinite = std::numeric_limits<float>::infinity();
    ++rays.aov;
    const float passes = luminance(world_.tint(ray.lens, ray.direction, infinite, segment));
    if (sampler.next_1d() < passes) {
        return hit;
    }
    ++rays.aov;
    return world_.first_hit(ray.lens, ray.direction, segment.without_chance());
}

float AovPass::opacity_along(const CameraRay& ray, SegmentKey segment, RayCounts& rays) const
{
    constexpr int max_surfaces = 64;
    constexpr float nothing = 1e-4f;
    const SegmentKey key = segment.without_chance();
    SegmentEnd from = ray.lens;
    float transmittance = 1.0f;
    for (int i = 0; i < max_surfaces; ++i) {
        ++rays.aov;
        const auto hit = world_.first_hit(from, ray.direction, key);
        if (!hit) {
            return 1.0f - transmittance;
        }
        const SurfacePoint point = world_.surface_at(*hit, ray.direction, key, PixelCone{});
        transmittance *= 1.0f - point.opacity;
        if (transmittance < nothing) {
            break;
        }
        from = point.end;
    }
    return 1.0f;
}

}  // namespace bdpt
