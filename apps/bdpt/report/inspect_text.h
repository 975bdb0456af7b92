#pragma once

#include <bdpt/inspect.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bdpt::app {

// `origin`: that of the world, in the coordinates of the file, which positions are told in.

/// Returns tables of the vertices and of the contributions of strategies, for people.
[[nodiscard]] std::string inspect_text(const InspectedSample& sample, const PixelSample& which,
                                       const DVec3& origin);

/// Returns the complete data of the sample, for programs.
[[nodiscard]] nlohmann::ordered_json inspect_json(const InspectedSample& sample,
                                                  const PixelSample& which, const DVec3& origin);

}  // namespace bdpt::app
