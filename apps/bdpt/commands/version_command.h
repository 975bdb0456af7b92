#pragma once

#include <string>

namespace bdpt::app {

/// Returns "bdpt 0.2.0", and in further lines its libraries and the ray tracing kernels that it
/// uses on this machine.
[[nodiscard]] std::string version_text();

}  // namespace bdpt::app
