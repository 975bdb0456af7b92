#pragma once

#include <bdpt/pixel_rect.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace bdpt::eval {

/// JSON has no NaN and no infinity: null in their place, and where there is no value.
inline nlohmann::ordered_json number_or_null(std::optional<double> value)
{
    return value && std::isfinite(*value) ? nlohmann::ordered_json(*value)
                                          : nlohmann::ordered_json();
}

/// [x0, y0, x1, y1]
inline nlohmann::ordered_json rect_json(const PixelRect& rect)
{
    return nlohmann::ordered_json::array({rect.x0, rect.y0, rect.x1, rect.y1});
}

}  // namespace bdpt::eval
