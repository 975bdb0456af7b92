#pragma once

#include <filesystem>

namespace bdpt::app {

/// Where the image of the scene in `file` goes, if nobody says so: its name with .png, in the
/// working directory. Throws `Error` (output) where something else is than an image of ours.
[[nodiscard]] std::filesystem::path default_output(const std::filesystem::path& file);

}  // namespace bdpt::app
