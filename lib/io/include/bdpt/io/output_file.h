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

/// A file that appears under its name only when it is whole. Until then its bytes are in
/// `temporary_path()`, in the same folder; without a commit nothing is left of it.
///
/// A symbolic link is followed, and what it leads to is replaced. The new file has the mode of the
/// one that it replaces and, where the process may set them, its owner and group.
///
/// The name "-" is the standard output. Bytes for it, for a device, a pipe or an open descriptor
/// ("/dev/stdout", "/dev/fd/3") are kept in memory, and go there when the file is committed. A file
/// called "-" is "./-".
class BDPT_EXPORT OutputFile {
public:
    /// Where `file` grows: `NAME.tmp-HOST-PID-` and 16 random digits beside it, which no other
    /// process has, be it on another machine or in another container. A symbolic link is followed
    /// first. Of a very long name it has only the begin.
    [[nodiscard]] static std::filesystem::path temporary_path(const std::filesystem::path& file);

    /// Throws `Error` (output) when the folder is missing or cannot be written, or when `file`
    /// exists and is a folder, a socket, a block device, a terminal or protected.
    explicit OutputFile(const std::filesystem::path& file);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Writes at `position()` and moves it on. Throws `Error` (output).
    void write(std::span<const char> bytes);
    [[nodiscard]] std::uint64_t position() const { return position_; }
    void seek(std::uint64_t position) { position_ = position; }
    /// One behind the last byte that was written.
    [[nodiscard]] std::uint64_t size() const { return size_; }

    /// Reads what was written at `position` back. Throws `Error` (output) when it is not there.
    void read(std::uint64_t position, std::span<char> bytes) const;

    /// Brings the bytes to the disk and gives the file its name, in place of one that had it; or
    /// sends them to the device or pipe, and waits until somebody reads from that. Throws `Error`
    /// (output), also when an earlier write failed.
    void commit();

private:
    void send();
    void close_stream();

    std::filesystem::path name_;  // as the caller knows it, for messages
    std::filesystem::path target_;
    std::filesystem::path temporary_;  // empty: it has no name
    int descriptor_ = -1;
    int stream_ = -1;  // where the bytes are sent; -1: nowhere, or not yet
    std::uint64_t position_ = 0;
    std::uint64_t size_ = 0;
    int first_error_ = 0;  // errno of the first write that failed
};

/// The file that an output called `file` writes: symbolic links are followed, also to a file that
/// is not there. What leads to a descriptor of this process stays as it is.
[[nodiscard]] BDPT_EXPORT std::filesystem::path follow_links(const std::filesystem::path& file);

/// Throws `Error` (output) when `file` could not be written now. Leaves nothing behind.
BDPT_EXPORT void check_writable(const std::filesystem::path& file);

}  // namespace bdpt::io
