#include <bdpt/error.h>
#include <bdpt/io/environment.h>

#include "file/file_kind.h"
#include "file/memory_costs.h"
#include "file/named_errors.h"
#include "file/standard_input.h"
#include "file/warnings.h"
#include "image/linear/display_reader.h"
#include "image/linear/exr_reader.h"
#include "image/linear/hdr_reader.h"
#include "image/linear/tiff_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

namespace bdpt::io {

namespace {

/// Makes pixels finite and non-negative.
void mend_pixels(Image& image, Warnings& warnings)
{
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            float& value = image.pixels[i][c];
            if (std::isfinite(value) && value >= 0.0f) {
                continue;
            }
            const auto width = static_cast<std::size_t>(image.width);
            warnings.add("negative, infinite and NaN values are treated as 0",
                         fmt::format("pixel ({}, {}): {}", i % width, i / width, value));
            value = 0.0f;
        }
    }
}

Image read_any(ByteView bytes, const ReadLimits& limits, Warnings& warnings,
               const MemoryBudget* memory)
{
    if (is_exr(bytes)) {
        return read_exr(bytes, std::nullopt, limits, warnings, memory).image;
    }
    if (is_hdr(bytes)) {
        return read_hdr(bytes, limits, warnings, memory);
    }
    if (is_tiff(bytes)) {
        return read_tiff(bytes, limits, memory);
    }
    if (is_display_image(bytes)) {
        warnings.add("nothing in it is brighter than white (--env-intensity scales it)",
                     "an image for screens");
        return read_display_image(bytes, limits, warnings, memory);
    }
    const auto kind = other_kind(bytes);
    throw Error(ErrorCode::unsupported,
                fmt::format("neither OpenEXR, Radiance HDR, TIFF, PNG, JPEG nor WebP{}",
                            kind ? fmt::format(", but {}", *kind) : std::string()));
}

LoadedEnvironment load(const std::filesystem::path& file, const ReadLimits& limits,
                       MemoryBudget* memory)
{
    const auto worth = [&](ByteView start) {
        const bool known =
            is_exr(start) || is_hdr(start) || is_tiff(start) || is_display_image(start);
        return known ? limits.file_bytes : start.size();
    };
    const Bytes bytes = read_named(file, limits.file_bytes, worth, memory);
    Warnings warnings;
    LoadedEnvironment loaded;
    loaded.light.radiance = read_any(bytes, limits, warnings, memory);
    if (memory != nullptr) {
        const std::uint64_t pixels = loaded.light.radiance.pixels.size();
        memory->spend("the environment", pixels * environment_pixel);
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

LoadedEnvironment load_environment(const std::filesystem::path& file, const ReadLimits& limits,
                                   MemoryBudget* memory)
{
    return with_named_errors(file, [&] { return load(file, limits, memory); });
}

}  // namespace bdpt::io
