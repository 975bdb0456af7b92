#include <bdpt/error.h>
#include <bdpt/io/environment.h>

#include "file/read_file.h"
#include "file/warnings.h"
#include "image/exr_reader.h"
#include "image/oiio_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <string_view>

namespace bdpt::io {

namespace {

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

/// Light is finite and not negative.
void mend_pixels(Image& image, Warnings& warnings)
{
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            float& value = image.pixels[i][c];
            if (std::isfinite(value) && value >= 0.0f) {
                continue;
            }
            const auto width = static_cast<std::size_t>(image.width);
            warnings.add("negative, infinite and NaN values are taken as 0",
                         fmt::format("pixel ({}, {}): {}", i % width, i / width, value));
            value = 0.0f;
        }
    }
}

LoadedEnvironment load(const std::filesystem::path& file, const ReadLimits& limits)
{
    const Bytes bytes = read_file(file, limits.file_bytes);
    Warnings warnings;
    LoadedEnvironment loaded;
    if (is_exr(bytes)) {
        loaded.light.radiance = read_exr(bytes, limits, warnings);
    } else if (is_hdr(bytes)) {
        loaded.light.radiance = read_hdr(bytes, limits);
    } else {
        throw Error(ErrorCode::unsupported, "neither OpenEXR nor Radiance HDR");
    }
    mend_pixels(loaded.light.radiance, warnings);
    const Image& image = loaded.light.radiance;
    if (image.width != 2 * image.height && image.width * image.height != 1) {
        warnings.add("an equirectangular picture should be twice as wide as high",
                     fmt::format("{} x {} pixels", image.width, image.height));
    }
    loaded.warnings = warnings.lines();
    return loaded;
}

}  // namespace

LoadedEnvironment load_environment(const std::filesystem::path& file, const ReadLimits& limits)
{
    const std::string prefix = file.string() + ": ";
    try {
        return load(file, limits);
    } catch (const Error& error) {
        throw Error(error.code(), prefix + error.what());
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::out_of_memory, prefix + "not enough memory");
    } catch (const std::exception& error) {
        throw Error(ErrorCode::internal, prefix + error.what());
    }
}

}  // namespace bdpt::io
