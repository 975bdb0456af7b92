#pragma once

namespace bdpt {

/// Probability density per unit solid angle [1/sr].
struct SolidAnglePdf {
    float value = 0.0f;
};

/// Probability density per unit area [1/m^2] of a vertex of a path. A vertex at infinity is a point
/// on the unit sphere of directions, so its "area" is a solid angle.
struct AreaPdf {
    float value = 0.0f;
};

/// Probability density per unit area [1/m^2] of the plane perpendicular to the parallel rays of a
/// light at infinity.
struct PlanarPdf {
    float value = 0.0f;
};

/// Returns the only ratio that MIS needs: that of two densities of the same vertex.
[[nodiscard]] constexpr float operator/(AreaPdf a, AreaPdf b)
{
    return a.value / b.value;
}

[[nodiscard]] constexpr AreaPdf operator*(AreaPdf pdf, float probability)
{
    return {pdf.value * probability};
}

[[nodiscard]] constexpr SolidAnglePdf operator*(SolidAnglePdf pdf, float probability)
{
    return {pdf.value * probability};
}

/// Converts a density of directions at one point to area at another: dw = cos dA / d^2 [Veach 1997,
/// sec. 8.2.2.2].
[[nodiscard]] constexpr AreaPdf to_area(SolidAnglePdf pdf, float abs_cos_at_target,
                                        float distance_squared)
{
    return {pdf.value * abs_cos_at_target / distance_squared};
}

/// Converts a density on the plane perpendicular to parallel rays to the surface that they hit.
[[nodiscard]] constexpr AreaPdf to_area(PlanarPdf pdf, float abs_cos_at_target)
{
    return {pdf.value * abs_cos_at_target};
}

}  // namespace bdpt
