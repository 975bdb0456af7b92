#pragma once

#include <bdpt/eval/bench_report.h>
#include <bdpt/pixel_rect.h>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include <cmath>
#include <optional>

namespace bdpt::eval {

/// Returns a number as JSON; null for NaN, infinity (which JSON does not have) and none.
inline nlohmann::ordered_json number_or_null(std::optional<double> value)
{
    return value && std::isfinite(*value) ? nlohmann::ordered_json(*value)
                                          : nlohmann::ordered_json();
}

/// Returns [x0, y0, x1, y1].
inline nlohmann::ordered_json rect_json(const PixelRect& rect)
{
    return nlohmann::ordered_json::array({rect.x0, rect.y0, rect.x1, rect.y1});
}

/// Returns the part of the report that is common to all scenes.
[[nodiscard]] nlohmann::ordered_json head_json(const BenchRecord& record);

/// Returns a scene without its runs.
[[nodiscard]] nlohmann::ordered_json scene_json(const SceneResult& scene, double seconds);

}  // namespace bdpt::eval
