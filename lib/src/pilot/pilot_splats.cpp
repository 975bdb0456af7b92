#include "pilot/pilot_splats.h"

#include <functional>

namespace bdpt {

void PilotSplats::trace(Integrator& integrator, std::int64_t part, std::int64_t index,
                        const PilotGrid& grid, Heuristic heuristic, double light_paths)
{
    const std::function<void(const PathContribution&)> observer =
        [&](const PathContribution& path) {
            contributions_.push_back({.cell = grid.cell_at(path.raster),
                                      .shares = PathShares(path, heuristic, light_paths)});
        };
    StrategyFilm no_strategies(PixelRect{}, {});
    const Films films{.film = nullptr, .strategies = no_strategies, .on_path = observer};
    stats_ += integrator.render_chunk(part, {.begin = index, .end = index + 1}, films);
}

}  // namespace bdpt
