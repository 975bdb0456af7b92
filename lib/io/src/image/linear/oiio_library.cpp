#include "image/linear/oiio_library.h"

#include "file/companion.h"

#include <bdpt/error.h>

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <stdexcept>

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

}  // namespace bdpt::io
