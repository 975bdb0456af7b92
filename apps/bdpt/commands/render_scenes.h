#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "options/option_list.h"
#include "options/render_arguments.h"

namespace bdpt::app {

/// Renders one scene and returns an exit code.
using RenderScene = std::function<int(const RenderArguments& arguments)>;

/// Returns `asked` for `scene`, whose name replaces the placeholders in file names. Without outputs
/// it gets its default one.
[[nodiscard]] RenderArguments for_scene(const RenderArguments& asked,
                                        const std::filesystem::path& scene);

/// Runs `bdpt render SCENE...`: renders `asked` for each of `scenes`, one after the other; "{name}"
/// in output names is replaced by the scene's name without folder and extension. Without outputs
/// each scene has its default one. The failure of a scene is reported, and the others are still
/// rendered. Returns the exit code of the first that failed. Throws `Error` before anything is
/// rendered if two scenes would write the same file, or if options are for one scene alone.
int run_render_scenes(const RenderArguments& asked,
                      const std::vector<std::filesystem::path>& scenes, const OptionList& options,
                      const RenderScene& render);

}  // namespace bdpt::app
