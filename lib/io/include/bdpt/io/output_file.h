#pragma once

#include <bdpt/export.h>

#include <cstdint>
#include <filesystem>
#include <span>

namespace bdpt::io {

/// A file that appears under its name only when it is whole. Until then its bytes are in
/// `temporary_path()`, in the same folder; without a commit nothing is left of it.
///
/// The name "-" is the standard output: its bytes are kept in memory, and go there when the file
/// is committed. A file of that name is "./-".
class BDPT_EXPORT OutputFile {
public:
    /// Where `file` grows: `NAME.tmp-HOST-PID-` and 16 random digits beside it, which no other
    /// process has, be it on another machine or in another container. A symbolic link is followed
    /// first.
    [[nodiscard]] static std::filesystem::path temporary_path(const std::filesystem::path& file);

    /// Throws `Error` (output) when the folder is missing or cannot be written, when `file`
    /// exists and is a folder or protected, or when it is the standard output and that a terminal.
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

    /// Brings the bytes to the disk and gives the file its name, in place of one that had it.
    /// Throws `Error` (output), also when an earlier write failed.
    void commit();

private:
    void copy_to_standard_output() const;

    std::filesystem::path name_;  // as the caller knows it, for messages
    std::filesystem::path target_;
    std::filesystem::path temporary_;  // empty: it has no name
    int descriptor_ = -1;
    std::uint64_t position_ = 0;
    std::uint64_t size_ = 0;
    int first_error_ = 0;  // errno of the first write that failed
};

/// Throws `Error` (output) when `file` could not be written now. Leaves nothing behind.
BDPT_EXPORT void check_writable(const std::filesystem::path& file);

}  // namespace bdpt::io
