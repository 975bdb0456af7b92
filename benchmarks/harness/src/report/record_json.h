#pragma once

#include <bdpt/harness/bench/summary.h>
#include <bdpt/harness/report/bench_output.h>

#include <nlohmann/json_fwd.hpp>

namespace bdpt::harness {

/// What is the same for all scenes.
[[nodiscard]] nlohmann::ordered_json head_json(const BenchRecord& record);

/// A scene without its runs.
[[nodiscard]] nlohmann::ordered_json scene_json(const SceneResult& scene, double seconds);

}  // namespace bdpt::harness
