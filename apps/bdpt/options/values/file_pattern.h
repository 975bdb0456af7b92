#pragma once

#include <filesystem>
#include <string>

namespace bdpt::app {

/// Has the name of `file` a run of '#', like "out.####.exr", in which a number goes?
[[nodiscard]] bool takes_number(const std::filesystem::path& file);

/// `file` with `number` in the place of its run of '#', with zeros in front if it is shorter:
/// "out.0012.exr". Without a run it stays. Throws `OptionError` when its name has two runs.
[[nodiscard]] std::filesystem::path with_number(const std::filesystem::path& file, int number);

/// Has the name of `file` a place for the name of a camera: "{camera}"?
[[nodiscard]] bool takes_camera(const std::filesystem::path& file);

/// `file` with `camera` in the place of "{camera}". What could be more than a part of a file's name
/// (slashes, control characters, a dot at its beginning) becomes '_'.
[[nodiscard]] std::filesystem::path with_camera(const std::filesystem::path& file,
                                                const std::string& camera);

/// `file` with `name`, that of a scene, in the place of "{name}" in its name.
[[nodiscard]] std::filesystem::path with_scene(const std::filesystem::path& file,
                                               const std::string& name);

}  // namespace bdpt::app
