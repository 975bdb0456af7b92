#include "image/hdr_reader.h"

#include "image/image_size.h"
#include "image/oiio_library.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

bool is_hdr(ByteView file)
{
    const auto starts_with = [file](std::string_view magic) {
        return file.size() >= magic.size() && std::equal(magic.begin(), magic.end(), file.begin());
    };
    return starts_with("#?RADIANCE") || starts_with("#?RGBE");
}

Image read_hdr(ByteView file, const ReadLimits& limits)
{
    try {
        const OiioImage oiio_image = OiioLibrary().open("hdr", file);
        const BdptImageHeader& header = oiio_image.header();
        if (header.channels < 3) {
            throw std::runtime_error(fmt::format("{} channels", header.channels));
        }
        const auto channels = static_cast<std::size_t>(header.channels);
        check_image_size(header.width, header.height, channels * sizeof(float), file.size(),
                         limits);
        std::vector<float> values(oiio_image.value_count());
        oiio_image.read(values.data());
        Image image{header.width, header.height, {}};
        image.pixels.reserve(values.size() / channels);
        for (std::size_t i = 0; i + 2 < values.size(); i += channels) {
            image.pixels.emplace_back(values[i], values[i + 1], values[i + 2]);
        }
        return image;
    } catch (const Error&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Error(ErrorCode::invalid_input, std::string("Radiance HDR: ") + error.what());
    }
}

}  // namespace bdpt::io
