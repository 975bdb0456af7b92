#include "image/hdr_reader.h"

#include "image/oiio_library.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

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
        const RawPicture<float> raw = OiioLibrary().decode<float>("hdr", file, limits);
        if (raw.channels < 3) {
            throw std::runtime_error(fmt::format("{} channels", raw.channels));
        }
        Image image{raw.width, raw.height, {}};
        const auto channels = static_cast<std::size_t>(raw.channels);
        image.pixels.reserve(raw.values.size() / channels);
        for (std::size_t i = 0; i + 2 < raw.values.size(); i += channels) {
            image.pixels.emplace_back(raw.values[i], raw.values[i + 1], raw.values[i + 2]);
        }
        return image;
    } catch (const Error&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Error(ErrorCode::invalid_input, std::string("Radiance HDR: ") + error.what());
    }
}

}  // namespace bdpt::io
