#pragma once

#include <signal.h>
#include <sys/types.h>

#include <cerrno>
#include <cstdint>
#include <ctime>
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

/// Returns host, process number and 16 random digits, which distinguish this process from all
/// others that may write to the same folder. The number alone does not: processes in two
/// containers, or on two machines, may share it.
[[nodiscard]] const std::string& process_name();

/// Returns the path at which the file `target` grows: in its folder, named after it and the
/// process. In a name too long for the file system the part from `target` is truncated.
[[nodiscard]] std::filesystem::path temporary_name(const std::filesystem::path& target);

struct TemporaryFile {
    int descriptor = -1;  ///< -1: errno tells why there is none
    std::filesystem::path path;
};

/// Creates a new file, called `name`, with the access rights of the file that it will replace, if
/// any. If `name` is taken, as by another `OutputFile` of this process for the same target, a
/// number is appended.
[[nodiscard]] TemporaryFile create_temporary(const std::filesystem::path& name,
                                             const std::optional<FileAccess>& access);

/// During its lifetime, a write beyond the process's limit of file sizes (ulimit -f) fails with
/// EFBIG instead of ending the process. Affects the calling thread only, so the host's handling of
/// the signal stays as it is.
class SizeSignalBlock {
public:
    SizeSignalBlock()
    {
        ::sigemptyset(&signal_);
        ::sigaddset(&signal_, SIGXFSZ);
        sigset_t pending;
        ::sigpending(&pending);
        was_pending_ = ::sigismember(&pending, SIGXFSZ) == 1;
        ::pthread_sigmask(SIG_BLOCK, &signal_, &before_);
    }
    ~SizeSignalBlock()
    {
        const timespec no_time{};
        while (!was_pending_ && ::sigtimedwait(&signal_, nullptr, &no_time) < 0 && errno == EINTR) {
        }
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    SizeSignalBlock(const SizeSignalBlock&) = delete;
    SizeSignalBlock& operator=(const SizeSignalBlock&) = delete;

private:
    sigset_t signal_{};
    sigset_t before_{};
    bool was_pending_ = false;
};

}  // namespace bdpt::io
