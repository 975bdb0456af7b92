#include "image/linear/oiio_library.h"

#include <bdpt/error.h>

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace bdpt::io {

namespace {

constexpr const char* module_name = "libbdpt_oiio.so";

/// The folder of the program or library that holds this code.
std::filesystem::path own_folder()
{
    Dl_info info{};
    if (dladdr(reinterpret_cast<const void*>(&own_folder), &info) == 0 ||
        info.dli_fname == nullptr) {
        return {};
    }
    std::error_code error;
    // For a program it may be the word it was called by, so ask the system.
    const std::filesystem::path named = std::filesystem::weakly_canonical(info.dli_fname, error);
    if (!error && std::filesystem::exists(named, error)) {
        return named.parent_path();
    }
    return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

/// Where the module may be, the most likely place first.
std::vector<std::filesystem::path> candidates()
{
    const std::filesystem::path here = own_folder();
    std::vector<std::filesystem::path> files;
    for (const char* folder : {BDPT_OIIO_FOLDERS}) {
        files.push_back(here / folder / module_name);  // `folder` alone where it is absolute
    }
    return files;
}

void* load_module()
{
    std::string tried;
    for (const std::filesystem::path& file : candidates()) {
        std::error_code error;
        if (!std::filesystem::exists(file, error)) {
            tried += (tried.empty() ? "" : ", ") + file.lexically_normal().string();
            continue;
        }
        // It stays: OpenImageIO cannot be unloaded safely.
        void* module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
        if (module == nullptr) {
            throw Error(ErrorCode::unsupported,
                        fmt::format("{} cannot be loaded: {}", file.string(), dlerror()));
        }
        return module;
    }
    throw Error(ErrorCode::unsupported,
                fmt::format("{} is not there (tried {})", module_name, tried));
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

using Message = std::array<char, 512>;

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
    Message message{};
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
    Message message{};
    if (functions_.read_floats(image_.get(), values, message.data(), message.size()) == 0) {
        throw std::runtime_error(message.data());
    }
}

}  // namespace bdpt::io
