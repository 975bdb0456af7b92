#pragma once

/// @file
/// Writes OpenEXR, PNG, JPEG, WebP and Radiance HDR images, with a record of how they came about.
///
/// @code{.cpp}
/// void write_with_metadata(const bdpt::RenderResult& result)
/// {
///     bdpt::io::ImageMetadata metadata;
///     metadata.version = BDPT_VERSION;
///     metadata.scene = "room.glb";
///     metadata.samples_per_pixel = result.film.sample_count();
///     bdpt::io::write_exr("out.exr", result.image(), {.metadata = metadata});
/// }
/// @endcode
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
#include <bdpt/film/id_film.h>
#include <bdpt/image.h>
#include <bdpt/io/display.h>
#include <bdpt/scene_desc.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::io {

/// Number of a frame in an animation.
struct FrameNumber {
    int number = 0;
    double per_second = 0.0;  ///< frames per second, > 0; 0: unknown
};

/// Provenance of an image; written into its file.
struct ImageMetadata {
    std::string version;     ///< version of bdpt, e.g. "0.1.0"
    std::string scene;       ///< the rendered file; UTF-8
    std::string settings;    ///< all options as one JSON object
    std::string integrator;  ///< "bdpt", "pt", "mis", "nee" or "lt"
    std::uint64_t seed = 0;
    std::int64_t samples_per_pixel = 0;
    double render_seconds = 0.0;
    CameraDesc camera;
    DVec3 origin{0.0};  ///< `SceneDesc::origin` of the scene that the camera is in
    std::chrono::system_clock::time_point created{};
    std::optional<FrameNumber> frame{};  ///< none: a single image
    /// Name and version of what denoised the image, or its layer "denoised"; empty: nothing.
    std::string denoiser{};
    std::string xmp{};  ///< the scene's metadata about itself, JSON-LD; empty: none
};

/// Returns the text entries that all formats share: "bdpt.version", "bdpt.scene", "bdpt.settings",
/// "bdpt.integrator" and "bdpt.seed"; "bdpt.frame", "bdpt.denoiser" and "bdpt.xmp" if present.
[[nodiscard]] BDPT_EXPORT std::vector<std::pair<std::string, std::string>> text_entries(
    const ImageMetadata& metadata);

/// Returns "bdpt VERSION".
[[nodiscard]] BDPT_EXPORT std::string software_name(const ImageMetadata& metadata);

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

/// Writes a file that has the channels of `layer` alone. Throws `Error`: output, and usage for a
/// layer without pixels, or with too few or too many.
BDPT_EXPORT void write_exr(const std::filesystem::path& file, const Layer& layer,
                           const ExrOptions& options);

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
