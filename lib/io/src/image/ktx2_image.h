#pragma once

#include "file/bytes.h"
#include "image/ktx2_decoder.h"
#include "image/ktx2_header.h"

#include <cstdint>

namespace bdpt::io {

/// A KTX2 file in memory whose header has been checked.
class Ktx2Image {
public:
    /// `bytes` and `decoder` must outlive the image; null: there is no decoder. Throws
    /// std::runtime_error if the header is broken, or nothing decodes the image.
    Ktx2Image(ByteView bytes, Ktx2Decoder* decoder);

    [[nodiscard]] const Ktx2Header& header() const { return header_; }
    [[nodiscard]] int width() const { return header_.width; }
    [[nodiscard]] int height() const { return header_.height; }
    /// Returns 3: RGB, or 4: RGBA.
    [[nodiscard]] int channels() const { return header_.channels; }
    [[nodiscard]] static constexpr int value_bytes() { return 1; }

    /// Returns the memory that another process may take to decode it [bytes].
    [[nodiscard]] std::uint64_t process_memory() const { return decoding_memory(bytes_, header_); }

    /// Decodes all pixels, top row first, into room for width * height * channels values. Throws as
    /// `Ktx2Decoder::decode`.
    void read(std::uint8_t* values);

private:
    ByteView bytes_;
    Ktx2Decoder* decoder_;
    Ktx2Header header_;
};

}  // namespace bdpt::io
