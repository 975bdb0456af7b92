#include "light/learned/environment_entries.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace bdpt {
namespace {

/// Returns the mean of the last vertices: planes through it are near the openings of a room.
Vec3 center_of(std::span<const Escape> escapes, const BoundingSphere& bounds)
{
    glm::dvec3 sum(0.0);
    double throughput = 0.0;
    for (const Escape& escape : escapes) {
        sum += static_cast<double>(escape.throughput) * glm::dvec3(escape.p);
        throughput += static_cast<double>(escape.throughput);
    }
    return throughput > 0.0 ? Vec3(sum / throughput) : bounds.center;
}

}  // namespace

EnvironmentEntries::EnvironmentEntries(std::vector<Escape> escapes, const EnvironmentTiles& tiles,
                                       const BoundingSphere& bounds)
    : windows_(EnvironmentTiles::tile_count, EntryWindow(bounds))
{
    const Vec3 center = center_of(escapes, bounds);
    std::stable_sort(escapes.begin(), escapes.end(),
                     [](const Escape& a, const Escape& b) { return a.tile < b.tile; });
    std::vector<double> importance(windows_.size(), 0.0);
    for (auto begin = escapes.begin(); begin != escapes.end();) {
        const std::size_t tile = begin->tile;
        const auto end =
            std::find_if(begin, escapes.end(), [tile](const Escape& e) { return e.tile != tile; });
        windows_[tile] = EntryWindow(std::span(begin, end), center, bounds);
        // Per solid angle, as the weights of tiles are integrals over it.
        importance[tile] = windows_[tile].root_of_throughput() / std::sqrt(tiles.solid_angle(tile));
        begin = end;
    }
    const double most = *std::max_element(importance.begin(), importance.end());
    for (std::size_t tile = 0; tile < windows_.size(); ++tile) {
        const double factor = most > 0.0 ? importance[tile] / most : 1.0;
        factors_.of[tile] = std::max(min_factor, static_cast<float>(factor));
    }
    worth_ = tiles.worth(factors_, EnvironmentSampling::plain);
}

}  // namespace bdpt
