#pragma once

/// @file
/// Reads images and their layers, and environment lights from images.
///
/// @code{.cpp}
/// const bdpt::io::LoadedImage file = bdpt::io::read_image("out.exr", {.layer = "normal"});
/// const bdpt::Rgb normal = file.image.at(0, 0);
/// std::cout << normal.x << ' ' << normal.y << ' ' << normal.z << '\n';
/// @endcode
///
/// @code{.cpp}
/// const bdpt::io::LoadedEnvironment sky = bdpt::io::load_environment("sky.exr");
/// for (const std::string& warning : sky.warnings) {
///     std::cerr << "sky.exr: " << warning << '\n';
/// }
/// const bdpt::Scene scene(bdpt::io::load_gltf("car.glb").scene);
/// const bdpt::Scene lit = scene.with_environment(sky.light);
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/scene_desc.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Input and output: glTF to `SceneDesc`, images to and from EXR, PNG and Radiance HDR.
namespace bdpt::io {

/// The layer to read from an image file, and the limits.
struct ImageOptions {
    /// Name of the layer: "albedo" reads albedo.R, albedo.G, albedo.B; X, Y, Z serve as well, and a
    /// single channel gives grey. None: the image itself, or else the first layer that has colours.
    std::optional<std::string> layer{};
    ReadLimits limits{};
};

/// The result of `read_image`.
struct LoadedImage {
    Image image;       ///< whole image, black where the file has no data
    PixelRect filled;  ///< region with data: all of it, or the part that was rendered
    std::vector<std::string> warnings;  ///< one line each, without the file's name
    /// Names and values of texts and numbers in the header of an OpenEXR file.
    std::vector<std::pair<std::string, std::string>> attributes{};
};

/// Reads linear pixels from an OpenEXR (of halves or floats; the first part) or Radiance HDR file,
/// or from a PNG, JPEG or WebP file, whose colours are taken as sRGB-encoded. The first bytes tell
/// the format; "-" is the standard input. Values are returned as stored, also negative, infinite or
/// NaN ones. Alpha is ignored: colours are taken as they are.
///
/// Throws `Error`, whose message starts with the file's path: not_found (missing or unreadable; no
/// such layer), invalid_input (broken, or over a limit), unsupported (another format).
[[nodiscard]] BDPT_EXPORT LoadedImage read_image(const std::filesystem::path& file,
                                                 const ImageOptions& options = {});

/// Reads a PNG, JPEG or WebP file as stored: integers of 8 or 16 bits, as of masks. Throws `Error`
/// as `read_image`.
[[nodiscard]] BDPT_EXPORT TexelImage read_texels(const std::filesystem::path& file,
                                                 const ReadLimits& limits = {});

/// Limits on an environment, and what is refused.
struct EnvironmentOptions {
    ReadLimits limits{};
    /// Budget that the environment's memory is taken from until it lights a scene; null: only
    /// `limits` count.
    MemoryBudget* memory = nullptr;
    /// True: a damaged image is refused (`ErrorCode::unsupported`), where it otherwise gives a
    /// warning.
    bool strict = false;
};

/// The result of `load_environment`.
struct LoadedEnvironment {
    EnvironmentLightDesc light;
    std::vector<std::string> warnings;  ///< one line each, without the file's name
};

/// Reads an equirectangular image in OpenEXR, Radiance HDR, TIFF, PNG, JPEG or WebP format, as its
/// first bytes tell; "-" is the standard input. Colours of the last three are taken as
/// sRGB-encoded, with white as 1 nit. Other pixels are taken as linear Rec. 709 [nit]. With a
/// warning, negative and NaN values become 0, and infinite ones the greatest value: 65504 in images
/// of halves, else 2^42. TIFF images are of floats; OpenImageIO reads them, and is opened for the
/// first one.
///
/// Throws `Error`, whose message starts with the file's path: not_found (missing or unreadable),
/// invalid_input (broken, or over a limit), unsupported (another format or kind of pixels; TIFF
/// without OpenImageIO).
[[nodiscard]] BDPT_EXPORT LoadedEnvironment
load_environment(const std::filesystem::path& file, const EnvironmentOptions& options = {});

}  // namespace bdpt::io
