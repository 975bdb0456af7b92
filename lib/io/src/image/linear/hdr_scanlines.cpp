#include "image/linear/hdr_scanlines.h"

#include "image/linear/hdr_header.h"

#include <fmt/format.h>

#include <algorithm>

namespace bdpt::io {

namespace {

/// Tests whether a scanline of `length` pixels is in the newer encoding. No pixel begins like this,
/// as one of its mantissas is at least 128.
bool has_mark(ByteView bytes, std::size_t length)
{
    return length >= 8 && length <= 32767 && bytes.size() >= 4 && bytes[0] == 2 && bytes[1] == 2 &&
           bytes[2] < 128;
}

}  // namespace

void HdrScanlines::read(std::span<Rgbe> line)
{
    ++number_;
    if (has_mark(rest_, line.size())) {
        read_by_components(line);
    } else {
        read_by_pixels(line);
    }
}

void HdrScanlines::fail(const char* what) const
{
    fail_hdr(fmt::format("scanline {}: {}", number_, what));
}

std::uint8_t HdrScanlines::take()
{
    if (rest_.empty()) {
        fail("the file ends too early");
    }
    const std::uint8_t byte = rest_.front();
    rest_ = rest_.subspan(1);
    return byte;
}

Rgbe HdrScanlines::take_pixel()
{
    if (rest_.size() < 4) {
        fail("the file ends too early");
    }
    const Rgbe pixel{rest_[0], rest_[1], rest_[2], rest_[3]};
    rest_ = rest_.subspan(4);
    return pixel;
}

/// Reads the older encoding: three mantissas of 1 give the number of repetitions of the previous
/// pixel. Consecutive counts are digits of base 256, the lowest first.
void HdrScanlines::read_by_pixels(std::span<Rgbe> line)
{
    unsigned shift = 0;
    for (std::size_t i = 0; i < line.size();) {
        const Rgbe pixel = take_pixel();
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            line[i++] = pixel;
            shift = 0;
            continue;
        }
        // While counts are read, no line has more than 2^31 pixels.
        const std::size_t count = shift < 32 ? std::size_t{pixel[3]} << shift : line.size() + 1;
        if (i == 0 || count > line.size() - i) {
            fail(i == 0 ? "begins with a repetition" : "a run goes past its end");
        }
        std::fill_n(line.begin() + static_cast<std::ptrdiff_t>(i), count, line[i - 1]);
        i += count;
        shift += 8;
    }
}

/// Reads the newer encoding: a mark and the length, then each component by itself.
void HdrScanlines::read_by_components(std::span<Rgbe> line)
{
    const Rgbe mark = take_pixel();
    if ((std::size_t{mark[2]} << 8U | mark[3]) != line.size()) {
        fail("has another length than the image");
    }
    for (std::size_t component = 0; component < 4; ++component) {
        read_component(line, component);
    }
}

/// Reads runs of one value, marked by 128, and single values.
void HdrScanlines::read_component(std::span<Rgbe> line, std::size_t component)
{
    for (std::size_t i = 0; i < line.size();) {
        const std::uint8_t code = take();
        const bool is_run = code > 128;
        const std::size_t count = is_run ? code - 128U : code;
        if (count == 0 || count > line.size() - i) {
            fail(count == 0 ? "an empty run" : "a run goes past its end");
        }
        const std::uint8_t value = is_run ? take() : std::uint8_t{0};
        for (const std::size_t end = i + count; i < end; ++i) {
            line[i][component] = is_run ? value : take();
        }
    }
}

}  // namespace bdpt::io
