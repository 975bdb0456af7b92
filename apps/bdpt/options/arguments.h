#pragma once

#include <bdpt/types.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace bdpt::app {

/// An image's size [pixels].
struct Size {
    int width = 0;
    int height = 0;
};

/// ASCII letters as small ones.
[[nodiscard]] std::string lower_case(std::string_view text);

/// "1280x720", or "512" of a square; both at least 1 and at most 65535.
[[nodiscard]] std::optional<Size> parse_size(std::string_view text);

/// "90", "90s", "2m", "1.5h" or "1h30m", as seconds; more than 0.
[[nodiscard]] std::optional<double> parse_duration(std::string_view text);

/// "1500000", "800K", "500M" or "2.5G", as bytes, by powers of 1024; at least 1 and below 2^63.
[[nodiscard]] std::optional<std::uint64_t> parse_bytes(std::string_view text);

/// "2%", "2" or "0.02": numbers from 1 are percent, too. Above 0 and at most 1.
[[nodiscard]] std::optional<double> parse_share(std::string_view text);

/// "x,y,z", all finite.
[[nodiscard]] std::optional<Vec3> parse_vec3(std::string_view text);

/// A finite number.
[[nodiscard]] std::optional<float> parse_float(std::string_view text);

/// The same with more digits.
[[nodiscard]] std::optional<double> parse_double(std::string_view text);

/// Only digits: an index.
[[nodiscard]] std::optional<std::size_t> parse_index(std::string_view text);

}  // namespace bdpt::app
