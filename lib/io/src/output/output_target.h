#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace bdpt::io {

/// Kind of an output's target.
enum class TargetKind : std::uint8_t {
    file,        ///< a regular file, existing or not: a new file replaces it
    pipe,        ///< a named pipe, opened when all bytes are there, as that may wait for a reader
    descriptor,  ///< an open descriptor: a standard stream, a device
};

/// Permissions and ownership of a file.
struct FileAccess {
    mode_t mode = 0;
    uid_t owner = 0;
    gid_t group = 0;
};

struct OutputTarget {
    TargetKind kind = TargetKind::file;
    std::filesystem::path path;          ///< path of a file or pipe, with links followed
    int descriptor = -1;                 ///< for kind `descriptor`; to be closed
    std::optional<FileAccess> access{};  ///< access rights of the existing regular file
};

/// Finds the target of an output: "-" is the standard output, and "/dev/fd/N" the file behind
/// descriptor N of this process. Throws `Error` (output), which calls the output `name`, for a
/// target that cannot be written: a folder, a socket, a block device, a terminal, a protected file,
/// a file in a missing folder.
[[nodiscard]] OutputTarget find_target(const std::filesystem::path& name);

/// Throws the `Error` (output) for `name`.
[[noreturn]] void refuse_output(const std::filesystem::path& name, const std::string& reason);

/// Returns the system's text for an error.
[[nodiscard]] std::string error_text(int error_number);

}  // namespace bdpt::io
