#pragma once

#include "light/tree/light_tree.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace bdpt {

/// Splits lights from the top by the surface area orientation heuristic over bins of their centres
/// [Conty Estevez and Kulla 2018, sec. 4.4]. A node's groups are split, the most costly first,
/// until it has as many children as it may.
class LightTreeBuilder {
public:
    explicit LightTreeBuilder(std::span<const LightBounds> lights);

    /// The tree; once.
    [[nodiscard]] LightTree take() { return std::move(tree_); }

private:
    struct Group {
        std::span<std::uint32_t> ids;
        LightBounds bounds;
        double cost = 0.0;
    };

    [[nodiscard]] Group group_of(std::span<std::uint32_t> ids) const;
    void build(std::span<std::uint32_t> ids, std::uint32_t parent_slot, int depth);
    /// Puts `ids` in order, and tells how many of them are the first part.
    [[nodiscard]] std::size_t split(std::span<std::uint32_t> ids, const LightBounds& whole) const;
    void put(const Group& group, std::size_t slot);

    std::span<const LightBounds> lights_;
    double inverse_total_ = 1.0;
    LightTree tree_;
};

}  // namespace bdpt
