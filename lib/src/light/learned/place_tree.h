#pragma once

#include "threads/threads.h"

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
template <typename Cell>
class PlaceTree {
public:
    /// Divides `items`, which have a place `p` each, at the median of their widest axis, while both
    /// halves keep `least` of them. `estimate(items of a part of space, estimate of the part around
    /// it)` makes estimates, from `outside` on; `make_cell` turns that of a cell into the cell.
    /// Several threads call both. Depends on the order of items only as far as `estimate` does.
    template <typename Item, typename Estimate, typename MakeEstimate, typename MakeCell>
    PlaceTree(std::span<Item> items, std::size_t least, const Estimate& outside,
              const MakeEstimate& estimate, const MakeCell& make_cell)
    {
        const auto divide = [&](const auto& self, Part& part, std::span<Item> some,
                                const Estimate& around, int depth) -> void {
            const Estimate here = estimate(std::span<const Item>(some), around);
            const auto node = part.nodes.size();
            part.nodes.emplace_back();
            if (some.size() >= 2 * least && depth < max_depth) {
                if (const Halves halves = halve(some); halves.first > 0) {
                    Part second;
                    run_both(
                        [&] { self(self, part, some.first(halves.first), here, depth + 1); },
                        [&] { self(self, second, some.subspan(halves.first), here, depth + 1); });
                    part.nodes[node] = {
                        .split = halves.split,
                        .axis = halves.axis,
                        .next = static_cast<std::uint32_t>(part.nodes.size() - node)};
                    part.append(second);
                    return;
                }
            }
            part.nodes[node].next = static_cast<std::uint32_t>(part.cells.size());
            part.cells.push_back(make_cell(here));
        };
        divide(divide, all_, items, outside, 0);
    }

    /// The cell that `p` lies in.
    [[nodiscard]] const Cell& at(Vec3 p) const noexcept
    {
        std::size_t node = 0;
        while (all_.nodes[node].axis != leaf) {
            const Node& inner = all_.nodes[node];
            node += p[inner.axis] < inner.split ? 1U : inner.next;
        }
        return all_.cells[all_.nodes[node].next];
    }

    [[nodiscard]] std::size_t size() const noexcept { return all_.cells.size(); }

private:
    static constexpr int leaf = -1;
    static constexpr int max_depth = 32;

    struct Node {
        float split = 0.0f;
        int axis = leaf;
        /// How far behind this node its second child is; the first follows it. Of a leaf: its cell.
        std::uint32_t next = 0;
    };

    /// The nodes and cells of a part of space.
    struct Part {
        std::vector<Node> nodes;
        std::vector<Cell> cells;

        void append(const Part& more)
        {
            for (Node node : more.nodes) {
                node.next += node.axis == leaf ? static_cast<std::uint32_t>(cells.size()) : 0U;
                nodes.push_back(node);
            }
            cells.insert(cells.end(), more.cells.begin(), more.cells.end());
        }
    };

    struct Halves {
        std::size_t first = 0;  ///< number of items below `split`; 0: cannot be divided
        float split = 0.0f;
        int axis = 0;
    };

    /// Moves the items below the median of their widest axis to the front.
    template <typename Item>
    static Halves halve(std::span<Item> items)
    {
        Vec3 lower(std::numeric_limits<float>::infinity());
        Vec3 upper = -lower;
        for (const Item& item : items) {
            lower = min(lower, item.p);
            upper = max(upper, item.p);
        }
        const Vec3 size = upper - lower;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        if (!(size[axis] > 0.0f)) {
            return {};
        }
        const auto middle = items.begin() + std::ssize(items) / 2;
        std::nth_element(items.begin(), middle, items.end(),
                         [axis](const Item& a, const Item& b) { return a.p[axis] < b.p[axis]; });
        const float split = middle->p[axis];
        const auto second =
            std::partition(items.begin(), items.end(),
                           [axis, split](const Item& item) { return item.p[axis] < split; });
        return {.first = static_cast<std::size_t>(second - items.begin()),
                .split = split,
                .axis = axis};
    }

    Part all_;
};

}  // namespace bdpt
