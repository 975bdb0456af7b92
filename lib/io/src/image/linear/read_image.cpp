#include <bdpt/io/read_image.h>

#include <bdpt/error.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "file/load_context.h"
#include "file/messages.h"
#include "file/read_file.h"
#include "image/linear/image_readers.h"

namespace bdpt::io {

namespace {

LoadedImage load(const std::filesystem::path& file, const ImageOptions& options)
{
    const Bytes bytes = read_named(file, options.limits.file_bytes, [&](ByteView start) {
        const bool known = is_exr(start) || is_hdr(start) || is_display_image(start);
        return known ? options.limits.file_bytes : start.size();
    });
    Warnings warnings;
    if (is_exr(bytes)) {
        ExrImage exr_image = read_exr(bytes, options.layer, options.limits, warnings);
        return {.image = std::move(exr_image.image),
                .filled = exr_image.filled,
                .warnings = warnings.lines(),
                .attributes = std::move(exr_image.attributes)};
    }
    const bool for_screens = is_display_image(bytes);
    if (!for_screens && !is_hdr(bytes)) {
        throw Error(ErrorCode::unsupported, "neither OpenEXR, Radiance HDR, PNG, JPEG nor WebP");
    }
    if (options.layer) {
        throw Error(ErrorCode::not_found,
                    "no layer \"" + *options.layer + "\": only OpenEXR files have them");
    }
    Image image = for_screens ? read_display_image(bytes, options.limits, warnings)
                              : read_hdr(bytes, options.limits, warnings);
    const PixelRect whole{.x0 = 0, .y0 = 0, .x1 = image.width, .y1 = image.height};
    return {.image = std::move(image), .filled = whole, .warnings = warnings.lines()};
}

}  // namespace

LoadedImage read_image(const std::filesystem::path& file, const ImageOptions& options)
{
    return with_named_errors(file, [&] { return load(file, options); });
}

TexelImage read_texels(const std::filesystem::path& file, const ReadLimits& limits)
{
    return with_named_errors(file, [&] {
        const Bytes bytes = read_named(file, limits.file_bytes);
        return with_library_errors(ErrorCode::invalid_input, "",
                                   [&] { return decode_texels(bytes, limits).image; });
    });
}

namespace {

std::uint64_t count_pixels(int width, int height)
{
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

/// The greatest values of texels [nit]. Converters leave infinity where a sun overflowed.
constexpr float greatest_half = 65504.0f;
constexpr float greatest_float =
    0x1p42f;  // more is beyond what a film sums (`ExactSum::max_value`)

/// Makes the pixels of row `y` finite and non-negative. Infinite ones become `greatest`.
void mend_row(std::span<Rgb> row, int y, float greatest, Warnings& warnings)
{
    for (std::size_t x = 0; x < row.size(); ++x) {
        for (int c = 0; c < 3; ++c) {
            float& value = row[x][c];
            if (std::isfinite(value) && value >= 0.0f) {
                continue;
            }
            const bool overflowed = value > 0.0f;
            warnings.add(overflowed ? fmt::format("infinite values are treated as {:.5g}", greatest)
                                    : "negative and NaN values are treated as 0",
                         fmt::format("pixel ({}, {}): {}", x, y, value));
            value = overflowed ? greatest : 0.0f;
        }
    }
}

/// The result of reading; nullopt if the image has to be read as floats.
struct CompactEnvironment {
    std::optional<EnvironmentImage> image;
    Warnings warnings;
};

/// Reads a file whose texels are compact row by row, without an image of floats, which would take
/// twice their memory.
CompactEnvironment read_compact(ByteView bytes, const ReadLimits& limits,
                                const MemoryBudget* memory)
{
    CompactEnvironment result;
    std::optional<EnvironmentImageBuilder> builder;
    int y = 0;
    const RowSink sink{.begin =
                           [&](int width, int height) {
                               if (memory != nullptr) {
                                   memory->check("the environment", count_pixels(width, height) *
                                                                        compact_environment_pixel);
                               }
                               builder.emplace(width, height);
                           },
                       .add =
                           [&](std::span<Rgb> row) {
                               mend_row(row, y++, greatest_half, result.warnings);
                               return builder->add_row(row);
                           }};
    const bool complete = is_exr(bytes) ? read_half_exr_rows(bytes, limits, result.warnings, sink)
                                        : is_hdr(bytes) && read_hdr_rows(bytes, limits, sink);
    if (complete) {
        result.image = builder->finish();
    }
    return result;
}

/// An image, and the greatest value of its texels.
struct FloatImage {
    Image image;
    float greatest = greatest_float;
};

FloatImage read_any(ByteView bytes, const ReadLimits& limits, Warnings& warnings,
                    const MemoryBudget* memory)
{
    if (is_exr(bytes)) {
        ExrImage exr = read_exr(bytes, std::nullopt, limits, warnings, memory);
        return {std::move(exr.image), exr.halves ? greatest_half : greatest_float};
    }
    if (is_hdr(bytes)) {
        return {read_hdr(bytes, limits, warnings, memory)};
    }
    if (is_tiff(bytes)) {
        return {read_tiff(bytes, limits, memory)};
    }
    if (is_display_image(bytes)) {
        warnings.add("nothing in it is brighter than white (--env-intensity scales it)",
                     "an image for screens");
        return {read_display_image(bytes, limits, warnings, memory)};
    }
    const auto kind = other_kind(bytes);
    throw Error(ErrorCode::unsupported,
                fmt::format("neither OpenEXR, Radiance HDR, TIFF, PNG, JPEG nor WebP{}",
                            kind ? fmt::format(", but {}", *kind) : std::string()));
}

Image read_floats(ByteView bytes, const ReadLimits& limits, Warnings& warnings,
                  const MemoryBudget* memory)
{
    FloatImage read = read_any(bytes, limits, warnings, memory);
    Image& image = read.image;
    const auto width = static_cast<std::size_t>(image.width);
    for (int y = 0; y < image.height; ++y) {
        mend_row(std::span(image.pixels).subspan(static_cast<std::size_t>(y) * width, width), y,
                 read.greatest, warnings);
    }
    return std::move(image);
}

LoadedEnvironment load(const std::filesystem::path& file, const EnvironmentOptions& options)
{
    const ReadLimits& limits = options.limits;
    MemoryBudget* const memory = options.memory;
    const auto worth = [&](ByteView start) {
        const bool known =
            is_exr(start) || is_hdr(start) || is_tiff(start) || is_display_image(start);
        return known ? limits.file_bytes : start.size();
    };
    const Bytes bytes = read_named(file, limits.file_bytes, worth, memory);
    auto [compact, warnings] = read_compact(bytes, limits, memory);
    LoadedEnvironment loaded;
    if (compact) {
        loaded.light.radiance = *std::move(compact);
    } else {
        warnings = {};
        loaded.light.radiance = read_floats(bytes, limits, warnings, memory);
    }
    const EnvironmentImage& image = loaded.light.radiance;
    if (memory != nullptr) {
        memory->spend("the environment",
                      count_pixels(image.width(), image.height()) *
                          (compact ? compact_environment_pixel : environment_pixel));
    }
    if (image.width() != 2 * image.height() && image.width() * image.height() != 1) {
        warnings.add("an equirectangular image should be twice as wide as high",
                     fmt::format("{} x {} pixels", image.width(), image.height()));
    }
    if (options.strict) {
        warnings.refuse_harm();
    }
    loaded.warnings = warnings.lines();
    return loaded;
}

}  // namespace

LoadedEnvironment load_environment(const std::filesystem::path& file,
                                   const EnvironmentOptions& options)
{
    return with_named_errors(file, [&] { return load(file, options); });
}

}  // namespace bdpt::io
