#pragma once

#include <bdpt/eval/bench/bench.h>
#include <bdpt/eval/bench/reference.h>

#include <filesystem>
#include <optional>
#include <string>

#include "bench/bench_files.h"
#include "bench/progress_meter.h"

namespace bdpt::eval {

/// A reference and what tells it from others.
struct KeyedReference {
    Reference reference;
    std::string key;             ///< of what was asked for, or of the pixels that were given
    std::filesystem::path file;  ///< where it is
};

/// The reference that was given, or that `files` have, or a new one, which is kept there; none if
/// stopped. Throws `Error` like `run_scene`.
[[nodiscard]] std::optional<KeyedReference> reference_for(const BenchScene& scene,
                                                          const BenchOptions& options,
                                                          const BenchFiles& files,
                                                          BenchProgressMeter& meter,
                                                          const BenchControl& control);

/// Where the reference of the options would be kept.
[[nodiscard]] std::string reference_key(const BenchScene& scene, const BenchOptions& options);

}  // namespace bdpt::eval
