#include <bdpt/error.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "file/read_file.h"
#include "image/linear/image_readers.h"

namespace bdpt::io {

namespace {

constexpr const char* module_name = "libbdpt_oiio.so";

void* load_module()
{
    const std::filesystem::path file = companion_file(module_name);
    // The module stays loaded: OpenImageIO cannot be unloaded safely.
    void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (module == nullptr) {
        throw Error(ErrorCode::unsupported,
                    fmt::format("{} cannot be loaded: {}", file.string(), dlerror()));
    }
    return module;
}

template <typename Function>
Function find_function(void* module, const char* name)
{
    void* const address = dlsym(module, name);
    if (address == nullptr) {
        throw Error(ErrorCode::internal, fmt::format("{} lacks {}", module_name, name));
    }
    return reinterpret_cast<Function>(address);
}

using OiioMessage = std::array<char, 512>;

}  // namespace

OiioLibrary::OiioLibrary()
{
    void* const module = load_module();
    const auto version = find_function<decltype(&bdpt_oiio_version)>(module, "bdpt_oiio_version");
    if (version() != bdpt_oiio_interface_version) {
        throw Error(ErrorCode::internal,
                    fmt::format("{} has interface version {}, but {} is needed", module_name,
                                version(), bdpt_oiio_interface_version));
    }
    functions_.open = find_function<decltype(&bdpt_oiio_open)>(module, "bdpt_oiio_open");
    functions_.read_floats =
        find_function<decltype(&bdpt_oiio_read_floats)>(module, "bdpt_oiio_read_floats");
    functions_.close = find_function<decltype(&bdpt_oiio_close)>(module, "bdpt_oiio_close");
}

OiioImage OiioLibrary::open(const char* format, ByteView bytes) const
{
    return {functions_, format, bytes};
}

OiioImage::OiioImage(const Functions& functions, const char* format, ByteView bytes)
    : functions_(functions), image_(nullptr, functions.close)
{
    OiioMessage message{};
    image_.reset(functions_.open(format, bytes.data(), bytes.size(), &header_, message.data(),
                                 message.size()));
    if (!image_) {
        throw std::runtime_error(message.data());
    }
    if (header_.width < 1 || header_.height < 1 || header_.channels < 1 || header_.channels > 64) {
        throw std::runtime_error(fmt::format("{} x {} pixels with {} channels", header_.width,
                                             header_.height, header_.channels));
    }
}

std::size_t OiioImage::value_count() const
{
    return static_cast<std::size_t>(header_.width) * static_cast<std::size_t>(header_.height) *
           static_cast<std::size_t>(header_.channels);
}

void OiioImage::read(float* values) const
{
    OiioMessage message{};
    if (functions_.read_floats(image_.get(), values, message.data(), message.size()) == 0) {
        throw std::runtime_error(message.data());
    }
}

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
    return std::any_of(starts.begin(), starts.end(),
                       [file](std::string_view start) { return begins_with(file, start); });
}

Image read_tiff(ByteView file, const ReadLimits& limits, const MemoryBudget* memory)
{
    const OiioLibrary library = open_library();
    return with_library_errors(ErrorCode::invalid_input, "TIFF: ", [&] {
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
    });
}

}  // namespace bdpt::io
