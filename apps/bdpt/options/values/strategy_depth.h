#pragma once

#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <optional>
#include <string>

#include "options/groups/strategy_arguments.h"

namespace bdpt::app {

/// How long the paths are whose strategies get images.
struct StrategyDepth {
    int edges = 0;
    std::optional<std::string> warning;  ///< that they are shorter than they would be
};

/// The depth that the user chose, or the default one or as much of it as memory is allowed for.
/// Throws `Error` (usage) when that is too much, or when no strategy makes such paths.
[[nodiscard]] StrategyDepth strategy_depth(const StrategyFiles& files, RenderOptions options,
                                           const CameraDesc& camera);

}  // namespace bdpt::app
