#pragma once

/// @file
/// Packs images for pages of HTML.
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
#include <vector>

namespace bdpt::eval {

/// Red, green and blue with 9 bits each and one exponent of 5 bits for all three
/// [EXT_texture_shared_exponent]: the greatest component keeps a relative error of 2^-9. `rgb` is
/// clamped to [0, 65408]; NaN is 0.
[[nodiscard]] BDPT_EXPORT std::uint32_t pack_rgb9e5(Rgb rgb);
/// The pixels of `packed`.
[[nodiscard]] BDPT_EXPORT Rgb unpack_rgb9e5(std::uint32_t packed);

/// Pixels for a page: each, times `scale`, as RGB9E5; the lowest bytes of all, then the second
/// lowest ...; compressed [RFC 1950]; as base64 [RFC 4648].
[[nodiscard]] BDPT_EXPORT std::string packed_image(const Image& image, double scale);

/// Bytes, compressed, as base64.
[[nodiscard]] BDPT_EXPORT std::string packed_bytes(std::span<const std::uint8_t> bytes);

/// The power of two that brings light of `mean` [nit] to about 1/4, so that RGB9E5 holds what is up
/// to 2^18 times brighter, and 2^13 times darker with all its bits. 1 for darkness.
[[nodiscard]] BDPT_EXPORT double page_scale(double mean);

}  // namespace bdpt::eval
