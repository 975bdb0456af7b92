#include "ies/ies_numbers.h"

#include "file/uri.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

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

}  // namespace bdpt::io
