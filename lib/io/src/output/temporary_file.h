#pragma once

#include <filesystem>
#include <string>

namespace bdpt::io {

/// Host, process number and 16 random digits. They tell this process from all others that may write
/// to the same folder. Its number does not: processes of two containers, or of two machines, may
/// have the same.
[[nodiscard]] const std::string& process_name();

struct TemporaryFile {
    int descriptor = -1;  ///< -1: errno tells why there is none
    std::filesystem::path path;
};

/// A new file, called `name`. It is there already if this process has another `OutputFile` for the
/// same target: then the name gets a number.
[[nodiscard]] TemporaryFile create_temporary(const std::filesystem::path& name);

}  // namespace bdpt::io
