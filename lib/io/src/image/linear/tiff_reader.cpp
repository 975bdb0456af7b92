#include "image/linear/tiff_reader.h"

#include "image/image_size.h"
#include "image/linear/oiio_library.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

namespace {

using namespace std::string_view_literals;

OiioLibrary open_library()
{
    try {
        return OiioLibrary();
    } catch (const Error& error) {
        throw Error(error.code(),
                    fmt::format("TIFF images are read by OpenImageIO: {}; OpenEXR and Radiance HDR "
                                "images are read without it",
                                error.what()));
    }
}

/// Checks the header before memory is allocated, by this code and by OpenImageIO, which allocates a
/// tile.
void check_header(const BdptImageHeader& header, const ReadLimits& limits,
                  const MemoryBudget* memory)
{
    const auto refuse = [](const std::string& what) {
        throw Error(ErrorCode::unsupported, "TIFF: " + what);
    };
    if (header.has_floats == 0) {
        refuse("integers, but only floats are taken as linear light");
    }
    if (header.orientation != 1) {
        refuse(fmt::format("orientation {}, but only 1 (upright) is read", header.orientation));
    }
    const std::uint64_t channels = static_cast<std::uint64_t>(header.channels);
    const std::uint64_t pixel = std::max<std::uint64_t>(sizeof(Rgb), channels * sizeof(float));
    check_image_size(header.width, header.height, pixel, limits, memory);
    check_image_size(header.tile_width, header.tile_height, pixel, limits, memory);
}

}  // namespace

bool is_tiff(ByteView file)
{
    // Either byte order; the last two are BigTIFF.
    constexpr std::array starts{"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv};
    return std::any_of(starts.begin(), starts.end(), [file](std::string_view start) {
        return file.size() >= start.size() && std::equal(start.begin(), start.end(), file.begin());
    });
}

Image read_tiff(ByteView file, const ReadLimits& limits, const MemoryBudget* memory)
{
    const OiioLibrary library = open_library();
    try {
        const OiioImage tiff = library.open("tiff", file);
        const BdptImageHeader& header = tiff.header();
        check_header(header, limits, memory);
        std::vector<float> values(tiff.value_count());
        tiff.read(values.data());
        Image image{header.width, header.height, {}};
        const auto channels = static_cast<std::size_t>(header.channels);
        const std::size_t green = channels < 3 ? 0 : 1;
        image.pixels.reserve(values.size() / channels);
        for (std::size_t i = 0; i < values.size(); i += channels) {
            image.pixels.emplace_back(values[i], values[i + green], values[i + 2 * green]);
        }
        return image;
    } catch (const Error&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Error(ErrorCode::invalid_input, std::string("TIFF: ") + error.what());
    }
}

}  // namespace bdpt::io
