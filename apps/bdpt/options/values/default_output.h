#pragma once

#include <filesystem>

namespace bdpt::app {

/// Returns the default output for the scene in `file`: its name with .png, in the working
/// directory. Throws `Error` (output) if a file there is not an image of ours.
[[nodiscard]] std::filesystem::path default_output(const std::filesystem::path& file);

}  // namespace bdpt::app
