#pragma once

#include <bdpt/types.h>

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace bdpt::app {

/// Size of an image [pixels].
struct Size {
    int width = 0;
    int height = 0;
};

/// Converts ASCII letters to lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

/// Splits `text` at each `separator`; parts may be empty.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// Parses all of `text` as one number in decimal digits, which may be infinite.
template <typename Number>
[[nodiscard]] std::optional<Number> parse_number(std::string_view text)
{
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

/// Parses "1280x720", or "512" for a square; both at least 1 and at most 65535.
[[nodiscard]] std::optional<Size> parse_size(std::string_view text);

/// Parses "90", "90s", "2m", "1.5h" or "1h30m", as seconds; more than 0.
[[nodiscard]] std::optional<double> parse_duration(std::string_view text);

/// Parses "1500000", "800K", "500M" or "2.5G", as bytes, by powers of 1024; at least 1 and below
/// 2^63.
[[nodiscard]] std::optional<std::uint64_t> parse_bytes(std::string_view text);

/// Parses "2%", "2" or "0.02" as a fraction: numbers from 1 are percent, too. Above 0 and at most
/// 1.
[[nodiscard]] std::optional<double> parse_share(std::string_view text);

/// Parses "x,y,z", all finite.
[[nodiscard]] std::optional<Vec3> parse_vec3(std::string_view text);
/// The same in double precision, if single precision can hold it, too.
[[nodiscard]] std::optional<DVec3> parse_dvec3(std::string_view text);

/// Parses a finite number.
[[nodiscard]] std::optional<float> parse_float(std::string_view text);

/// Parses a finite number in double precision.
[[nodiscard]] std::optional<double> parse_double(std::string_view text);

/// Parses an index: digits only.
[[nodiscard]] std::optional<std::size_t> parse_index(std::string_view text);

/// Network address of an image viewer.
struct DisplayAddress {
    std::string host;
    std::string port;
    [[nodiscard]] bool operator==(const DisplayAddress&) const = default;
};

/// Parses "HOST", "HOST:PORT", ":PORT" (this machine) or "[IPV6]:PORT". The default port is 14158,
/// that of tev.
[[nodiscard]] std::optional<DisplayAddress> parse_address(const std::string& text);

}  // namespace bdpt::app
