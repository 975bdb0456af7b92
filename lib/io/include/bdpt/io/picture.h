#pragma once

/// @file
/// Writes JPEG, WebP and Radiance HDR images.
///
/// @code{.cpp}
/// void write_pictures(const bdpt::Image& image)
/// {
///     const bdpt::TexelImage shown = bdpt::io::to_display(image, {}, {});
///     bdpt::io::write_jpeg("out.jpg", shown, {});
///     bdpt::io::write_webp("out.webp", shown, {});
///     bdpt::io::write_hdr("out.hdr", image, {});
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/io/image_metadata.h>
#include <bdpt/io/png.h>

#include <filesystem>

namespace bdpt::io {

// Images in other formats than OpenEXR and PNG. All are written atomically, and throw `Error`:
// usage for an image without pixels, or with too few or too many, output if the file cannot be
// written.

/// Writes a baseline JPEG file with full chroma at quality 95 of 100, with the metadata as
/// comments. The image has 8 bits and 1 or 3 channels, grey or sRGB; usage for others.
BDPT_EXPORT void write_jpeg(const std::filesystem::path& file, const TexelImage& image,
                            const PngOptions& options);

/// Writes a WebP file at quality 95 of 100, lossy except for alpha, with the metadata as Exif's
/// description. The image has 8 bits and 3 or 4 channels, sRGB and straight alpha, and at most
/// 16383 pixels a side; usage for others.
BDPT_EXPORT void write_webp(const std::filesystem::path& file, const TexelImage& image,
                            const PngOptions& options);

/// Writes linear pixels as a run-length encoded Radiance HDR file [Ward, "The RADIANCE Picture File
/// Format"], with the metadata as comments. Values get 8 bits and a shared exponent; negative ones
/// and NaN become 0.
BDPT_EXPORT void write_hdr(const std::filesystem::path& file, const Image& image,
                           const ImageMetadata& metadata);

}  // namespace bdpt::io
