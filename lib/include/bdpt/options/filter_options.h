#pragma once

/// @file
/// Chooses the pixel filter.
///
/// @code{.cpp}
/// bdpt::RenderOptions options;
/// options.film.filter.kind = bdpt::FilterKind::gaussian;
/// options.film.filter.radius = 2.0f * bdpt::default_radius(bdpt::FilterKind::gaussian);
/// @endcode

#include <cstdint>
#include <optional>

namespace bdpt {

/// Pixel filters: products of one curve in x and one in y, zero beyond the radius. None is
/// negative, so samples can be drawn from the filter itself with equal weights [Ernst et al. 2006,
/// "Filter Importance Sampling"].
enum class FilterKind : std::uint8_t {
    box,              ///< constant
    tent,             ///< linear, 1 at the centre, 0 at the radius
    gaussian,         ///< sigma is a third of the radius; shifted down to 0 at the radius
    blackman_harris,  ///< 4-term window [Harris 1978, table 1]
};

/// A pixel filter.
struct FilterOptions {
    FilterKind kind = FilterKind::box;
    /// Radius [pixels], in [0.01, 16]; nullopt: `default_radius`.
    std::optional<float> radius{};
    [[nodiscard]] bool operator==(const FilterOptions&) const = default;
};

/// Returns the usual radius of a filter [pixels]: 0.5 for the box (the pixel itself), 1 for the
/// tent, 1.5 for the others.
[[nodiscard]] constexpr float default_radius(FilterKind kind)
{
    return kind == FilterKind::box ? 0.5f : kind == FilterKind::tent ? 1.0f : 1.5f;
}

}  // namespace bdpt
