#pragma once

#include "light/environment/environment_tiles.h"
#include "light/learned/place_tree.h"

#include <bdpt/types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// Visibility of each tile of an environment from a place, by cells of a kd-tree that a pilot
/// filled (docs/decisions/0068-learned-visibility.md). It guides next-event estimation and cannot
/// bias it: no factor is zero.
class EnvironmentVisibility {
public:
    /// A visibility ray towards an environment.
    struct Trial {
        Vec3 p{0.0f};  ///< origin in world space
        std::uint32_t tile = 0;
        bool visible = false;  ///< true if it hit nothing
    };

    /// Builds the tree from `trials`, whose order does not matter. Without any, everything is
    /// visible.
    explicit EnvironmentVisibility(std::vector<Trial> trials);

    /// Factors of the tiles' shares of the samples at `p`, in [min_factor, 1].
    [[nodiscard]] const TileFactors& at(Vec3 p) const noexcept { return cells_.at(p); }
    /// Number of cells that space is divided into.
    [[nodiscard]] std::size_t cells() const noexcept { return cells_.size(); }

    /// Factor of a tile that no ray reached: its light is still sampled, if rarely.
    static constexpr float min_factor = 0.05f;

private:
    PlaceTree<TileFactors> cells_;
};

}  // namespace bdpt
