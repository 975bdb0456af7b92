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

#include <bdpt/eval/bench/bench_scene.h>
#include <bdpt/eval/bench/reference.h>
#include <bdpt/eval/statistics/spread.h>
#include <bdpt/export.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bdpt::eval {

/// One of several ways to render a scene, of the same integrator or of different ones.
struct Variant {
    std::string name;
    RenderOptions options;  ///< size, samples and seed do not count
};

/// How variants are held against each other.
struct EqualTimeOptions {
    double seconds = 2.0;  ///< CPU time of each render [s], if there are no `samples`
    /// Of each render, per pixel, however long that takes.
    std::optional<std::int64_t> samples{};
    int rounds = 5;  ///< renders of each variant, with a seed of its own each
};

/// How a variant did, over the rounds.
struct Score {
    /// relMSE without the reference's noise, by `bench_scale`; without `samples` that after exactly
    /// `seconds`, as if it fell with the inverse of the time from where it was measured.
    Spread error;
    double sample_seconds = 0.0;  ///< CPU time for one sample of every pixel; median [s]
    std::int64_t samples = 0;     ///< per pixel in each render
};

/// A reference by bdpt with `samples` samples, as `options` say but for integrator, size and seed,
/// which no contest has. Throws like render() and `bench_scale`.
[[nodiscard]] BDPT_EXPORT Reference render_reference(const BenchScene& scene,
                                                     const RenderOptions& options,
                                                     std::int64_t samples);

/// The scores of all variants, in their order. The variants take turns, A B C A B C ..., so that a
/// machine that gets slower or busier does so for all. Throws like render().
[[nodiscard]] BDPT_EXPORT std::vector<Score> compare_at_equal_time(
    const BenchScene& scene, const Reference& reference, std::span<const Variant> variants,
    const EqualTimeOptions& options);

}  // namespace bdpt::eval
