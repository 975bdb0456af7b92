#pragma once

#include "light/light_tree.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bdpt {

/// Splits lights from the top by the surface area orientation heuristic over bins of their centres
/// [Conty Estevez and Kulla 2018, sec. 4.4]. A light is a leaf.
class LightTreeBuilder {
public:
    explicit LightTreeBuilder(std::span<const LightBounds> lights);

    std::vector<LightTreeNode> nodes;
    std::vector<std::uint64_t> trails;

private:
    /// Where the walk down is.
    struct Place {
        std::uint32_t node = 0;
        std::uint32_t depth = 0;
        std::uint64_t trail = 0;
    };

    void build(std::span<std::uint32_t> ids, Place place);
    /// How many of `ids`, which are put in order for that, belong to the first child.
    [[nodiscard]] std::size_t split(std::span<std::uint32_t> ids, const LightBounds& whole);

    std::span<const LightBounds> lights_;
    double inverse_total_ = 1.0;
};

}  // namespace bdpt
