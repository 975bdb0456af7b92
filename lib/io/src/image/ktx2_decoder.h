#pragma once

#include "file/bytes.h"
#include "image/ktx2_header.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace bdpt::io {

/// Returns the memory that a process may take to decode the image in `file` [bytes].
[[nodiscard]] std::uint64_t decoding_memory(ByteView file, const Ktx2Header& header);

/// libktx of Khronos, opened by the program bdpt-read-ktx in a separate process for each image: a
/// file that crashes it costs only one image.
class Ktx2Decoder {
public:
    /// `library` is a file or a folder with libktx.so.4; none: the library that the system finds by
    /// that name. Nothing is opened yet.
    explicit Ktx2Decoder(const std::optional<std::filesystem::path>& library);

    /// Returns why no image can be decoded; null: images can. The first call starts a process to
    /// find out.
    [[nodiscard]] const std::string* obstacle();

    /// Decodes the first level into room for width * height * channels bytes, top row first.
    /// Thread-safe. Throws std::runtime_error if the file is broken, `Error` (out_of_memory) if the
    /// system has no room for a process.
    void decode(ByteView file, const Ktx2Header& header, std::uint8_t* texels) const;

private:
    std::string library_;  // empty: the one that the system finds
    bool is_known_ = false;
    std::optional<std::string> obstacle_;
};

}  // namespace bdpt::io
