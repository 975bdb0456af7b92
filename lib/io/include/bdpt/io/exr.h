#pragma once

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/io/picture_metadata.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace bdpt::io {

/// How a channel of an EXR file is stored.
enum class ExrChannelType : std::uint8_t {
    half_float,    ///< 16 bits: 11 bits of precision, at most 65504
    single_float,  ///< 32 bits: as it was computed
};

/// What goes into the file beside the picture.
struct ExrOptions {
    ExrChannelType type = ExrChannelType::single_float;
    PictureMetadata metadata;
};

/// What could not be written as it was.
struct ExrReport {
    /// Pixels with a channel beyond what a half holds; it was stored as 65504.
    std::size_t clamped_pixels = 0;
};

/// Writes channels R, G, B (linear Rec. 709 [nit]) with ZIP compression, atomically. Beside our own
/// entries the header has those that other tools show: "renderTimeSeconds", "samplesPerPixel",
/// "worldToCamera", "worldToNDC". Throws `Error`: usage for an image without pixels or with too few
/// or too many, output when the file cannot be written.
BDPT_EXPORT ExrReport write_exr(const std::filesystem::path& file, const Image& image,
                                const ExrOptions& options);

}  // namespace bdpt::io
