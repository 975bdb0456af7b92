#pragma once

#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <vector>

namespace bdpt {

/// Returns the strategies of a render that get images, shortest paths first, then by s: those that
/// are used and that the camera supports, up to `strategy_depth`. `options` and `camera` have been
/// checked.
[[nodiscard]] std::vector<Strategy> strategies_with_images(const RenderOptions& options,
                                                           const CameraDesc& camera);

/// Throws `Error` (usage) if the images would take more than `strategy_memory`.
void check_strategy_memory(const RenderOptions& options, const CameraDesc& camera);

}  // namespace bdpt
