#pragma once

#include <array>
#include <cstddef>

namespace bdpt::test {

/// Number of cells of a film whose means are compared.
inline constexpr std::size_t compared_cells = 4;

/// Tells whether the cells of a renderer can be refined one by one. With light paths seen through
/// the lens, each batch covers all cells.
enum class CellBatches { separate, common };

/// Statistics of a renderer's batches so far; by default, those of a known mean.
struct BatchEvidence {
    /// Variance of one batch, relative to the squared mean.
    std::array<double, compared_cells> variance{};
    std::array<int, compared_cells> batches{};  ///< number of batches so far
    double work = 0.0;                          ///< work of a batch of all cells, in any unit
    CellBatches cells = CellBatches::separate;
};

/// Planned batches of each cell of two renderers.
struct BatchPlan {
    std::array<int, compared_cells> a;
    std::array<int, compared_cells> b;
};

/// Returns the plan with the least work by which the difference of the means of `a` and `b` has a
/// standard error of at most `error`, relative to the mean, in all cells that count. A noisier or
/// cheaper renderer gets more batches than the other. None gets fewer than it has already.
[[nodiscard]] BatchPlan min_work(const BatchEvidence& a, const BatchEvidence& b, double error);

}  // namespace bdpt::test
