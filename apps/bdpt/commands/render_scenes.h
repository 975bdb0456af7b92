#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "options/option_list.h"
#include "options/render_arguments.h"

namespace bdpt::app {

/// What renders one scene, and returns an exit code.
using RenderScene = std::function<int(const RenderArguments& arguments)>;

/// `bdpt render SCENE...`: `asked` for each of `scenes`, one after the other; "{name}" in names of
/// outputs is that of the scene without its folder and extension. Without outputs each has
/// its default one. That a scene fails is told, and does not keep the others from being rendered.
/// Returns the exit code of the first that failed. Throws `Error` before anything is rendered where
/// two scenes would have the same file, or options are for one scene alone.
int run_render_scenes(const RenderArguments& asked,
                      const std::vector<std::filesystem::path>& scenes, const OptionList& options,
                      const RenderScene& render);

}  // namespace bdpt::app
