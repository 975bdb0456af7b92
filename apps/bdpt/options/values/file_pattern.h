#pragma once

#include <filesystem>
#include <string>

namespace bdpt::app {

/// Tests whether the name of `file` has a run of '#', the placeholder of a number: "out.####.exr".
[[nodiscard]] bool takes_number(const std::filesystem::path& file);

/// Replaces the run of '#' in `file` by `number`, with leading zeros up to its length:
/// "out.0012.exr". A file without a run is unchanged. Throws `OptionError` if its name has two
/// runs.
[[nodiscard]] std::filesystem::path with_number(const std::filesystem::path& file, int number);

/// Tests whether the name of `file` has the placeholder of a camera's name: "{camera}".
[[nodiscard]] bool takes_camera(const std::filesystem::path& file);

/// Replaces "{camera}" in `file` by `camera`. Characters that cannot be in a file name (slashes,
/// control characters, a dot at its beginning) become '_'.
[[nodiscard]] std::filesystem::path with_camera(const std::filesystem::path& file,
                                                const std::string& camera);

/// Replaces "{name}" in the name of `file` by `name`, that of a scene.
[[nodiscard]] std::filesystem::path with_scene(const std::filesystem::path& file,
                                               const std::string& name);

}  // namespace bdpt::app
