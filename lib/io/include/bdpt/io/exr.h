#pragma once

/// @file
/// Writes OpenEXR images.
///
/// @code{.cpp}
/// void write_half_floats(const bdpt::Image& image)
/// {
///     bdpt::io::ExrOptions options;
///     options.type = bdpt::io::ExrChannelType::half_float;
///     const bdpt::io::ExrReport report = bdpt::io::write_exr("out.exr", image, options);
///     std::cout << report.clamped_pixels << " pixels are too bright for half floats\n";
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/film/id_film.h>
#include <bdpt/image.h>
#include <bdpt/io/image_metadata.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace bdpt::io {

/// Type of the channels of an EXR file.
enum class ExrChannelType : std::uint8_t {
    half_float,    ///< 16 bits: 11 bits of precision, at most 65504
    single_float,  ///< 32 bits: as computed
};

/// Storage order of the pixels of an EXR file.
enum class ExrStorage : std::uint8_t {
    scanlines,
    tiles,  ///< 64 x 64 pixels, one level: for viewers and compositors that read parts
};

/// Position of a cropped image in the whole image [pixels].
struct ExrPlacement {
    int x = 0;
    int y = 0;
    int full_width = 0;
    int full_height = 0;
};

/// Options of an EXR file, and its metadata.
struct ExrOptions {
    /// Type of the main layer; others have floats.
    ExrChannelType type = ExrChannelType::single_float;
    ImageMetadata metadata;
    ExrStorage storage = ExrStorage::scanlines;
    std::optional<ExrPlacement> placement{};  ///< none: it is not cropped
    /// Manifests written as Cryptomatte metadata, if their layers are among those of the file.
    std::vector<IdManifest> manifests{};
};

/// Counts of values that could not be written unchanged.
struct ExrReport {
    /// Pixels with a channel beyond the range of half, which was stored as 65504.
    std::size_t clamped_pixels = 0;
};

/// Writes channels R, G, B (linear Rec. 709 [nit]) with ZIP compression, atomically. The data
/// window is the rendered part, the display window the whole image. The header has our own entries
/// and those that other tools show: "renderTimeSeconds", "samplesPerPixel", "worldToCamera",
/// "worldToNDC", and for frames "imageCounter" and "framesPerSecond". Throws `Error` (output).
BDPT_EXPORT ExrReport write_exr(const std::filesystem::path& file, const Image& image,
                                const ExrOptions& options);

/// Writes an image with layers: "NAME.C" for each channel C of a layer, or just "C" for those of
/// the main layer. Throws `Error` (output), and (usage) if a layer's size is not the image's or a
/// channel comes twice.
BDPT_EXPORT ExrReport write_exr(const std::filesystem::path& file, const Image& image,
                                std::span<const Layer> layers, const ExrOptions& options);

}  // namespace bdpt::io
