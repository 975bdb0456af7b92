#pragma once

#include <bdpt/io/output_file.h>
#include <bdpt/part/content_hash.h>

#include <cstdint>
#include <filesystem>
#include <span>

namespace bdpt::io {

// A part file ends with a seal, behind what OpenEXR looks at: 16 letters, the length of what is
// before it, and the hash of that. So a file that was cut off, or of which a single bit has
// changed, is found out before any of it is believed.

/// An open part file, whose seal holds.
class SealedFile {
public:
    /// Throws `Error`: not_found, or invalid_input when the seal does not hold. Messages do not
    /// name the file.
    explicit SealedFile(const std::filesystem::path& file);
    ~SealedFile();
    SealedFile(const SealedFile&) = delete;
    SealedFile& operator=(const SealedFile&) = delete;

    /// Without the seal.
    [[nodiscard]] std::uint64_t size() const { return size_; }
    [[nodiscard]] const ContentHash& hash() const { return hash_; }
    /// Throws `Error` (invalid_input) beyond the end.
    void read(std::uint64_t position, std::span<char> bytes) const;

private:
    void check();

    int descriptor_ = -1;
    std::uint64_t size_ = 0;
    ContentHash hash_;
};

/// Ends `file`, which has `size` bytes, with its seal.
void seal(OutputFile& file, std::uint64_t size);

}  // namespace bdpt::io
