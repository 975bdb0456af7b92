#include <bdpt/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "file/read_file.h"
#include "image/linear/image_readers.h"

namespace bdpt::io {
namespace {

/// One of the two axes that the pixels of a Radiance HDR image are stored along.
struct HdrAxis {
    char name = 'X';      ///< X, which points to the right, or Y, which points up
    bool ascends = true;  ///< true: pixels follow each other along the axis; false: against it
    int size = 0;         ///< [pixels], at least 1
};

/// Header of a Radiance HDR image.
struct HdrHeader {
    HdrAxis outer;  ///< from scanline to scanline
    HdrAxis inner;  ///< within a scanline
    /// Factors that red, green and blue have been multiplied by: the product of all EXPOSURE and
    /// COLORCORR lines. Finite and positive.
    std::array<double, 3> exposure{1.0, 1.0, 1.0};
    std::size_t size = 0;  ///< [bytes]

    [[nodiscard]] int width() const { return outer.name == 'X' ? outer.size : inner.size; }
    [[nodiscard]] int height() const { return outer.name == 'Y' ? outer.size : inner.size; }
};

/// Throws an `Error` (invalid_input) about a Radiance HDR image.
[[noreturn]] void fail_hdr(const std::string& what)
{
    throw Error(ErrorCode::invalid_input, "Radiance HDR: " + what);
}

constexpr std::string_view blanks = " \t";

/// Reader of the lines of a header.
class Lines {
public:
    explicit Lines(ByteView file) : file_(file) {}

    std::string_view next()
    {
        const ByteView rest = file_.subspan(size_);
        const auto end = std::find(rest.begin(), rest.end(), '\n');
        if (end == rest.end()) {
            fail_hdr("the file ends within the header");
        }
        const auto length = static_cast<std::size_t>(end - rest.begin());
        size_ += length + 1;
        return {reinterpret_cast<const char*>(rest.data()), length};
    }
    /// Returns the bytes of all lines so far.
    [[nodiscard]] std::size_t size() const { return size_; }

private:
    ByteView file_;
    std::size_t size_ = 0;
};

/// Takes the first word from a text; empty if there is none.
std::string_view take_word(std::string_view& text)
{
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    return word;
}

template <typename Number>
std::optional<Number> parse_number(std::string_view word)
{
    Number number{};
    const char* const end = word.data() + word.size();
    const auto [stopped, error] = std::from_chars(word.data(), end, number);
    return error == std::errc() && stopped == end ? std::optional(number) : std::nullopt;
}

/// Returns the rest of a line that begins with `name`.
std::optional<std::string_view> find_value(std::string_view line, std::string_view name)
{
    return line.starts_with(name) ? std::optional(line.substr(name.size())) : std::nullopt;
}

void check_format(std::string_view line, std::string_view value)
{
    if (take_word(value) != "32-bit_rle_rgbe" || !take_word(value).empty()) {
        throw Error(ErrorCode::unsupported,
                    fmt::format("Radiance HDR: {}: only pixels of the format 32-bit_rle_rgbe are "
                                "read",
                                quote(line)));
    }
}

/// Multiplies exposures by the `count` factors of a line, all positive.
void expose(std::array<double, 3>& exposure, std::string_view line, std::string_view values,
            std::size_t count)
{
    for (std::size_t c = 0; c < 3; ++c) {
        std::string_view rest = values;
        std::string_view word = take_word(rest);
        for (std::size_t i = 0; i < std::min(c, count - 1); ++i) {
            word = take_word(rest);
        }
        const std::optional<double> factor = parse_number<double>(word);
        exposure[c] *= factor.value_or(0.0);
        if (!(exposure[c] > 0.0) || !std::isfinite(exposure[c])) {
            fail_hdr(quote(line) + ": not positive and finite");
        }
    }
}

/// Parses "-Y" or the like, and a number of pixels.
std::optional<HdrAxis> take_axis(std::string_view& text)
{
    const std::string_view name = take_word(text);
    const std::optional<int> size = parse_number<int>(take_word(text));
    if (name != "-Y" && name != "+Y" && name != "-X" && name != "+X") {
        return std::nullopt;
    }
    if (!size || *size < 1) {
        return std::nullopt;
    }
    return HdrAxis{.name = name[1], .ascends = name[0] == '+', .size = *size};
}

void read_resolution(HdrHeader& header, std::string_view line)
{
    std::string_view rest = line;
    const std::optional<HdrAxis> outer = take_axis(rest);
    const std::optional<HdrAxis> inner = take_axis(rest);
    if (!outer || !inner || outer->name == inner->name || !take_word(rest).empty()) {
        fail_hdr(fmt::format("resolution {}, not such as \"-Y 512 +X 1024\"", quote(line)));
    }
    header.outer = *outer;
    header.inner = *inner;
}

}  // namespace

/// Reads the header [Ward, "The RADIANCE Picture File Format", in the Radiance Reference Manual].
/// Lines that change no pixel are ignored, PRIMARIES and GAMMA among them. Throws `Error`:
/// invalid_input (broken), unsupported (pixels other than 32-bit_rle_rgbe).
HdrHeader read_hdr_header(ByteView file)
{
    HdrHeader header;
    Lines lines(file);
    bool has_format = false;
    for (std::string_view line = lines.next(); !line.empty(); line = lines.next()) {
        if (const auto format = find_value(line, "FORMAT=")) {
            check_format(line, *format);
            has_format = true;
        } else if (const auto factor = find_value(line, "EXPOSURE=")) {
            expose(header.exposure, line, *factor, 1);
        } else if (const auto factors = find_value(line, "COLORCORR=")) {
            expose(header.exposure, line, *factors, 3);
        }
    }
    if (!has_format) {
        fail_hdr("the header has no line FORMAT=32-bit_rle_rgbe");
    }
    read_resolution(header, lines.next());
    header.size = lines.size();
    return header;
}

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
    return begins_with(file, "#?RADIANCE") || begins_with(file, "#?RGBE");
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
