#include "fuzz_target.h"
#include "image/encoded_image.h"
#include "image/linear/image_readers.h"
#include "promises.h"

#include <optional>
#include <stdexcept>

using namespace bdpt;
using namespace bdpt::io;

namespace {

void check_size(int width, int height, std::size_t pixels)
{
    fuzz::promise(width > 0 && height > 0 && width <= fuzz::small_limits.image_side &&
                      height <= fuzz::small_limits.image_side,
                  "images keep to their limit");
    fuzz::promise(pixels == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                  "images have as many pixels as they say");
}

void decode(ByteView bytes)
{
    Warnings warnings;
    if (is_exr(bytes)) {
        const Image image = read_exr(bytes, std::nullopt, fuzz::small_limits, warnings).image;
        return check_size(image.width, image.height, image.pixels.size());
    }
    if (is_hdr(bytes)) {
        const Image image = read_hdr(bytes, fuzz::small_limits, warnings);
        return check_size(image.width, image.height, image.pixels.size());
    }
    const TexelImage image = decode_texels(bytes, fuzz::small_limits).image;
    fuzz::promise(image.channels >= 1 && image.channels <= 4, "textures have 1 to 4 channels");
    const std::size_t texel =
        static_cast<std::size_t>(image.channels) * count_value_bytes(image.type);
    fuzz::promise(image.bytes.size() % texel == 0, "textures have whole texels");
    check_size(image.width, image.height, image.bytes.size() / texel);
}

}  // namespace

/// Images of all formats: PNG, JPEG, WebP, OpenEXR and Radiance HDR; of KTX2 the headers.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        decode(ByteView(data, size));
    } catch (const Error& error) {
        fuzz::check_refusal(error);
    } catch (const std::runtime_error&) {
        // A texture that cannot be decoded: the scene does without it.
    }
    return 0;
}
