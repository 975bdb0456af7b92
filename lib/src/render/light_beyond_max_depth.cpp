#include <bdpt/render.h>

#include "geometry/flush_denormals.h"
#include "integrator/bidirectional/bidirectional_integrator.h"
#include "math/rgb.h"
#include "pilot/pilot_contributions.h"
#include "render/check_options.h"
#include "render/view.h"
#include "threads/threads.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace bdpt {
namespace {

constexpr int default_depth = TransportOptions{}.max_depth;
/// Limit from which longer paths are considered intentional [edges].
constexpr int max_path_length = 512;
constexpr int samples_of_cell = 2;

/// Sums of luminance by path length.
struct LightByLength {
    double within = 0.0;  ///< within the limit
    double beyond = 0.0;

    LightByLength& operator+=(const LightByLength& other)
    {
        within += other.within;
        beyond += other.beyond;
        return *this;
    }
    [[nodiscard]] double share_beyond() const
    {
        return beyond > 0.0 ? beyond / (within + beyond) : 0.0;
    }
};

/// Returns the options of a render whose paths continue where those of `asked` end. Excludes
/// directly visible light.
RenderOptions with_longer_paths(const RenderOptions& asked)
{
    constexpr std::uint64_t seed = 0x6c656e677468;  // a seed that users will hardly choose
    constexpr int factor = 4;                       // ratio of the longer limit to the requested
                                                    // one
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    options.film.width = asked.film.width;
    options.film.height = asked.film.height;
    options.sampling.sampler = SamplerKind::independent;
    options.sampling.seed = seed;
    options.transport.background = asked.transport.background;
    options.transport.min_depth = 2;
    options.transport.max_depth =
        std::clamp(factor * asked.transport.max_depth, default_depth, max_path_length);
    return options;
}

/// Returns the light that `integrator` finds in one pixel of each cell of a row.
LightByLength light_of_row(const Integrator& integrator, const PilotGrid& grid, int row, int limit)
{
    LightByLength sum;
    const std::function<void(const PathContribution&)> observer =
        [&sum, limit](const PathContribution& path) {
            const int edges = path.strategy.s + path.strategy.t - 1;
            const auto light = static_cast<double>(path.weight * luminance(path.unweighted));
            if (std::isfinite(light)) {
                (edges > limit ? sum.beyond : sum.within) += light;
            }
        };
    StrategyFilm no_strategies(PixelRect{}, {});
    const Films films{.film = nullptr, .strategies = no_strategies, .on_path = observer};
    for (int column = 0; column < grid.columns(); ++column) {
        static_cast<void>(integrator.render_tile(grid.pixel(column, row),
                                                 {.begin = 0, .end = samples_of_cell}, films));
    }
    return sum;
}

/// Returns the fraction in the sum of `rows` beyond the limit, or 0 if it is below twice its
/// standard error, estimated by the jackknife over groups.
double share_beyond(const std::vector<LightByLength>& rows)
{
    constexpr std::size_t max_groups = 16;
    const std::size_t groups = std::min(max_groups, rows.size());
    std::array<LightByLength, max_groups> without{};
    LightByLength all;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        all += rows[row];
        for (std::size_t group = 0; group < groups; ++group) {
            if (row % groups != group) {
                without.at(group) += rows[row];
            }
        }
    }
    const double share = all.share_beyond();
    double squares = 0.0;
    for (std::size_t group = 0; group < groups; ++group) {
        const double change = without.at(group).share_beyond() - share;
        squares += change * change;
    }
    const auto n = static_cast<double>(groups);
    return share > 2.0 * std::sqrt((n - 1.0) / n * squares) ? share : 0.0;
}

}  // namespace

double light_beyond_max_depth(const Scene& scene, const CameraDesc& camera,
                              const RenderOptions& asked)
{
    check_options(asked);
    check_camera(camera);
    check_camera_distance(camera, scene.world().farthest_origin());
    const int limit = asked.transport.max_depth;
    if (limit >= max_path_length ||
        (limit >= default_depth && !scene.world().media().any_scatters())) {
        return 0.0;
    }
    const RenderOptions options = with_longer_paths(asked);
    const MovingCamera opened = open_camera(scene.world(), camera, options);
    const PilotGrid grid(options.film.width, options.film.height);
    std::vector<LightByLength> rows(static_cast<std::size_t>(grid.rows()));
    Threads threads(asked.system.threads);
    threads.execute([&] {
        const BidirectionalIntegrator integrator(scene.world(), opened, options);
        tbb::parallel_for(0, grid.rows(), [&](int row) {
            const FlushDenormals flush;
            rows[static_cast<std::size_t>(row)] = light_of_row(integrator, grid, row, limit);
        });
    });
    return share_beyond(rows);
}

}  // namespace bdpt
