#pragma once

#include <bdpt/eval/bench.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/bench_files.h"
#include "bench/progress_meter.h"

namespace bdpt::eval {

/// Greatest fraction of a run's time spent on finding its number of samples.
inline constexpr double calibration_share = 1.0 / 3.0;

/// The data that all runs of a scene in a folder share: options, and the samples of each
/// integrator, which are measured once and then kept.
class Plan {
public:
    /// Takes the key of the reference. Throws `Error`: usage if `files` have another plan, with the
    /// difference; those of read_json().
    Plan(const BenchScene& scene, const BenchOptions& options, const BenchFiles& files,
         const std::string& reference);

    /// Measures what is not known yet, and saves it. Returns false if stopped.
    [[nodiscard]] bool complete(const BenchScene& scene, const BenchOptions& options,
                                BenchProgressMeter& meter, const BenchControl& control);

    /// Returns the goals of a complete plan. Throws `Error` (invalid_input) for invalid numbers.
    [[nodiscard]] BenchGoals goals(IntegratorKind kind) const;

private:
    [[nodiscard]] bool known(IntegratorKind kind) const;
    [[nodiscard]] std::int64_t power_of_two_for_all(const BenchOptions& options) const;
    [[nodiscard]] std::int64_t number(const std::string& member, const std::string& name) const;

    std::filesystem::path file_;
    nlohmann::ordered_json json_;
};

}  // namespace bdpt::eval
