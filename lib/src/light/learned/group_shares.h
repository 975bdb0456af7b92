#pragma once

#include "light/learned/place_tree.h"

#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// Probabilities with which next-event estimation chooses a group of lights (`NextEventLights`), by
/// cells of a kd-tree that a pilot filled: in proportion to the root mean square of the
/// contributions of each group (docs/decisions/0071-learned-groups-of-lights.md). None is zero.
class GroupShares {
public:
    static constexpr std::size_t max_groups = 8;
    /// The probability of each group; they add up to one.
    using Shares = std::array<float, max_groups>;

    /// A light sample of one group.
    struct Finding {
        Vec3 p{0.0f};  ///< position of the receiver in world space
        std::uint32_t group = 0;
        float value = 0.0f;  ///< its contribution, >= 0 and finite
    };

    /// Learns the shares of `groups` groups. The order of `findings` does not matter. If all are
    /// black, all shares are equal.
    GroupShares(std::vector<Finding> findings, std::size_t groups);

    [[nodiscard]] const Shares& at(Vec3 p) const noexcept { return cells_.at(p); }
    /// Number of cells that space is divided into.
    [[nodiscard]] std::size_t cells() const noexcept { return cells_.size(); }

    /// The part of the choice that is uniform, whatever was found.
    static constexpr double even_part = 0.1;

private:
    PlaceTree<Shares> cells_;
};

}  // namespace bdpt
