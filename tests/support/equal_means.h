#pragma once

#include "tile_means.h"

#include <string>

namespace bdpt::test {

/// How sure and how sharp a comparison of means must be.
struct Sharpness {
    /// Chance that equal means are called different, over all tiles together.
    double false_alarm = 1e-4;
    /// The smallest relative bias of a tile that must be found with 90 % chance. A comparison that
    /// is too noisy for that fails.
    double detectable_bias = 0.025;
    /// Batches that each renders at most to get there.
    int max_batches = 16384;
};

/// Outcome of a comparison: all that a failing test has to say.
struct MeanComparison {
    bool equal = false;
    bool sharp_enough = false;
    double worst_bias = 0.0;  ///< relative difference of the tile with the greatest z
    double worst_z = 0.0;     ///< in standard errors
    double critical_z = 0.0;  ///< the greatest of a tile that is not black
    double found_bias = 0.0;  ///< greatest relative difference of tiles that are not equal
    double max_bias = 0.0;    ///< ... of all tiles
    double detectable_bias =
        0.0;          ///< of the noisiest tile that is not black; 1 at least if all are
    int batches = 0;  ///< the fewest of a tile and a renderer

    [[nodiscard]] std::string text() const;
};

/// Welch's t-test of two renderers' tile means with a Sidak correction. Both are refined, each
/// where that helps most for its work, until the comparison is sharp enough. The seeds of the two
/// must differ.
[[nodiscard]] MeanComparison compare_means(TileMeans& a, TileMeans& b,
                                           const Sharpness& sharpness = {});

/// The same against a known mean, equal in all tiles.
[[nodiscard]] MeanComparison compare_means(TileMeans& a, double expected,
                                           const Sharpness& sharpness = {});

}  // namespace bdpt::test
