#include <bdpt/error.h>
#include <bdpt/io/environment.h>

#include "file/named_errors.h"
#include "file/standard_input.h"
#include "file/warnings.h"
#include "image/exr_reader.h"
#include "image/hdr_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

namespace bdpt::io {

namespace {

/// Light is finite and not negative.
void mend_pixels(Image& image, Warnings& warnings)
{
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            float& value = image.pixels[i][c];
            if (std::isfinite(value) && value >= 0.0f) {
                continue;
            }
            const auto width = static_cast<std::size_t>(image.width);
            warnings.add("negative, infinite and NaN values are taken as 0",
                         fmt::format("pixel ({}, {}): {}", i % width, i / width, value));
            value = 0.0f;
        }
    }
}

LoadedEnvironment load(const std::filesystem::path& file, const ReadLimits& limits)
{
    const Bytes bytes = read_named(file, limits.file_bytes);
    Warnings warnings;
    LoadedEnvironment loaded;
    if (is_exr(bytes)) {
        loaded.light.radiance = read_exr(bytes, std::nullopt, limits, warnings).image;
    } else if (is_hdr(bytes)) {
        loaded.light.radiance = read_hdr(bytes, limits);
    } else {
        throw Error(ErrorCode::unsupported, "neither OpenEXR nor Radiance HDR");
    }
    mend_pixels(loaded.light.radiance, warnings);
    const Image& image = loaded.light.radiance;
    if (image.width != 2 * image.height && image.width * image.height != 1) {
        warnings.add("an equirectangular image should be twice as wide as high",
                     fmt::format("{} x {} pixels", image.width, image.height));
    }
    loaded.warnings = warnings.lines();
    return loaded;
}

}  // namespace

LoadedEnvironment load_environment(const std::filesystem::path& file, const ReadLimits& limits)
{
    return with_named_errors(file, [&] { return load(file, limits); });
}

}  // namespace bdpt::io
