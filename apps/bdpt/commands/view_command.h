#pragma once

#include "options/view_arguments.h"

namespace bdpt::app {

/// Runs `bdpt view` with the given `options`. Returns the exit code: 0 after SIGINT. Throws `Error`
/// if it cannot listen, or the scene cannot be loaded.
[[nodiscard]] int run_view(const ViewArguments& arguments, const OptionList& options);

}  // namespace bdpt::app
