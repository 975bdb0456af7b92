#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace bdpt::io {

/// The folder of the library or program that holds this code; empty where the system does not tell.
[[nodiscard]] std::filesystem::path own_folder();

/// Where a file that is installed beside this library may lie, such as a module or a program that
/// is only started when it is needed. Throws `Error` (unsupported), which names the places, when it
/// is at none of them.
[[nodiscard]] std::filesystem::path companion_file(std::string_view name);

}  // namespace bdpt::io
