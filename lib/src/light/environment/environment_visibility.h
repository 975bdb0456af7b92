#pragma once

#include "light/environment/environment_tiles.h"

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

    /// Returns factors of the tiles' sampling probabilities at `p`, in [min_factor, 1].
    [[nodiscard]] const TileFactors& at(Vec3 p) const noexcept
    {
        std::uint32_t node = 0;
        while (nodes_[node].axis != leaf) {
            node = nodes_[node].next + (p[nodes_[node].axis] < nodes_[node].split ? 0U : 1U);
        }
        return cells_[nodes_[node].next];
    }
    /// Returns the number of cells that space is divided into.
    [[nodiscard]] std::size_t cells() const noexcept { return cells_.size(); }

    /// Factor of a tile that no ray reached: its light is still sampled, if rarely.
    static constexpr float min_factor = 0.05f;

private:
    static constexpr int leaf = -1;
    struct Node {
        float split = 0.0f;
        int axis = leaf;
        std::uint32_t next = 0;  ///< first of two children; leaf: index of its cell
    };
    /// Probability that each tile is visible from a region of space.
    using Probabilities = std::vector<float>;

    void build(std::uint32_t node, std::vector<Trial>::iterator begin,
               std::vector<Trial>::iterator end, const Probabilities& of_parent, int depth);

    std::vector<Node> nodes_;
    std::vector<TileFactors> cells_;
};

}  // namespace bdpt
