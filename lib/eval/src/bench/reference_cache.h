#pragma once

#include <bdpt/eval/bench.h>

#include <filesystem>
#include <optional>
#include <string>

#include "bench/bench_files.h"
#include "bench/progress_meter.h"

namespace bdpt::eval {

/// A reference and its key.
struct KeyedReference {
    Reference reference;
    std::string key;  ///< hash of the options it was requested with, or of the given pixels
    std::filesystem::path file;  ///< path of the image
};

/// Returns the given reference, or the one in `files`, or a new one, which is kept there; none if
/// stopped. Throws `Error` like `run_scene`.
[[nodiscard]] std::optional<KeyedReference> reference_for(const BenchScene& scene,
                                                          const BenchOptions& options,
                                                          const BenchFiles& files,
                                                          BenchProgressMeter& meter,
                                                          const BenchControl& control);

/// Returns the key under which the reference of the options is kept.
[[nodiscard]] std::string reference_key(const BenchScene& scene, const BenchOptions& options);

}  // namespace bdpt::eval
