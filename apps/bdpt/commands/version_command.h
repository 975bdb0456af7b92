#pragma once

#include <string>

namespace bdpt::app {

/// "bdpt 0.2.0", and in further lines what it was made with and what rays are traced with on this
/// machine.
[[nodiscard]] std::string version_text();

}  // namespace bdpt::app
