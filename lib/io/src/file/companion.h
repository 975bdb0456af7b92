#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace bdpt::io {

/// Returns the folder of the library or program that contains this code; empty where the system
/// does not tell.
[[nodiscard]] std::filesystem::path own_folder();

/// Returns the path of a file installed beside this library, such as a module or a program that is
/// started on demand. Throws `Error` (unsupported) that names the searched places if it is at none
/// of them.
[[nodiscard]] std::filesystem::path companion_file(std::string_view name);

/// Returns the path of such a file; none if it is at none of these places.
[[nodiscard]] std::optional<std::filesystem::path> find_companion(std::string_view name);

}  // namespace bdpt::io
