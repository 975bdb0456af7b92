#include "verify/render_batch.h"

#include <bdpt/render.h>

#include <algorithm>
#include <cmath>

namespace bdpt::harness {
namespace {

/// Seeds of different integrators are far apart, or they would trace the same camera paths.
std::uint64_t seed_of(const VerifyOptions& options, IntegratorKind integrator)
{
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;
    return options.seed + odd * (1 + static_cast<std::uint64_t>(integrator));
}

RenderOptions render_options(const VerifyOptions& options, IntegratorKind integrator,
                             std::int64_t number)
{
    const std::int64_t samples = integrator == IntegratorKind::bdpt ? bdpt_samples : other_samples;
    RenderOptions result;
    result.integrator = integrator;
    result.sampler = SamplerKind::independent;
    result.width = options.width;
    result.height = options.height;
    result.max_depth = options.max_depth;
    result.samples = {.begin = number * samples, .end = (number + 1) * samples};
    result.threads = 1;
    result.seed = seed_of(options, integrator);
    return result;
}

/// The sum of a tile's pixels in the film's image against what its paths add up to.
double lost(const Image& image, const PixelRect& tile, double sum, double samples)
{
    double pixels = 0.0;
    for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
            const Rgb& c = image.at(x, y);
            pixels +=
                (static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b)) /
                3.0;
        }
    }
    const double difference = std::abs(pixels - sum / samples);
    return difference > 0.0 ? difference / std::max(std::abs(pixels), std::abs(sum / samples))
                            : 0.0;
}

template <typename SumOfTile>
PictureCheck check_picture(const Film& film, const TileGrid& grid, const SumOfTile& sum_of_tile)
{
    PictureCheck check{.defects = film.defects(), .lost = 0.0};
    const Image image = film.develop();
    for (std::size_t tile = 0; tile < grid.size(); ++tile) {
        check.lost = std::max(check.lost, lost(image, grid.tiles()[tile], sum_of_tile(tile),
                                               static_cast<double>(film.sample_count())));
    }
    return check;
}

}  // namespace

Batch render_batch(const Scene& scene, const CameraDesc& camera, const VerifyOptions& options,
                   const TileGrid& grid, std::int64_t number)
{
    const RadianceSums none(grid, options.max_depth);
    Batch batch{.bdpt = PathSums(grid, options.max_depth),
                .others = {none, none, none, none},
                .pictures = {}};
    RenderControl control;
    control.on_path = [&](const FoundPath& path) { batch.bdpt.add(path); };
    const RenderResult bdpt =
        render(scene, camera, render_options(options, IntegratorKind::bdpt, number), control);
    batch.pictures[0] = check_picture(bdpt.film, grid, [&](std::size_t tile) {
        double sum = 0.0;
        for (int edges = 1; edges <= options.max_depth; ++edges) {
            sum += batch.bdpt.length(tile, edges).radiance;
        }
        return sum;
    });
    for (std::size_t i = 0; i < other_integrators.size(); ++i) {
        RadianceSums& sums = batch.others[i];
        control.on_path = [&](const FoundPath& path) { sums.add(path); };
        const RenderResult other =
            render(scene, camera, render_options(options, other_integrators[i], number), control);
        batch.pictures[i + 1] =
            check_picture(other.film, grid, [&](std::size_t tile) { return sums.at(tile); });
    }
    return batch;
}

}  // namespace bdpt::harness
