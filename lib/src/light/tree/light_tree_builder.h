#pragma once

#include "light/tree/light_tree.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace bdpt {

/// Builds the tree top-down by the surface area orientation heuristic over bins of light centres
/// [Conty Estevez and Kulla 2018, sec. 4.4]. The groups of a node are split, the most costly first,
/// until it has the maximum number of children.
class LightTreeBuilder {
public:
    explicit LightTreeBuilder(std::span<const LightBounds> lights);

    /// Moves the tree out; may be called once.
    [[nodiscard]] LightTree take() { return std::move(tree_); }

private:
    struct Group {
        std::span<std::uint32_t> ids;
        LightBounds bounds;
        double cost = 0.0;
    };

    [[nodiscard]] Group make_group(std::span<std::uint32_t> ids) const;
    void build(std::span<std::uint32_t> ids, std::uint32_t parent_slot, int depth);
    /// Partitions `ids` and returns the size of the first part.
    [[nodiscard]] std::size_t split(std::span<std::uint32_t> ids, const LightBounds& whole) const;
    void put(const Group& group, std::size_t slot);

    std::span<const LightBounds> lights_;
    double inverse_total_ = 1.0;
    LightTree tree_;
};

}  // namespace bdpt
