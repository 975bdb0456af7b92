#pragma once

#include <bdpt/eval/bench.h>
#include <bdpt/film/film.h>
#include <bdpt/render.h>

#include <cstdint>
#include <optional>

#include "bench/progress_meter.h"

namespace bdpt::eval {

/// Parameters that the renders of a scene share.
struct TrialSetup {
    const BenchScene& scene;
    RenderOptions options;  ///< including integrator, size and seed; samples are ignored
    const BenchControl& control;
};

[[nodiscard]] TrialSetup make_setup(const BenchScene& scene, const RenderOptions& options,
                                    IntegratorKind integrator, std::uint64_t seed,
                                    const BenchControl& control);

/// Seed of references; not used by any run or round.
inline constexpr std::uint64_t reference_seed = 1'000'003;

/// Upper bound of samples: more than anybody has time for.
inline constexpr std::int64_t max_samples = std::int64_t{1} << 20;

/// Returns the even number of samples that take about `seconds` of CPU time, measured by renders
/// that grow until one takes a good part of it. Time for choosing the integrator counts once.
/// Returns none if stopped.
[[nodiscard]] std::optional<std::int64_t> samples_in(const TrialSetup& setup, double seconds);

/// Renders `samples` samples from the first on; returns none if stopped.
[[nodiscard]] std::optional<Film> render_all(const TrialSetup& setup, std::int64_t samples,
                                             const BenchProgressMeter& meter);

/// A run with its image at equal time.
struct Trial {
    BenchRun run;
    Image image;
};

/// Renders a run; returns none if stopped.
[[nodiscard]] std::optional<Trial> make_trial(const TrialSetup& setup, const BenchGoals& goals,
                                              const Reference& reference,
                                              const BenchProgressMeter& meter);

/// Renders `samples` samples from the first on and measures the result; returns none if stopped.
[[nodiscard]] std::optional<Checkpoint> measure_once(const TrialSetup& setup, std::int64_t samples,
                                                     const Reference& reference);

/// Returns the samples at which a run is measured: powers of two and its goals, in order.
[[nodiscard]] std::vector<std::int64_t> checkpoint_samples(const BenchGoals& goals);

}  // namespace bdpt::eval
