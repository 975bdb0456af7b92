#pragma once

#include <bdpt/io/image_metadata.h>
#include <bdpt/part/sample_rates.h>

#include <filesystem>

namespace bdpt::app {

/// Writes rates as .exr, which --rates reads, or as .png in false colours: the number of samples of
/// each pixel. Throws `Error` (output).
void save_rates(const std::filesystem::path& file, const SampleRates& rates,
                const io::ImageMetadata& metadata);

}  // namespace bdpt::app
