#pragma once

#include <bdpt/types.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <vector>

namespace bdpt {

/// Space in cells, by a kd-tree over places: small cells where there are many of them.
class PlaceTree {
public:
    /// Divides `items`, which have a place `p` each, at the median of their widest axis, while both
    /// halves keep `least` of them. `estimate(items of a part of space, estimate of the part around
    /// it)` makes estimates, from `outside` on; `add_cell` takes those of cells, in their order.
    /// Depends on the order of items only as far as `estimate` does.
    template <typename Item, typename Estimate, typename MakeEstimate, typename AddCell>
    PlaceTree(std::span<Item> items, std::size_t least, const Estimate& outside,
              const MakeEstimate& estimate, const AddCell& add_cell)
    {
        nodes_.emplace_back();
        divide(0, items, least, outside, estimate, add_cell, 0);
    }

    /// The number of the cell that `p` lies in.
    [[nodiscard]] std::uint32_t cell_at(Vec3 p) const noexcept
    {
        std::uint32_t node = 0;
        while (nodes_[node].axis != leaf) {
            node = nodes_[node].next + (p[nodes_[node].axis] < nodes_[node].split ? 0U : 1U);
        }
        return nodes_[node].next;
    }

private:
    static constexpr int leaf = -1;
    static constexpr int max_depth = 32;
    struct Node {
        float split = 0.0f;
        int axis = leaf;
        std::uint32_t next = 0;  ///< the first of two children; of a leaf: its cell
    };

    template <typename Item, typename Estimate, typename MakeEstimate, typename AddCell>
    void divide(std::uint32_t node, std::span<Item> items, std::size_t least,
                const Estimate& around, const MakeEstimate& estimate, const AddCell& add_cell,
                int depth)
    {
        const Estimate here = estimate(std::span<const Item>(items), around);
        Vec3 lower(std::numeric_limits<float>::infinity());
        Vec3 upper = -lower;
        for (const Item& item : items) {
            lower = min(lower, item.p);
            upper = max(upper, item.p);
        }
        const Vec3 size = upper - lower;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        if (items.size() >= 2 * least && depth < max_depth && size[axis] > 0.0f) {
            const auto middle = items.begin() + std::ssize(items) / 2;
            std::nth_element(
                items.begin(), middle, items.end(),
                [axis](const Item& a, const Item& b) { return a.p[axis] < b.p[axis]; });
            const float split = middle->p[axis];
            const auto second =
                std::partition(items.begin(), items.end(),
                               [axis, split](const Item& item) { return item.p[axis] < split; });
            if (second != items.begin()) {
                const auto child = static_cast<std::uint32_t>(nodes_.size());
                nodes_[node] = {.split = split, .axis = axis, .next = child};
                nodes_.resize(nodes_.size() + 2);
                divide(child, std::span<Item>(items.begin(), second), least, here, estimate,
                       add_cell, depth + 1);
                divide(child + 1, std::span<Item>(second, items.end()), least, here, estimate,
                       add_cell, depth + 1);
                return;
            }
        }
        nodes_[node] = {.split = 0.0f, .axis = leaf, .next = cells_++};
        add_cell(here);
    }

    std::vector<Node> nodes_;
    std::uint32_t cells_ = 0;
};

}  // namespace bdpt
