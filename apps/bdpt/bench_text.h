#pragma once

#include <bdpt/harness/bench/bench.h>

#include <string>

namespace bdpt::app {

/// What came of a scene, as a table for people. `seconds` is the CPU time of runs at equal time.
[[nodiscard]] std::string bench_text(const harness::SceneResult& scene, double seconds);

}  // namespace bdpt::app
