#pragma once

#include "file/bytes.h"
#include "image/ktx2_header.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace bdpt::io {

/// libktx of Khronos, which is opened by the program bdpt-read-ktx, in a process of its own for
/// each image: a file that crashes it costs one image.
class Ktx2Decoder {
public:
    /// `library` is a file or a folder with libktx.so.4; none: what the system finds by that name.
    /// Nothing is opened yet.
    explicit Ktx2Decoder(const std::optional<std::filesystem::path>& library);

    /// Why no image can be decoded; null: images can. The first call starts a process to find out.
    [[nodiscard]] const std::string* obstacle();

    /// Decodes the first level into room for width * height * channels bytes, top row first. May be
    /// called by several threads at once. Throws std::runtime_error where the file is broken,
    /// `Error` (out_of_memory) where the system has no room for a process.
    void decode(ByteView file, const Ktx2Header& header, std::uint8_t* texels) const;

private:
    std::string library_;  // empty: what the system finds
    bool is_known_ = false;
    std::optional<std::string> obstacle_;
};

}  // namespace bdpt::io
