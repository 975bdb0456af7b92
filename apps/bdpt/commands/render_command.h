#pragma once

#include <string>
#include <vector>

#include "options/render_arguments.h"

namespace bdpt::app {

/// `bdpt render`. `words` are those that were typed. The result is the exit code: 0, or 128 + a
/// signal's number when that ended the render early. Throws `Error` before anything is written, or
/// when that fails.
[[nodiscard]] int run_render(const RenderArguments& arguments,
                             const std::vector<std::string>& words);

}  // namespace bdpt::app
