#pragma once

#include <bdpt/eval/bench/summary.h>
#include <bdpt/eval/report/bench_output.h>

#include <nlohmann/json_fwd.hpp>

namespace bdpt::eval {

/// What is the same for all scenes.
[[nodiscard]] nlohmann::ordered_json head_json(const BenchRecord& record);

/// A scene without its runs.
[[nodiscard]] nlohmann::ordered_json scene_json(const SceneResult& scene, double seconds);

}  // namespace bdpt::eval
