#pragma once

#include "options/develop_arguments.h"

namespace bdpt::app {

/// Runs `bdpt develop`: writes images for screens from an EXR file and its layers. Returns the exit
/// code; throws `Error`.
[[nodiscard]] int run_develop(const DevelopArguments& arguments);

}  // namespace bdpt::app
