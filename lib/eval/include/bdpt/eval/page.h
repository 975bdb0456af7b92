#pragma once

/// @file
/// Fills pages of HTML with texts, numbers and images.
///
/// @code{.cpp}
/// const std::string data = bdpt::eval::script_safe(R"({"scene": "room"})");
/// const std::string page =
///     bdpt::eval::fill_page("<script>show({{DATA}}, '{{HEAT}}')</script>",
///                           {{"DATA", data}, {"HEAT", bdpt::eval::heat_text()}});
/// @endcode
///
/// @code{.cpp}
/// std::string pixels_for_page(const bdpt::Image& image, double mean)
/// {
///     return bdpt::eval::packed_image(image, bdpt::eval::page_scale(mean));
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Building blocks of HTML pages. Their parts that show images, colours and numbers are shared:
// lib/eval/src/report/page.

namespace bdpt::eval {

/// Returns the colours of the heat map from 0 to 1, six hexadecimal digits each.
[[nodiscard]] BDPT_EXPORT std::string heat_text();

/// Escapes JSON so that no HTML parser finds the end of a script in it.
[[nodiscard]] BDPT_EXPORT std::string script_safe(std::string_view json);

/// Replaces each word in double braces in `text` by its value.
[[nodiscard]] BDPT_EXPORT std::string fill_page(
    std::string_view text,
    const std::vector<std::pair<std::string_view, std::string_view>>& values);

/// Packs red, green and blue with 9 bits each and a shared exponent of 5 bits
/// [EXT_texture_shared_exponent]: the greatest component keeps a relative error of 2^-9. `rgb` is
/// clamped to [0, 65408]; NaN is 0.
[[nodiscard]] BDPT_EXPORT std::uint32_t pack_rgb9e5(Rgb rgb);
/// Unpacks a pixel of `pack_rgb9e5`.
[[nodiscard]] BDPT_EXPORT Rgb unpack_rgb9e5(std::uint32_t packed);

/// Encodes pixels for a page: each, times `scale`, as RGB9E5; split into byte planes, lowest bytes
/// first; compressed [RFC 1950]; as base64 [RFC 4648].
[[nodiscard]] BDPT_EXPORT std::string packed_image(const Image& image, double scale);

/// Encodes bytes: compressed, as base64.
[[nodiscard]] BDPT_EXPORT std::string packed_bytes(std::span<const std::uint8_t> bytes);

/// Returns the power of two that scales light of `mean` [nit] to about 1/4, so that RGB9E5 holds up
/// to 2^18 times brighter light, and 2^13 times darker light with all its bits. Returns 1 for
/// darkness.
[[nodiscard]] BDPT_EXPORT double page_scale(double mean);

}  // namespace bdpt::eval
