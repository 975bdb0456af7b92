#pragma once

/// @file
/// Keeps the rates of an adaptive render in a file, for all machines that take part.
///
/// @code{.cpp}
/// void write_rates_for_farm(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     bdpt::io::write_rates("rates.exr", bdpt::sample_rates(scene, camera, {}), {});
///     const bdpt::SampleRates rates = bdpt::io::read_rates("rates.exr");  // on each machine
///     std::cout << rates.mean() << " samples a round\n";
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/io/image_metadata.h>
#include <bdpt/part/sample_rates.h>

#include <filesystem>

namespace bdpt::io {

/// Writes rates as an OpenEXR image of halves, which hold them exactly: R, G and B are the samples
/// that the pixel takes in a round, 0.25 to 4. Written atomically. Throws `Error` (output).
BDPT_EXPORT void write_rates(const std::filesystem::path& file, const SampleRates& rates,
                             const ImageMetadata& metadata);

/// Reads a file in the format of `write_rates`, whoever made it. Throws `Error`, whose message
/// starts with the file's path: those of `read_image`, and invalid_input for a cropped image and
/// for pixels that are no power of two from 1/4 to 4.
[[nodiscard]] BDPT_EXPORT SampleRates read_rates(const std::filesystem::path& file);

}  // namespace bdpt::io
