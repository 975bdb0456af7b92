#pragma once

/// @file
/// Writes files that appear under their name only when they are whole.
///
/// @code{.cpp}
/// const std::string text = "samples,error\n16,0.02\n";
/// bdpt::io::OutputFile file("errors.csv");
/// file.write(text);
/// file.commit();
/// @endcode

#include <bdpt/export.h>

#include <cstdint>
#include <filesystem>
#include <span>

namespace bdpt::io {

/// A file that appears under its name only when it is complete. Until then its bytes are in
/// `temporary_path()`, in the same folder; without a commit nothing is left behind.
///
/// A symbolic link is followed, and its target is replaced. The new file has the mode of the one
/// that it replaces and, where the process may set them, its owner and group.
///
/// The name "-" is the standard output. Bytes for the standard output, a device, a pipe or an open
/// descriptor ("/dev/stdout", "/dev/fd/3") are kept in memory and sent on commit. A file called "-"
/// is "./-".
class BDPT_EXPORT OutputFile {
public:
    /// Returns a temporary path for `file`: `NAME.tmp-HOST-PID-` and 16 random digits beside it,
    /// which no other process has, even on another machine or in another container. A symbolic link
    /// is followed first. A very long name is truncated.
    [[nodiscard]] static std::filesystem::path temporary_path(const std::filesystem::path& file);

    /// Opens the temporary file. Throws `Error` (output) if the folder is missing or not writable,
    /// or if `file` exists and is a folder, a socket, a block device, a terminal or protected.
    explicit OutputFile(const std::filesystem::path& file);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Writes at `position()` and advances it. Throws `Error` (output).
    void write(std::span<const char> bytes);
    [[nodiscard]] std::uint64_t position() const { return position_; }
    void seek(std::uint64_t position) { position_ = position; }
    /// Returns the offset behind the last byte written.
    [[nodiscard]] std::uint64_t size() const { return size_; }

    /// Reads back bytes that were written at `position`. Throws `Error` (output) if there are none.
    void read(std::uint64_t position, std::span<char> bytes) const;

    /// Flushes the bytes to the disk and renames the file, replacing one of that name; or sends the
    /// bytes to the device or pipe, waiting until they are read. Throws `Error` (output), also if
    /// an earlier write failed.
    void commit();

private:
    void send();
    void close_stream();

    std::filesystem::path name_;  // name given by the caller, for messages
    std::filesystem::path target_;
    std::filesystem::path temporary_;  // empty: the temporary file has no name
    int descriptor_ = -1;
    int stream_ = -1;  // descriptor that the bytes are sent to; -1: none, or not yet open
    std::uint64_t position_ = 0;
    std::uint64_t size_ = 0;
    int first_error_ = 0;  // errno of the first write that failed
};

/// Returns the file that an output called `file` writes: symbolic links are followed, also to a
/// file that does not exist. A path to a descriptor of this process stays as it is.
[[nodiscard]] BDPT_EXPORT std::filesystem::path follow_links(const std::filesystem::path& file);

/// Throws `Error` (output) if `file` could not be written now. Leaves nothing behind.
BDPT_EXPORT void check_writable(const std::filesystem::path& file);

}  // namespace bdpt::io
