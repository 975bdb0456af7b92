#pragma once

/// @file
/// Writes PNG images.
///
/// @code{.cpp}
/// void write_picture(const bdpt::Image& image)
/// {
///     bdpt::io::PngOptions options;
///     options.exposure = bdpt::io::automatic_exposure(image);
///     bdpt::io::write_png("out.png", bdpt::io::tone_map(image, options.exposure), options);
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/io/image_metadata.h>
#include <bdpt/io/tone_map.h>

#include <filesystem>

namespace bdpt::io {

/// Data of the file beside the image.
struct PngOptions {
    float exposure = 0.0f;  ///< exposure of the image [EV]; for the record
    ImageMetadata metadata;
    ToneCurve curve = ToneCurve::filmic;  ///< tone curve of the image; for the record
};

/// Writes an 8-bit RGB PNG with an sRGB chunk and the metadata as text, atomically. Throws `Error`:
/// usage for an image without pixels or with too few or too many, output if the file cannot be
/// written.
BDPT_EXPORT void write_png(const std::filesystem::path& file, const DisplayImage& image,
                           const PngOptions& options);

/// Writes a PNG of 8 or 16 bits with 1 to 4 channels: grey or RGB, without or with straight alpha,
/// all but alpha sRGB-encoded; with an sRGB chunk and the metadata as text, atomically. Throws
/// `Error` like the other overload, and (usage) for other types and numbers of channels.
BDPT_EXPORT void write_png(const std::filesystem::path& file, const TexelImage& image,
                           const PngOptions& options);

/// Tests whether `write_png` has written `file`. False for a file that is missing, unreadable or no
/// PNG.
[[nodiscard]] BDPT_EXPORT bool is_png_of_bdpt(const std::filesystem::path& file);

}  // namespace bdpt::io
