#pragma once

/// @file
/// Compares ways to render a scene at equal CPU time.
///
/// @code{.cpp}
/// void compare(const bdpt::eval::BenchScene& scene, const bdpt::eval::Reference& reference)
/// {
///     const std::vector<bdpt::eval::Variant> variants = {
///         {"mis", {.integrator = bdpt::IntegratorKind::mis}},
///         {"bdpt", {.integrator = bdpt::IntegratorKind::bdpt}}};
///     const auto scores = bdpt::eval::compare_at_equal_time(scene, reference, variants, {});
///     std::cout << scores[0].error.median << " and " << scores[1].error.median << '\n';
/// }
/// @endcode

#include <bdpt/eval/bench.h>
#include <bdpt/eval/statistics.h>
#include <bdpt/export.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bdpt::eval {

/// One of several ways to render a scene, by the same integrator or by different ones.
struct Variant {
    std::string name;
    RenderOptions options;  ///< size, samples and seed are ignored
};

/// Options of a comparison of variants.
struct EqualTimeOptions {
    double seconds = 2.0;  ///< CPU time of each render [s], if there are no `samples`
    /// Samples per pixel of each render, whatever time they take.
    std::optional<std::int64_t> samples{};
    int rounds = 5;  ///< renders of each variant, each with its own seed
};

/// Result of a variant over all rounds.
struct Score {
    /// relMSE without the reference's noise, by `bench_scale`. Without `samples` it is extrapolated
    /// to exactly `seconds`, as if it were proportional to the inverse of the time.
    Spread error;
    double sample_seconds = 0.0;  ///< median CPU time for one sample of every pixel [s]
    std::int64_t samples = 0;     ///< per pixel in each render
};

/// Renders a reference by bdpt with `samples` samples and the given `options`, whose integrator,
/// size and seed are ignored. Throws like render() and `bench_scale`.
[[nodiscard]] BDPT_EXPORT Reference render_reference(const BenchScene& scene,
                                                     const RenderOptions& options,
                                                     std::int64_t samples);

/// Returns the scores of all variants, in their order. Renders are interleaved (A B C A B C ...),
/// so that a machine that slows down does so for all variants. Throws like render().
[[nodiscard]] BDPT_EXPORT std::vector<Score> compare_at_equal_time(
    const BenchScene& scene, const Reference& reference, std::span<const Variant> variants,
    const EqualTimeOptions& options);

}  // namespace bdpt::eval
