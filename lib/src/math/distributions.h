#pragma once

#include "math/low_level.h"

#include <bdpt/types.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bdpt {

/// Combines two random floats of 24 bits to one number in [0, 1) of 48 bits: for choices among so
/// many items that 24 bits would be too coarse.
[[nodiscard]] inline double fine_uniform(Vec2 u)
{
    return static_cast<double>(u.x) + static_cast<double>(u.y) * 0x1p-24;
}

/// Draws an index in proportion to its weight in constant time [Walker 1974; Vose 1991, "A Linear
/// Algorithm for Generating Random Numbers with a Given Distribution"].
class AliasTable {
public:
    struct Choice {
        std::uint32_t index;
        float probability;  ///< of this index; 0 only for an empty table
        float u_remapped;   ///< uniform in [0, 1), independent of the index
    };

    AliasTable() = default;
    /// Builds the table. Weights that are negative or not finite count as zero, and so do those
    /// whose probability would not be a normal float. If no weight is left the table is empty.
    explicit AliasTable(std::span<const float> weights);

    [[nodiscard]] bool empty() const noexcept { return buckets_.empty(); }
    [[nodiscard]] std::size_t size() const noexcept { return buckets_.size(); }
    /// Returns the sum of the weights.
    [[nodiscard]] double total() const noexcept { return total_; }

    /// Draws an index by `u` in [0, 1). A float has 24 bits, enough for some thousand items; use
    /// `fine_uniform` for more. Never draws an index of zero weight. An empty table gives index 0
    /// of probability 0.
    [[nodiscard]] Choice sample(double u) const noexcept;
    /// Draws an index of a small table that is not empty, for which a float has enough digits.
    [[nodiscard, gnu::always_inline]] inline Choice sample_coarse(float u) const noexcept
    {
        constexpr float below_one = 1.0f - 0x1p-24f;
        const float scaled = u * static_cast<float>(buckets_.size());
        const auto last = static_cast<std::int32_t>(buckets_.size()) - 1;
        const std::int32_t slot = std::min(static_cast<std::int32_t>(scaled), last);
        const Bucket& bucket = buckets_[static_cast<std::size_t>(slot)];
        const float within = scaled - static_cast<float>(slot);
        // The branch would be random, so this must not be one.
        const bool own = within < bucket.threshold;
        const std::uint32_t index = own ? static_cast<std::uint32_t>(slot) : bucket.alias;
        const float start = select(own, 0.0f, bucket.threshold);
        const float size = select(own, bucket.threshold, 1.0f - bucket.threshold);
        return {index, buckets_[index].probability, std::min((within - start) / size, below_one)};
    }
    /// Returns the probability of `index`, which is less than size().
    [[nodiscard]] float probability(std::size_t index) const noexcept
    {
        return buckets_[index].probability;
    }

private:
    struct Bucket {
        float threshold;      ///< part of the bucket that belongs to its own index
        std::uint32_t alias;  ///< index that owns the rest
        float probability;
    };

    std::vector<Bucket> buckets_;
    double total_ = 0.0;
};

/// A density on the unit square that is constant in each cell of a grid. Sampling inverts the
/// cumulative sums, so it preserves the stratification of its random numbers.
class Distribution2D {
public:
    struct Sample {
        Vec2 point{0.0f};
        float pdf = 0.0f;
    };

    /// A cell, and a point in it.
    struct Cell {
        int column = 0;
        int row = 0;
        Vec2 offset{0.0f};  ///< position relative to the cell's corner, in [0, 1)^2 of its size
        float pdf = 0.0f;
    };

    /// `weights` are width * height values >= 0, row-major; all zero gives the uniform density.
    Distribution2D(std::span<const float> weights, int width, int height);

    [[nodiscard]] Sample sample(Vec2 u) const;
    [[nodiscard]] float pdf(Vec2 point) const;
    /// Samples a cell, and evaluates the density by cell, independent of rounding.
    [[nodiscard]] Cell sample_cell(Vec2 u) const;
    [[nodiscard]] float cell_pdf(int x, int y) const;

private:
    int width_;
    int height_;
    std::vector<float> row_cdf_;   // height + 1
    std::vector<float> cell_cdf_;  // for each row width + 1
};

}  // namespace bdpt
