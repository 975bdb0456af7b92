#pragma once

#include <bdpt/eval/bench/bench.h>

#include <string>

namespace bdpt::app {

/// Returns the results of a scene as a table for people. `seconds` is the CPU time of runs at equal
/// time.
[[nodiscard]] std::string bench_text(const eval::SceneResult& scene, double seconds);

}  // namespace bdpt::app
