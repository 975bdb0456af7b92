#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>

namespace bdpt {

/// Position of a value among evenly spaced nodes: the node before it, and the fraction of the
/// interval.
struct NodePosition {
    std::size_t node;
    float fraction;
};

/// Returns the position of `scaled`, which is 0 at the first node and `nodes - 1` at the last one.
[[nodiscard]] inline NodePosition node_position(float scaled, int nodes)
{
    const int node = std::clamp(static_cast<int>(scaled), 0, nodes - 2);
    return {static_cast<std::size_t>(node), scaled - static_cast<float>(node)};
}

/// Which rows of a table exist. Rows are computed when they are first needed: most materials have
/// one roughness, of two rows, and many are never hit.
template <std::size_t Rows>
class LazyRows {
public:
    /// Calls `make(row)` for the row of the node and for the next one, once for each row, whichever
    /// thread comes first; the others wait.
    template <typename Make>
    void require(std::size_t node, const Make& make) const
    {
        if (!exists_[node].load(std::memory_order_acquire)) [[unlikely]] {
            make_pair(node, make);
        }
    }

private:
    template <typename Make>
    [[gnu::noinline]] void make_pair(std::size_t node, const Make& make) const
    {
        const std::scoped_lock lock(mutex_);
        for (const std::size_t row : {node, node + 1}) {
            if (!is_made_[row]) {
                make(row);
                is_made_[row] = true;
            }
        }
        exists_[node].store(true, std::memory_order_release);
    }

    mutable std::array<std::atomic<bool>, Rows> exists_{};  // the row and the next one
    mutable std::array<bool, Rows> is_made_{};              // guarded by `mutex_`
    mutable std::mutex mutex_;
};

/// Visits the intervals of the cosine-weighted average over the hemisphere of a function that is
/// linear in x = sqrt(cosine) between evenly spaced nodes in x: calls `visit` with the first node
/// of each interval, the interval's weight in the average (2 c dc = 4 x^3 dx), and the fraction of
/// the interval at which the function is evaluated.
template <typename Visit>
void for_each_cosine_interval(int nodes, const Visit& visit)
{
    const float step = 1.0f / static_cast<float>(nodes - 1);
    for (int column = 0; column + 1 < nodes; ++column) {
        const float a = static_cast<float>(column) * step;
        const float b = a + step;
        const float whole = b * b * b * b - a * a * a * a;
        const float right = (0.8f * (b * b * b * b * b - a * a * a * a * a) - a * whole) / step;
        visit(column, whole, right / whole);
    }
}

}  // namespace bdpt
