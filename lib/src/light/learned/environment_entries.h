#pragma once

#include "light/bounding_sphere.h"
#include "light/environment/environment_tiles.h"
#include "light/learned/entry_window.h"

#include <cstddef>
#include <vector>

namespace bdpt {

/// The directions and places from which an environment's light enters the scene on its way to what
/// the camera sees, as a pilot learned them by tiles of the environment
/// (docs/decisions/0073-learned-entries.md). Light paths start there; no density is zero.
class EnvironmentEntries {
public:
    EnvironmentEntries(std::vector<Escape> escapes, const EnvironmentTiles& tiles,
                       const BoundingSphere& bounds);

    /// Returns the factors of the tiles' weights, in [min_factor, 1].
    [[nodiscard]] const TileFactors& factors() const noexcept { return factors_; }
    /// Returns the weights of the tiles.
    [[nodiscard]] const EnvironmentTiles::Worth& worth() const noexcept { return worth_; }
    /// Returns where light of a tile enters the scene.
    [[nodiscard]] const EntryWindow& window(std::size_t tile) const noexcept
    {
        return windows_[tile];
    }

    /// Factor of a tile that no camera path reached.
    static constexpr float min_factor = 0.05f;

private:
    TileFactors factors_;
    EnvironmentTiles::Worth worth_;
    std::vector<EntryWindow> windows_;  // per tile
};

}  // namespace bdpt
