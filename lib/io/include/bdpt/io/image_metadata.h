#pragma once

/// @file
/// Records how an image came about, for the header of its file.
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

#include <bdpt/export.h>
#include <bdpt/scene_desc.h>

#include <chrono>
#include <cstdint>
#include <optional>
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

}  // namespace bdpt::io
