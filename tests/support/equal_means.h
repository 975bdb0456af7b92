#pragma once

#include "tile_means.h"

#include <string>

namespace bdpt::test {

/// Confidence and sharpness of a comparison of means.
struct Sharpness {
    /// Probability that equal means are called different, over all tiles together.
    double false_alarm = 1e-4;
    /// The smallest relative bias of a tile that must be found with a probability of 90 %. A
    /// comparison that is too noisy for that fails.
    double detectable_bias = 0.025;
    /// Maximum number of batches of each renderer.
    int max_batches = 16384;
};

/// Result of a comparison, with all data for the message of a failing test.
struct MeanComparison {
    bool equal = false;
    bool sharp_enough = false;
    double worst_bias = 0.0;  ///< relative difference of the tile with the greatest z
    double worst_z = 0.0;     ///< in standard errors
    double critical_z = 0.0;  ///< greatest over the tiles that are not black
    double found_bias = 0.0;  ///< greatest relative difference of tiles that are not equal
    double max_bias = 0.0;    ///< greatest relative difference of all tiles
    double detectable_bias =
        0.0;  ///< detectable bias of the noisiest tile that is not black; at least 1 if all are
    int batches = 0;  ///< minimum over tiles and renderers

    [[nodiscard]] std::string text() const;
};

/// Compares two renderers' tile means by Welch's t-test with a Sidak correction. Both are refined,
/// each where that helps most for its work, until the comparison is sharp enough. Their seeds must
/// differ.
[[nodiscard]] MeanComparison compare_means(TileMeans& a, TileMeans& b,
                                           const Sharpness& sharpness = {});

/// Compares tile means with a known mean, equal in all tiles.
[[nodiscard]] MeanComparison compare_means(TileMeans& a, double expected,
                                           const Sharpness& sharpness = {});

}  // namespace bdpt::test
