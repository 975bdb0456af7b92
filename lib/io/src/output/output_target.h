#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace bdpt::io {

/// What the name of an output stands for.
enum class TargetKind : std::uint8_t {
    file,  ///< a regular file, or none yet: a new file takes its place
    pipe,  ///< a named pipe, which is opened when all bytes are there: it may wait for a reader
    descriptor,  ///< something that is open: a standard stream, a device
};

/// Who may do what with a file.
struct FileAccess {
    mode_t mode = 0;
    uid_t owner = 0;
    gid_t group = 0;
};

struct OutputTarget {
    TargetKind kind = TargetKind::file;
    std::filesystem::path path;          ///< of a file or pipe, links followed
    int descriptor = -1;                 ///< of kind `descriptor`; to be closed
    std::optional<FileAccess> access{};  ///< of the regular file that is there
};

/// "-" is the standard output, and "/dev/fd/N" what descriptor N of this process leads to. Throws
/// `Error` (output), which calls the output `name`, for what cannot be written: a folder, a socket,
/// a block device, a terminal, a protected file, a file in a folder that is not there.
[[nodiscard]] OutputTarget find_target(const std::filesystem::path& name);

/// Throws the `Error` (output) for `name`.
[[noreturn]] void refuse_output(const std::filesystem::path& name, const std::string& reason);

/// What the system calls an error.
[[nodiscard]] std::string error_text(int error_number);

}  // namespace bdpt::io
