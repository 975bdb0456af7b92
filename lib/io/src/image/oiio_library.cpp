#include "image/oiio_library.h"

#include "file/read_file.h"

#include <bdpt/error.h>

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <type_traits>

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
            throw Error(ErrorCode::internal,
                        fmt::format("{} cannot be loaded: {}", file.string(), dlerror()));
        }
        return module;
    }
    throw Error(ErrorCode::internal,
                fmt::format("pictures cannot be read: no {} (tried {})", module_name, tried));
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
    open_ = find_function<decltype(open_)>(module, "bdpt_oiio_open");
    read_bytes_ = find_function<decltype(read_bytes_)>(module, "bdpt_oiio_read_bytes");
    read_floats_ = find_function<decltype(read_floats_)>(module, "bdpt_oiio_read_floats");
    close_ = find_function<decltype(close_)>(module, "bdpt_oiio_close");
}

template <typename T>
RawPicture<T> OiioLibrary::decode(const char* format, ByteView bytes,
                                  const ReadLimits& limits) const
{
    std::array<char, 512> message{};
    BdptPictureHeader header{};
    const std::unique_ptr<BdptPicture, decltype(close_)> picture(
        open_(format, bytes.data(), bytes.size(), &header, message.data(), message.size()), close_);
    if (!picture) {
        throw std::runtime_error(message.data());
    }
    if (header.width < 1 || header.height < 1 || header.channels < 1 || header.channels > 64) {
        throw std::runtime_error(fmt::format("{} x {} pixels with {} channels", header.width,
                                             header.height, header.channels));
    }
    const auto channels = static_cast<std::uint64_t>(header.channels);
    check_picture_size(header.width, header.height, channels * sizeof(T), bytes.size(), limits);
    RawPicture<T> raw{header.width, header.height, header.channels, header.alpha_channel, {}};
    raw.values.resize(static_cast<std::size_t>(header.width) *
                      static_cast<std::size_t>(header.height) *
                      static_cast<std::size_t>(header.channels));
    int success = 0;
    if constexpr (std::is_same_v<T, float>) {
        success = read_floats_(picture.get(), raw.values.data(), message.data(), message.size());
    } else {
        success = read_bytes_(picture.get(), raw.values.data(), message.data(), message.size());
    }
    if (success == 0) {
        throw std::runtime_error(message.data());
    }
    return raw;
}

template RawPicture<std::uint8_t> OiioLibrary::decode<std::uint8_t>(const char*, ByteView,
                                                                    const ReadLimits&) const;
template RawPicture<float> OiioLibrary::decode<float>(const char*, ByteView,
                                                      const ReadLimits&) const;

void check_picture_size(int width, int height, std::uint64_t bytes_per_pixel, std::uint64_t encoded,
                        const ReadLimits& limits)
{
    // Small pictures of one colour are packed a thousandfold in good faith.
    constexpr std::uint64_t harmless = std::uint64_t{64} << 20;
    if (width > limits.image_side || height > limits.image_side) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("picture of {} x {} pixels, but the limit is {} a side", width,
                                height, limits.image_side));
    }
    const std::uint64_t decoded =
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * bytes_per_pixel;
    if (decoded > limits.image_bytes) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("picture of {} x {} pixels needs {}, but the limit is {}", width,
                                height, human_bytes(static_cast<long double>(decoded)),
                                human_bytes(static_cast<long double>(limits.image_bytes))));
    }
    if (decoded > harmless && decoded / limits.compression_ratio > encoded) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("picture of {} x {} pixels in {} bytes: more than {} times packed",
                                width, height, encoded, limits.compression_ratio));
    }
}

}  // namespace bdpt::io
