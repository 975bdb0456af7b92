#pragma once

#include "statistics.h"

#include <bdpt/render.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace bdpt::test {

/// How sure and how sharp a comparison of means must be.
struct Sharpness {
    /// Chance that equal means are called different, over all tiles together.
    double false_alarm = 1e-4;
    /// The smallest relative bias of a tile that must be found with 90 % chance. A comparison that
    /// is too noisy for that fails.
    double detectable_bias = 0.025;
    /// Batches that are rendered at most to get there.
    int max_batches = 16384;
};

/// Outcome of a comparison: all that a failing test has to say.
struct MeanComparison {
    bool equal = false;
    bool sharp_enough = false;
    double worst_bias = 0.0;  ///< relative difference of the tile with the greatest z
    double worst_z = 0.0;     ///< in standard errors
    double critical_z = 0.0;
    double found_bias = 0.0;       ///< greatest relative difference of tiles that are not equal
    double greatest_bias = 0.0;    ///< ... of all tiles
    double detectable_bias = 0.0;  ///< of the noisiest tile that is not black; 1 at least if all are
    int batches = 0;

    [[nodiscard]] std::string text() const;
};

/// Tile means of a renderer, from independent batches: averages of the three channels over a grid
/// of tiles that covers a film of `side` x `side` pixels. A batch is one independent sample a
/// pixel; or, with the Sobol sampler, whose samples of one pixel depend on each other, eight with a
/// seed of their own.
class TileMeans {
public:
    static constexpr int grid = 2;
    static constexpr int side = 32;
    static constexpr std::size_t cells = grid * grid;

    /// `sampler` takes the place of that in `options`. Seeds are less than 2^32.
    TileMeans(const Scene& scene, const CameraDesc& camera, RenderOptions options,
              SamplerKind sampler = SamplerKind::independent);

    /// Renders `batches` more batches.
    void refine(int batches);
    [[nodiscard]] const std::array<Moments, cells>& cell_moments() const { return moments_; }
    [[nodiscard]] int batches() const { return batches_; }

private:
    [[nodiscard]] RenderOptions options_of_batch(int batch) const;

    const Scene& scene_;
    CameraDesc camera_;
    RenderOptions options_;
    std::array<Moments, cells> moments_;
    int batches_ = 0;
};

/// Welch's t-test of two renderers' tile means with a Sidak correction. Both are refined until the
/// comparison is sharp enough. The seeds of the two must differ.
[[nodiscard]] MeanComparison compare_means(TileMeans& a, TileMeans& b,
                                           const Sharpness& sharpness = {});

/// The same against a known mean, equal in all tiles.
[[nodiscard]] MeanComparison compare_means(TileMeans& a, double expected,
                                           const Sharpness& sharpness = {});

}  // namespace bdpt::test
