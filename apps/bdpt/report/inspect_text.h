#pragma once

#include <bdpt/inspect.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bdpt::app {

/// Tables of the vertices and of what strategies bring, for people.
[[nodiscard]] std::string inspect_text(const InspectedSample& sample, const PixelSample& which);

/// The same, all of it.
[[nodiscard]] nlohmann::ordered_json inspect_json(const InspectedSample& sample,
                                                  const PixelSample& which);

}  // namespace bdpt::app
