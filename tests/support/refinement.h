#pragma once

#include <array>
#include <cstddef>

namespace bdpt::test {

/// Cells of a film whose means are compared.
inline constexpr std::size_t compared_cells = 4;

/// Whether the cells of a renderer can be refined one by one. Where light paths are seen through
/// the lens, each batch is of all cells.
enum class CellBatches { separate, common };

/// What the batches of a renderer have shown so far; by default, of a mean that is known.
struct BatchEvidence {
    std::array<double, compared_cells> variance{};  ///< of a batch, relative to the mean squared
    std::array<int, compared_cells> batches{};      ///< that there are
    double work = 0.0;                              ///< of a batch of all cells, in any unit
    CellBatches cells = CellBatches::separate;
};

/// Batches of each cell that two renderers are to have.
struct BatchPlan {
    std::array<int, compared_cells> a;
    std::array<int, compared_cells> b;
};

/// The least work by which the difference of the means of `a` and `b` has no greater standard error
/// than `error`, relative to the mean, in any of the cells that count. Where one renderer is
/// noisier or cheaper it gets more batches than the other. None has fewer than it has already.
[[nodiscard]] BatchPlan min_work(const BatchEvidence& a, const BatchEvidence& b, double error);

}  // namespace bdpt::test
