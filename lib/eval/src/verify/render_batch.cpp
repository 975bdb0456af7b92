#include "verify/evidence.h"

#include "verify/samples.h"

#include <bdpt/render.h>

#include <algorithm>
#include <cmath>

namespace bdpt::eval {
namespace {

/// Returns a seed per integrator and batch, as otherwise all would trace the same camera paths.
std::uint64_t derive_seed(const VerifyOptions& options, IntegratorKind integrator,
                          std::int64_t number)
{
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;  // spreads consecutive numbers
    constexpr std::uint64_t integrators = 8;
    return options.seed + odd * (integrators * static_cast<std::uint64_t>(number) +
                                 static_cast<std::uint64_t>(integrator) + 1);
}

/// Returns options for paths of `shortest` to `longest` edges.
RenderOptions render_options(const VerifyOptions& options, IntegratorKind integrator,
                             std::int64_t number, int shortest, int longest)
{
    RenderOptions result;
    result.integrator = integrator;
    result.film.width = options.width;
    result.film.height = options.height;
    result.transport.min_depth = shortest;
    result.transport.max_depth = longest;
    result.transport.rr_start = Roulette::start;
    result.transport.rr_survival = Roulette(options.max_depth).min_survival();
    // Sobol points of one sequence are correlated; those of different seeds are not.
    result.sampling.planned_samples = 0;
    result.sampling.samples = {.begin = 0, .end = count_samples(integrator, shortest)};
    if (integrator != IntegratorKind::lt && integrator != IntegratorKind::pt) {
        result.sampling.light_samples = options.light_samples;
    }
    if (integrator == IntegratorKind::bdpt || integrator == IntegratorKind::vcm) {
        result.bidirectional.light_paths = options.light_paths;
        result.bidirectional.connections = options.connections;
        result.bidirectional.connection_rays = options.connection_rays;
        result.bidirectional.merge_radius = options.merge_radius.value_or(0.0);
    }
    result.system.threads = 1;
    result.sampling.seed =
        derive_seed(options, integrator, number) + static_cast<std::uint64_t>(shortest);
    return result;
}

/// Returns the sum over the tile's pixels of the mean channel.
double sum_of_pixels(const Image& image, const PixelRect& tile)
{
    double sum = 0.0;
    for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
            const Rgb& c = image.at(x, y);
            sum +=
                (static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b)) /
                3.0;
        }
    }
    return sum;
}

/// Returns the difference of the sum of a tile's pixels in the film's image from the sum of its
/// paths.
double lost(const Image& image, const PixelRect& tile, double sum, double samples)
{
    const double pixels = sum_of_pixels(image, tile);
    const double difference = std::abs(pixels - sum / samples);
    return difference > 0.0 ? difference / std::max(std::abs(pixels), std::abs(sum / samples))
                            : 0.0;
}

template <typename SumOfTile>
ImageCheck check_image(const Film& film, const TileGrid& grid, const SumOfTile& sum_of_tile)
{
    ImageCheck check{.defects = film.defects(), .lost = 0.0};
    const Image image = film.develop();
    for (std::size_t tile = 0; tile < grid.size(); ++tile) {
        check.lost = std::max(check.lost, lost(image, grid.tiles()[tile], sum_of_tile(tile),
                                               static_cast<double>(film.sample_count())));
    }
    return check;
}

/// Returns the sums of one batch by one measure, still empty.
Batch empty_batch(const VerifyOptions& options, const TileGrid& grid, Measure measure)
{
    Batch batch{.bdpt = PathSums(grid, options.max_depth,
                                 {options.light_paths, options.light_samples}, measure),
                .others = std::vector<RadianceSums>(count_of_others(options),
                                                    RadianceSums(grid, options.max_depth, measure)),
                .images = {}};
    if (options.merge_radius) {
        batch.merges.emplace(options.max_depth, measure);
    }
    return batch;
}

/// Calls `visit` for the sums of all measures.
template <typename Visit>
void for_each_measure(Batch& batch, const Visit& visit)
{
    visit(batch);
    for (Batch& channel : batch.channels) {
        visit(channel);
    }
}

/// Renders paths by merging and all other techniques, weighted so that `MergeSums` knows how often
/// merging finds them.
void render_merges(const Scene& scene, const CameraDesc& camera, const VerifyOptions& options,
                   std::int64_t number, Batch& batch)
{
    // Makes numbers distinct from those of the image of vcm.
    constexpr std::uint64_t other_numbers = 0x6d65726765;
    RenderOptions balanced =
        render_options(options, IntegratorKind::vcm, number, 1, options.max_depth);
    balanced.transport.heuristic = Heuristic::balance;
    balanced.sampling.seed += other_numbers;
    RenderControl to_sums;
    to_sums.on_path = [&](const PathContribution& path) {
        for_each_measure(batch, [&](Batch& sums) { sums.merges->add(path); });
    };
    static_cast<void>(render(scene, camera, balanced, to_sums));
}

}  // namespace

Batch render_batch(const Scene& scene, const CameraDesc& camera, const VerifyOptions& options,
                   const TileGrid& grid, std::int64_t number)
{
    Batch batch = empty_batch(options, grid, Measure::mean);
    const TileGrid whole(options.width, options.height, 1);
    for (const Measure channel : channel_measures) {
        batch.channels.push_back(empty_batch(options, whole, channel));
    }
    const int longest = options.max_depth;
    RenderControl to_bdpt;
    to_bdpt.on_path = [&](const PathContribution& path) {
        for_each_measure(batch, [&](Batch& sums) { sums.bdpt.add(path); });
    };
    const RenderResult bdpt = render(
        scene, camera, render_options(options, IntegratorKind::bdpt, number, 1, longest), to_bdpt);
    batch.images[0] = check_image(bdpt.film, grid, [&](std::size_t tile) {
        double sum = 0.0;
        for (int edges = 1; edges <= longest; ++edges) {
            sum += batch.bdpt.length(tile, edges).all.radiance;
        }
        return sum;
    });
    for (std::size_t i = 0; i < batch.others.size(); ++i) {
        const IntegratorKind kind = other_integrators[i];
        RenderControl to_sums;
        to_sums.on_path = [&](const PathContribution& path) {
            for_each_measure(batch, [&](Batch& sums) { sums.others[i].add(path); });
        };
        // Path lengths with the same number of samples are rendered together.
        int shortest = 1;
        while (shortest <= longest) {
            int last = shortest;
            while (last < longest &&
                   count_samples(kind, last + 1) == count_samples(kind, shortest)) {
                ++last;
            }
            const RenderResult other = render(
                scene, camera, render_options(options, kind, number, shortest, last), to_sums);
            batch.images[i + 1] += check_image(other.film, grid, [&](std::size_t tile) {
                return batch.others[i].between(tile, shortest, last);
            });
            shortest = last + 1;
        }
    }
    if (options.merge_radius) {
        render_merges(scene, camera, options, number, batch);
    }
    return batch;
}

}  // namespace bdpt::eval
