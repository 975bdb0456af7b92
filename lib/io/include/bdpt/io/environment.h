#pragma once

/// @file
/// Reads environment lights from images.
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
#include <bdpt/io/memory_budget.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/scene_desc.h>

#include <filesystem>
#include <string>
#include <vector>

namespace bdpt::io {

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
