#include "image/linear/hdr_header.h"

#include "file/uri.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

namespace bdpt::io {

namespace {

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

void fail_hdr(const std::string& what)
{
    throw Error(ErrorCode::invalid_input, "Radiance HDR: " + what);
}

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

}  // namespace bdpt::io
