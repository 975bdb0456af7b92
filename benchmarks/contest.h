#pragma once

#include <bdpt/render.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "subject.h"

namespace CLI {
class App;
}

namespace bdpt {

/// One of the ways to render that are compared.
struct Variant {
    std::string name;
    RenderOptions options;  ///< samples and seed do not count
};

/// How variants of a render are compared.
struct Contest {
    double seconds = 2.0;  ///< CPU time of each render
    int rounds = 5;        ///< renders of each variant, with a seed of its own each
};

/// Adds --time and --rounds.
void add_options(CLI::App& app, Contest& contest);

/// How a variant did: medians over the rounds.
struct Score {
    double error = 0.0;           ///< relMSE after exactly the contest's seconds
    double least_error = 0.0;     ///< the same in the best round
    double greatest_error = 0.0;  ///< the same in the worst
    double sample_seconds = 0.0;  ///< CPU time for one sample of every pixel [s]
    std::int64_t samples = 0;     ///< per pixel in each render

    /// relMSE of a single sample, if it falls with the inverse of their number.
    [[nodiscard]] double sample_error(const Contest& contest) const
    {
        return error * contest.seconds / sample_seconds;
    }
};

/// Renders all variants in turn, each with as many samples as take `contest.seconds` of CPU time;
/// what is left of a difference in time is made up for, as if errors fell with its inverse.
[[nodiscard]] std::vector<Score> compete(const Subject& subject, const Reference& reference,
                                         std::span<const Variant> variants, const Contest& contest);

/// The same with `samples` samples of all pixels, however long that takes; `error` is what it is.
[[nodiscard]] std::vector<Score> compete_at_equal_samples(const Subject& subject,
                                                          const Reference& reference,
                                                          std::span<const Variant> variants,
                                                          std::int64_t samples, int rounds);

}  // namespace bdpt
