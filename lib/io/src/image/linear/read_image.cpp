#include <bdpt/error.h>
#include <bdpt/io/read_image.h>

#include "file/named_errors.h"
#include "file/standard_input.h"
#include "file/warnings.h"
#include "image/linear/display_reader.h"
#include "image/linear/exr_reader.h"
#include "image/linear/hdr_reader.h"

#include <utility>

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

}  // namespace bdpt::io
