#include "integrator/bdpt_integrator.h"

#include "camera/camera.h"
#include "math/sampler.h"
#include "path/random_walk.h"
#include "scene/world.h"

#include <algorithm>
#include <cstdint>

namespace bdpt {

BdptIntegrator::BdptIntegrator(const World& world, const Camera& camera,
                               const RenderOptions& options)
    : world_(world), camera_(camera), options_(options), filter_(options.filter)
{}

RenderStats BdptIntegrator::render_tile(const Tile& tile, SampleRange samples, Film& film) const
{
    const int max_vertices = options_.max_depth + 1;
    Scratch scratch{.light_path = Subpath(options_.max_depth),
                    .camera_path = Subpath(max_vertices),
                    .weigher = PathWeigher(world_, options_.heuristic, max_vertices),
                    .stats = {}};
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
        for (int x = tile.x_begin; x < tile.x_end; ++x) {
            for (std::int64_t index = samples.begin; index < samples.end; ++index) {
                Sampler sampler(options_.sampler, options_.seed, x, y, index);
                sampler.start(SampleUse::film);
                const Vec2 raster = filter_.sample_raster(x, y, sampler.next_2d());
                const bool wanted = film.region().contains(x, y);
                // Light paths outside of a crop can splat into it.
                const int camera_vertices = wanted ? max_vertices : 1;
                trace_camera_subpath(world_, camera_, raster, camera_vertices, sampler,
                                     scratch.camera_path);
                scratch.stats.rays.camera += scratch.camera_path.rays();
                const Rgb radiance = estimate(index, sampler, scratch, film);
                if (wanted) {
                    ++scratch.stats.paths.camera;
                    film.add_sample(x, y, index, radiance);
                }
            }
        }
    }
    return scratch.stats;
}

/// Radiance that the camera subpath in `scratch` finds; what belongs to other pixels goes to
/// `film`.
Rgb BdptIntegrator::estimate(std::int64_t sample_index, Sampler& sampler, Scratch& scratch,
                             Film& film) const
{
    Subpath& light_path = scratch.light_path;
    Subpath& camera_path = scratch.camera_path;
    trace_light_subpath(world_, light_path.capacity(), sampler, light_path);
    scratch.stats.rays.light += light_path.rays();
    ++scratch.stats.paths.light;

    for (int s = 2; s <= light_path.size(); ++s) {
        const auto splat = connect_to_lens(world_, camera_, light_path.first(s), camera_path[0],
                                           scratch.weigher, scratch.stats.rays);
        if (splat) {
            sampler.start(SampleUse::film, static_cast<std::uint32_t>(s));
            const SplatTarget target = filter_.choose_pixel(splat->raster, sampler.next_2d());
            const float weight = target.weight * splat->contribution.weight;
            film.add_splat(target.raster, sample_index, weight * splat->contribution.unweighted);
        }
    }
    Rgb radiance(0.0f);
    for (int t = 2; t <= camera_path.size(); ++t) {
        const int longest_s = std::min(std::max(light_path.size(), 1), options_.max_depth + 1 - t);
        for (int s = 0; s <= longest_s; ++s) {
            const auto found = connect(light_path.first(s), camera_path.first(t), sampler, scratch);
            if (found) {
                radiance += found->weight * found->unweighted;
            }
        }
    }
    return radiance;
}

std::optional<Contribution> BdptIntegrator::connect(std::span<const PathVertex> light,
                                                    std::span<const PathVertex> camera,
                                                    Sampler& sampler, Scratch& scratch) const
{
    switch (light.size()) {
        case 0:
            return hit_light(world_, camera, scratch.weigher);
        case 1:
            return connect_to_light(world_, camera, sampler, scratch.weigher, scratch.stats.rays);
        default:
            return connect_interior(world_, light, camera, scratch.weigher, scratch.stats.rays);
    }
}

}  // namespace bdpt
