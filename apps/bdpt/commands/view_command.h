#pragma once

#include "options/view_arguments.h"

namespace bdpt::app {

/// `bdpt view`. `options` have what was given. The result is the exit code: 0 after SIGINT. Throws
/// `Error` when it cannot listen, or the scene cannot be loaded.
[[nodiscard]] int run_view(const ViewArguments& arguments, const OptionList& options);

}  // namespace bdpt::app
