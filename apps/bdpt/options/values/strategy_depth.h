#pragma once

#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <optional>
#include <string>

#include "options/groups/strategy_arguments.h"

namespace bdpt::app {

/// Maximum path length of strategy images.
struct StrategyDepth {
    int edges = 0;
    std::optional<std::string> warning;  ///< that paths are shorter than by default
};

/// Returns the depth that the user chose, or else the default, reduced to what memory allows.
/// Throws `Error` (usage) if the chosen one needs too much memory, or if no strategy makes such
/// paths.
[[nodiscard]] StrategyDepth strategy_depth(const StrategyFiles& files, RenderOptions options,
                                           const CameraDesc& camera);

}  // namespace bdpt::app
