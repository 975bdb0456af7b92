#pragma once

#include <bdpt/job.h>

#include <string>
#include <vector>

#include "options/render_arguments.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"

namespace bdpt::app {

/// Renders one scene and writes all files: `bdpt render` and `bdpt::run`. `words` are the
/// equivalent command line. What happens is told to `console`; `interrupt` stops the render. Throws
/// `Error` before anything is written, or if writing fails.
[[nodiscard]] JobResult run_render(const RenderArguments& arguments,
                                   const std::vector<std::string>& words, Console& console,
                                   Interrupt& interrupt);

}  // namespace bdpt::app
