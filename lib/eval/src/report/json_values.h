#pragma once

#include <bdpt/pixel_rect.h>

#include <cmath>
#include <nlohmann/json.hpp>
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

}  // namespace bdpt::eval
