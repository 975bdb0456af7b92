#pragma once

#include <bdpt/io/output_file.h>
#include <bdpt/part/content_hash.h>

#include <cstdint>
#include <filesystem>
#include <span>

namespace bdpt::io {

// A part file ends with a seal, behind the data of OpenEXR: 16 letters, the length of what is
// before it, and the hash of that. So a file that is truncated, or of which a single bit has
// changed, is detected before any of it is used.

/// An open part file with a valid seal.
class SealedFile {
public:
    /// Opens and checks a file. Throws `Error`: not_found, or invalid_input if the seal is not
    /// valid. Messages do not name the file.
    explicit SealedFile(const std::filesystem::path& file);
    ~SealedFile();
    SealedFile(const SealedFile&) = delete;
    SealedFile& operator=(const SealedFile&) = delete;

    /// Returns the size without the seal.
    [[nodiscard]] std::uint64_t size() const { return size_; }
    [[nodiscard]] const ContentHash& hash() const { return hash_; }
    /// Reads bytes. Throws `Error` (invalid_input) beyond the end.
    void read(std::uint64_t position, std::span<char> bytes) const;

private:
    void check();

    int descriptor_ = -1;
    std::uint64_t size_ = 0;
    ContentHash hash_;
};

/// Appends the seal to `file`, which has `size` bytes.
void seal(OutputFile& file, std::uint64_t size);

}  // namespace bdpt::io
