#pragma once

#include <bdpt/render_options.h>

namespace bdpt {

/// Throws `Error` (usage) if numbers of light paths or connections are out of range or
/// inconsistent, or if shared light paths could take more than `light_path_memory`. All other
/// options have been checked.
void check_light_paths(const RenderOptions& options);

}  // namespace bdpt
