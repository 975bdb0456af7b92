#pragma once

#include <bdpt/scene.h>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace bdpt {

[[nodiscard]] inline Bounds empty_bounds()
{
    constexpr float infinite = std::numeric_limits<float>::infinity();
    return {.min = Vec3(infinite), .max = Vec3(-infinite)};
}

[[nodiscard]] inline Bounds joined(const Bounds& a, const Bounds& b)
{
    return {.min = min(a.min, b.min), .max = max(a.max, b.max)};
}

[[nodiscard]] inline bool overlap(const Bounds& a, const Bounds& b)
{
    return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

/// Finds boxes that overlap a given one: a complete binary tree over the boxes in Morton order
/// [Karras 2012, "Maximizing parallelism in the construction of BVHs, octrees, and k-d trees",
/// whose order it takes].
class BoxTree {
public:
    BoxTree() = default;
    explicit BoxTree(std::vector<Bounds> boxes) : boxes_(std::move(boxes))
    {
        if (boxes_.empty()) {
            return;
        }
        Bounds all = boxes_.front();
        for (const Bounds& box : boxes_) {
            all = joined(all, box);
        }
        std::vector<Key> keys(boxes_.size());
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const Vec3 center = 0.5f * boxes_[i].min + 0.5f * boxes_[i].max;
            keys[i] = {morton_code(center, all), static_cast<std::uint32_t>(i)};
        }
        tbb::parallel_sort(keys.begin(), keys.end());
        order_.reserve(keys.size());
        for (const Key& key : keys) {
            order_.push_back(key.index);
        }
        while (leaves_ * leaf_size < boxes_.size()) {
            leaves_ *= 2;
        }
        nodes_.assign(2 * leaves_, empty_bounds());
        for (std::size_t i = 0; i < order_.size(); ++i) {
            Bounds& leaf = nodes_[leaves_ + i / leaf_size];
            leaf = joined(leaf, boxes_[order_[i]]);
        }
        for (std::size_t node = leaves_ - 1; node > 0; --node) {
            nodes_[node] = joined(nodes_[2 * node], nodes_[2 * node + 1]);
        }
    }

    [[nodiscard]] const std::vector<Bounds>& boxes() const { return boxes_; }

    /// Calls `visit` with the index of each box that overlaps `box`, in a fixed order, until it
    /// returns false.
    template <typename Visit>
    void find(const Bounds& box, const Visit& visit) const
    {
        std::array<std::size_t, 64> open;  // the depth of the tree bounds their number
        std::size_t count = 0;
        if (!nodes_.empty()) {
            open[count++] = 1;
        }
        while (count > 0) {
            const std::size_t node = open[--count];
            if (!overlap(nodes_[node], box)) {
                continue;
            }
            if (node < leaves_) {
                open[count++] = 2 * node + 1;
                open[count++] = 2 * node;
                continue;
            }
            const std::size_t begin = (node - leaves_) * leaf_size;
            const std::size_t end = std::min(begin + leaf_size, order_.size());
            for (std::size_t i = begin; i < end; ++i) {
                if (overlap(boxes_[order_[i]], box) && !visit(order_[i])) {
                    return;
                }
            }
        }
    }

private:
    struct Key {
        std::uint32_t code;
        std::uint32_t index;
        friend auto operator<=>(const Key&, const Key&) = default;
    };
    static constexpr std::size_t leaf_size = 4;

    [[nodiscard]] static std::uint32_t morton_code(Vec3 p, const Bounds& all)
    {
        constexpr float steps = 1023.0f;
        std::uint32_t code = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float extent = all.max[axis] - all.min[axis];
            const float place = extent > 0.0f ? (p[axis] - all.min[axis]) / extent : 0.0f;
            const auto step = static_cast<std::uint32_t>(std::clamp(place, 0.0f, 1.0f) * steps);
            for (unsigned bit = 0; bit < 10; ++bit) {
                code |= (step >> bit & 1U) << (3 * bit + static_cast<unsigned>(axis));
            }
        }
        return code;
    }

    std::vector<Bounds> boxes_;
    std::vector<std::uint32_t> order_;
    std::size_t leaves_ = 1;
    std::vector<Bounds> nodes_;  // node n has the children 2 n and 2 n + 1; the root is 1
};

}  // namespace bdpt
