#include <bdpt/error.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <system_error>

#include "file/read_file.h"
#include "ies/ies.h"

namespace bdpt::io {

namespace {

constexpr std::string_view delimiters = " \t\r\n\v\f,";

}  // namespace

void IesNumbers::skip_delimiters()
{
    const std::size_t count = std::min(rest_.find_first_not_of(delimiters), rest_.size());
    line_ += static_cast<std::size_t>(
        std::count(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(count), '\n'));
    rest_.remove_prefix(count);
}

bool IesNumbers::at_end()
{
    skip_delimiters();
    return rest_.empty();
}

double IesNumbers::next(std::string_view what)
{
    skip_delimiters();
    const std::string_view word = rest_.substr(0, rest_.find_first_of(delimiters));
    if (word.empty()) {
        fail(fmt::format("the file ends before {}", what));
    }
    rest_.remove_prefix(word.size());
    const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
        fail(fmt::format("{} is {}, not a finite number", what, quote(word)));
    }
    return value;
}

long IesNumbers::next_integer(std::string_view what, long least, long most)
{
    const double value = next(what);
    if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most)) ||
        value != std::floor(value)) {
        fail(fmt::format("{} is {}, not an integer from {} to {}", what, value, least, most));
    }
    return static_cast<long>(value);
}

void IesNumbers::fail(const std::string& what) const
{
    throw Error(ErrorCode::invalid_input, fmt::format("line {}: {}", line_, what));
}

namespace {

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r\v\f";
    const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
    text.remove_prefix(begin);
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// Reader of the lines of a text, one after the other.
struct IesLines {
    std::string_view rest;
    std::size_t number = 0;  // number of the last line taken

    std::string_view take()
    {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view line = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        ++number;
        return line;
    }
};

/// Returns the text after `TILT=`, in capitals; empty for other lines.
std::string parse_tilt(std::string_view line)
{
    std::string text;
    for (const char c : line.substr(0, 300)) {
        text.push_back(static_cast<char>(std::toupper(static_cast<unsigned char>(c))));
    }
    if (!text.starts_with("TILT")) {
        return {};
    }
    const std::string_view after = trimmed(std::string_view(text).substr(4));
    return after.starts_with('=') ? std::string(trimmed(after.substr(1))) : std::string();
}

/// Tests whether the number after the ballast factor is the ballast-lamp factor; later versions use
/// its place otherwise.
bool has_ballast_lamp_factor(std::string_view first_line, const std::string& place,
                             Warnings& warnings)
{
    if (first_line.starts_with("IESNA:LM-63-2002") || first_line.starts_with("IES:LM-63-2019")) {
        return false;
    }
    if (!first_line.starts_with("IESNA:LM-63-1995")) {
        warnings.add("a light profile of an unknown or older version is read as of LM-63-95",
                     fmt::format("{}: {}", place, quote(first_line)));
    }
    return true;
}

/// Skips the description of lamps that burn tilted.
void skip_tilt(IesNumbers& numbers)
{
    static_cast<void>(numbers.next("the lamp-to-luminaire geometry"));
    const long pairs = numbers.next_integer("the number of tilt angles", 0, max_ies_values);
    for (long i = 0; i < 2 * pairs; ++i) {
        static_cast<void>(numbers.next("a tilt angle or factor"));
    }
}

std::vector<double> read_angles(IesNumbers& numbers, std::string_view what, long count)
{
    constexpr double min_step = 2e-3;  // [degrees]; no measurement is finer
    std::vector<double> angles;
    for (long i = 0; i < count; ++i) {
        const double angle = numbers.next(fmt::format("{} angle {}", what, i));
        if (!angles.empty() && !(angle >= angles.back() + min_step)) {
            numbers.fail(fmt::format("{} angle {} is {}, not above {} before it", what, i, angle,
                                     angles.back()));
        }
        angles.push_back(angle);
    }
    return angles;
}

double read_factor(IesNumbers& numbers, std::string_view what)
{
    const double factor = numbers.next(what);
    if (!(factor >= 0.0)) {
        numbers.fail(fmt::format("{} is {}, but must not be negative", what, factor));
    }
    return factor;
}

void read_candelas(IesNumbers& numbers, double factor, const std::string& place, Warnings& warnings,
                   IesFile& file)
{
    const std::size_t count = file.vertical_angles.size() * file.horizontal_angles.size();
    file.candelas.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double given = numbers.next("an intensity");
        if (given < 0.0) {
            warnings.add("a negative intensity of a light profile is treated as 0",
                         fmt::format("{}: {} cd", place, given));
        }
        const double value = std::max(given, 0.0) * factor;
        if (!(value <= static_cast<double>(std::numeric_limits<float>::max()))) {
            numbers.fail(fmt::format("an intensity of {} cd is too great", value));
        }
        file.candelas.push_back(static_cast<float>(value));
    }
}

}  // namespace

IesFile read_ies(ByteView bytes, const std::string& place, Warnings& warnings)
{
    if (bytes.size() > max_ies_bytes) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("a light profile of {} bytes, but the limit is {}", bytes.size(),
                                max_ies_bytes));
    }
    const std::string all(bytes.begin(), bytes.end());
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    IesLines lines{.rest = all};
    if (lines.rest.starts_with(byte_order_mark)) {
        lines.rest.remove_prefix(byte_order_mark.size());
    }
    const std::string_view first = lines.take();
    std::string tilt = parse_tilt(first);
    while (tilt.empty() && !lines.rest.empty()) {
        tilt = parse_tilt(lines.take());
    }
    if (tilt.empty()) {
        throw Error(ErrorCode::invalid_input, "no line that begins with TILT=: not an IES file");
    }
    const bool ballast_lamp_factor = has_ballast_lamp_factor(first, place, warnings);
    IesNumbers numbers(lines.rest, lines.number + 1);
    if (tilt != "NONE") {
        warnings.add(WarningKind::loss, "the TILT of a light profile is ignored",
                     fmt::format("{}: {}", place, quote(tilt)));
    }
    if (tilt == "INCLUDE") {
        skip_tilt(numbers);
    }

    IesFile file;
    static_cast<void>(numbers.next("the number of lamps"));
    static_cast<void>(numbers.next("the lumens per lamp"));
    double factor = read_factor(numbers, "the candela multiplier");
    const long vertical = numbers.next_integer("the number of vertical angles", 2, max_ies_values);
    const long horizontal =
        numbers.next_integer("the number of horizontal angles", 1, max_ies_values / vertical);
    file.photometry = static_cast<Photometry>(numbers.next_integer("the photometric type", 1, 3));
    for (const char* what : {"the units type", "the width", "the length", "the height"}) {
        static_cast<void>(numbers.next(what));
    }
    factor *= read_factor(numbers, "the ballast factor");
    const double next_factor = numbers.next("the number after the ballast factor");
    if (ballast_lamp_factor) {
        if (!(next_factor >= 0.0)) {
            numbers.fail(fmt::format("the ballast-lamp factor is {}, but must not be negative",
                                     next_factor));
        }
        factor *= next_factor;
    }
    static_cast<void>(numbers.next("the input watts"));
    file.vertical_angles = read_angles(numbers, "vertical", vertical);
    file.horizontal_angles = read_angles(numbers, "horizontal", horizontal);
    read_candelas(numbers, factor, place, warnings, file);
    if (!numbers.at_end()) {
        warnings.add("data after the intensities of a light profile is ignored", place);
    }
    return file;
}

}  // namespace bdpt::io
