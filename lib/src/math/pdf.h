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

/// Probability density per unit area [1/m^2] of the plane that parallel rays of a light at infinity
/// cross at right angles.
struct PlanarPdf {
    float value = 0.0f;
};

/// The only quotient MIS needs: how much likelier one way of sampling a vertex is than another.
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

/// Change of variables from directions at one point to area at another: dw = cos dA / d^2
/// [Veach 1997, sec. 8.2.2.2].
[[nodiscard]] constexpr AreaPdf to_area(SolidAnglePdf pdf, float abs_cos_at_target,
                                        float distance_squared)
{
    return {pdf.value * abs_cos_at_target / distance_squared};
}

/// From a plane across parallel rays to the surface that they meet.
[[nodiscard]] constexpr AreaPdf to_area(PlanarPdf pdf, float abs_cos_at_target)
{
    return {pdf.value * abs_cos_at_target};
}

}  // namespace bdpt
