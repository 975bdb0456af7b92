#pragma once

#include <string>
#include <vector>

#include "options/render_arguments.h"

namespace bdpt::app {

/// Runs `bdpt render`. `words` are the command line as typed. Returns the exit code: 0, or 128 + a
/// signal's number if that ended the render early. Throws `Error` before anything is written, or if
/// writing fails.
[[nodiscard]] int run_render(const RenderArguments& arguments,
                             const std::vector<std::string>& words);

}  // namespace bdpt::app
