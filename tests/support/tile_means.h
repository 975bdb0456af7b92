#pragma once

#include "refinement.h"
#include "statistics.h"

#include <bdpt/render.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace bdpt::test {

/// Tile means of a renderer, from independent batches: averages of the three channels over a grid
/// of tiles that covers a film of `side` x `side` pixels. A batch is one independent sample per
/// pixel; or, with the Sobol sampler, whose samples of one pixel are correlated, eight samples with
/// a seed of their own.
class TileMeans {
public:
    static constexpr int grid = 2;
    static constexpr int side = 32;
    static constexpr std::size_t cells = grid * grid;
    static_assert(cells == compared_cells);

    /// Renders nothing yet. `sampler` replaces that of `options`. Seeds are less than 2^32.
    TileMeans(const Scene& scene, const CameraDesc& camera, RenderOptions options,
              SamplerKind sampler = SamplerKind::independent);

    /// Renders until each cell has this number of batches.
    void refine_to(const std::array<int, cells>& batches);
    void refine_to(int batches);
    [[nodiscard]] const std::array<Moments, cells>& cell_moments() const { return moments_; }
    /// Returns the number of batches of the cell that has the fewest.
    [[nodiscard]] int batches() const;
    /// Returns the evidence of at least two batches. Variances are relative to the squares of
    /// `means`, and 0 where those are not above 0.
    [[nodiscard]] BatchEvidence evidence(const std::array<double, cells>& means) const;

private:
    [[nodiscard]] RenderOptions options_of_batch(int batch) const;
    /// Adds one batch to the cell or, if batches cover all cells, to all.
    void add_batch(std::size_t cell);

    const Scene& scene_;
    CameraDesc camera_;
    RenderOptions options_;
    std::array<Moments, cells> moments_;
    std::uint64_t rays_ = 0;
};

}  // namespace bdpt::test
