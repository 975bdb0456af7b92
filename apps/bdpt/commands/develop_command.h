#pragma once

#include "options/develop_arguments.h"

namespace bdpt::app {

/// `bdpt develop`: writes pictures of an EXR file, from its layers. Returns the exit code; throws
/// `Error`.
[[nodiscard]] int run_develop(const DevelopArguments& arguments);

}  // namespace bdpt::app
