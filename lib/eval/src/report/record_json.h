#pragma once

#include <bdpt/eval/bench_report.h>

#include <nlohmann/json_fwd.hpp>

namespace bdpt::eval {

/// Returns the part of the report that is common to all scenes.
[[nodiscard]] nlohmann::ordered_json head_json(const BenchRecord& record);

/// Returns a scene without its runs.
[[nodiscard]] nlohmann::ordered_json scene_json(const SceneResult& scene, double seconds);

}  // namespace bdpt::eval
