#include "image/linear/hdr_reader.h"

#include "image/image_size.h"
#include "image/linear/hdr_header.h"
#include "image/linear/hdr_scanlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

namespace bdpt::io {

namespace {

/// Positions of the pixels along an axis in an image, whose rows begin at the left and at the top.
struct Walk {
    std::ptrdiff_t first = 0;
    std::ptrdiff_t step = 1;
};

Walk walk_along(const HdrAxis& axis, int width)
{
    const std::ptrdiff_t stride = axis.name == 'X' ? 1 : width;
    if (axis.ascends == (axis.name == 'X')) {
        return {.first = 0, .step = stride};
    }
    return {.first = (axis.size - 1) * stride, .step = -stride};
}

Rgb decode_radiance(const Rgbe& pixel, const std::array<double, 3>& exposure)
{
    const double unit = pixel[3] == 0 ? 0.0 : std::ldexp(1.0, pixel[3] - 136);
    Rgb radiance;
    for (int c = 0; c < 3; ++c) {
        const auto component = static_cast<std::size_t>(c);
        radiance[c] = static_cast<float>(pixel[component] * unit / exposure[component]);
    }
    return radiance;
}

void tell_exposure(const std::array<double, 3>& exposure, Warnings& warnings)
{
    const auto [red, green, blue] = exposure;
    if (red != 1.0 || green != 1.0 || blue != 1.0) {
        warnings.add("divided out, which many other programs do not do",
                     red == green && green == blue
                         ? fmt::format("exposure {}", red)
                         : fmt::format("exposures {}, {}, {}", red, green, blue));
    }
}

}  // namespace

bool is_hdr(ByteView file)
{
    const auto starts_with = [file](std::string_view magic) {
        return file.size() >= magic.size() && std::equal(magic.begin(), magic.end(), file.begin());
    };
    return starts_with("#?RADIANCE") || starts_with("#?RGBE");
}

Image read_hdr(ByteView file, const ReadLimits& limits, Warnings& warnings,
               const MemoryBudget* memory)
{
    const HdrHeader header = read_hdr_header(file);
    Image image{header.width(), header.height(), {}};
    check_image_size(image.width, image.height, sizeof(Rgb), limits, memory);
    tell_exposure(header.exposure, warnings);
    image.pixels.resize(static_cast<std::size_t>(image.width) *
                        static_cast<std::size_t>(image.height));
    std::vector<Rgbe> line(static_cast<std::size_t>(header.inner.size));
    HdrScanlines scanlines(file.subspan(header.size));
    const Walk outer = walk_along(header.outer, image.width);
    const Walk inner = walk_along(header.inner, image.width);
    for (std::ptrdiff_t i = 0; i < header.outer.size; ++i) {
        scanlines.read(line);
        std::ptrdiff_t place = outer.first + i * outer.step + inner.first;
        for (const Rgbe& pixel : line) {
            image.pixels[static_cast<std::size_t>(place)] = decode_radiance(pixel, header.exposure);
            place += inner.step;
        }
    }
    return image;
}

bool read_hdr_rows(ByteView file, const ReadLimits& limits, const RowSink& sink)
{
    const HdrHeader header = read_hdr_header(file);
    const bool is_usual = header.outer.name == 'Y' && !header.outer.ascends &&
                          header.inner.ascends && header.exposure == HdrHeader{}.exposure;
    if (!is_usual) {
        return false;
    }
    check_image_size(header.width(), header.height(), sizeof(Rgb), limits);
    sink.begin(header.width(), header.height());
    std::vector<Rgbe> line(static_cast<std::size_t>(header.width()));
    std::vector<Rgb> row(line.size());
    HdrScanlines scanlines(file.subspan(header.size));
    for (int y = 0; y < header.height(); ++y) {
        scanlines.read(line);
        std::transform(line.begin(), line.end(), row.begin(),
                       [&](const Rgbe& pixel) { return decode_radiance(pixel, header.exposure); });
        if (!sink.add(row)) {
            return false;
        }
    }
    return true;
}

}  // namespace bdpt::io
