#pragma once

#include <bdpt/eval/bench/bench.h>
#include <bdpt/eval/bench/bench_run.h>
#include <bdpt/eval/bench/reference.h>
#include <bdpt/film/film.h>
#include <bdpt/render.h>

#include <cstdint>
#include <optional>

#include "bench/progress_meter.h"

namespace bdpt::eval {

/// What renders of a scene have in common.
struct TrialSetup {
    const BenchScene& scene;
    RenderOptions options;  ///< with integrator, size and seed; samples do not count
    const BenchControl& control;
};

[[nodiscard]] TrialSetup make_setup(const BenchScene& scene, const RenderOptions& options,
                                    IntegratorKind integrator, std::uint64_t seed,
                                    const BenchControl& control);

/// Seed of references; no run and no round has it.
inline constexpr std::uint64_t reference_seed = 1'000'003;

/// Renders that samples are taken to be endless for: more than anybody has time for.
inline constexpr std::int64_t max_samples = std::int64_t{1} << 20;

/// How many samples, an even number, take about `seconds` of CPU time: from renders that grow until
/// one takes a good part of it. What a choice of the integrator takes counts once. None if stopped.
[[nodiscard]] std::optional<std::int64_t> samples_in(const TrialSetup& setup, double seconds);

/// A render of `samples` samples from the first on; none if stopped.
[[nodiscard]] std::optional<Film> render_all(const TrialSetup& setup, std::int64_t samples,
                                             const BenchProgressMeter& meter);

/// A run with its image at equal time.
struct Trial {
    BenchRun run;
    Image image;
};

/// Makes it; none if stopped.
[[nodiscard]] std::optional<Trial> make_trial(const TrialSetup& setup, const BenchGoals& goals,
                                              const Reference& reference,
                                              const BenchProgressMeter& meter);

/// A render of `samples` samples from the first on, looked at at its end; none if stopped.
[[nodiscard]] std::optional<Checkpoint> measure_once(const TrialSetup& setup, std::int64_t samples,
                                                     const Reference& reference);

/// Where a run is looked at: at powers of two and at its goals, in order.
[[nodiscard]] std::vector<std::int64_t> checkpoint_samples(const BenchGoals& goals);

}  // namespace bdpt::eval
