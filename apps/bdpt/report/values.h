#pragma once

#include <bdpt/types.h>
#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

namespace bdpt::app {

[[nodiscard]] inline double degrees(float radians)
{
    return static_cast<double>(radians) * 180.0 / std::numbers::pi;
}

/// Formats "1,2,3" with four digits each.
[[nodiscard]] inline std::string to_text(Vec3 v)
{
    return fmt::format("{:.4g},{:.4g},{:.4g}", v.x, v.y, v.z);
}

[[nodiscard]] inline nlohmann::ordered_json to_json(Vec3 v)
{
    return nlohmann::ordered_json::array({v.x, v.y, v.z});
}

}  // namespace bdpt::app
