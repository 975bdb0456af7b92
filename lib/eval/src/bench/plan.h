#pragma once

#include <bdpt/eval/bench/bench.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/bench_files.h"
#include "bench/progress_meter.h"

namespace bdpt::eval {

/// Of a run's time, what finding out its samples takes at most.
inline constexpr double calibration_share = 1.0 / 3.0;

/// What all runs of a scene in a folder have in common: options, and the samples of each
/// integrator, which are found out once and then kept.
class Plan {
public:
    /// `reference` is its key. Throws `Error`: usage when `files` have another plan, which says
    /// what differs; those of read_json().
    Plan(const BenchScene& scene, const BenchOptions& options, const BenchFiles& files,
         const std::string& reference);

    /// Finds out what is not known yet, and keeps it. False if stopped.
    [[nodiscard]] bool complete(const BenchScene& scene, const BenchOptions& options,
                                BenchProgressMeter& meter, const BenchControl& control);

    /// Of a complete plan. Throws `Error` (invalid_input) for numbers that make no sense.
    [[nodiscard]] BenchGoals goals(IntegratorKind kind) const;

private:
    [[nodiscard]] bool known(IntegratorKind kind) const;
    [[nodiscard]] std::int64_t power_of_two_for_all(const BenchOptions& options) const;
    [[nodiscard]] std::int64_t number(const std::string& member, const std::string& name) const;

    std::filesystem::path file_;
    nlohmann::ordered_json json_;
};

}  // namespace bdpt::eval
