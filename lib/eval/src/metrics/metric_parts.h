#pragma once

#include <bdpt/image.h>
#include <bdpt/types.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace bdpt::eval {

/// An image to measure, with its name for messages.
struct NamedInput {
    std::string name;
    const Image& image;
    /// Position in the whole image [pixels].
    int x0 = 0;
    int y0 = 0;
};

/// Throws `Error` (invalid_input) for an image without pixels, and for one with NaN or infinity,
/// naming the pixel.
void check_image(const NamedInput& input);

/// Throws `Error` (invalid_input) for an image whose size differs from its reference's.
void check_same_size(const NamedInput& input, const NamedInput& reference);

/// Throws as both of these do.
void check_image(const NamedInput& input, const NamedInput& reference);

/// Converts linear sRGB [IEC 61966-2-1] to the opponent space YCxCz [Flohr et al. 1993, Kolpatzik
/// and Bouman 1992]: components are luminance, red-green, blue-yellow. Linear, apart from an
/// offset.
[[nodiscard]] Vec3 opponent_from_linear(Rgb linear);
[[nodiscard]] Rgb linear_from_opponent(Vec3 opponent);

/// Converts linear sRGB in [0, 1] to CIE 1976 L*a*b*.
[[nodiscard]] Vec3 lab_from_linear(Rgb linear);
/// Converts L*a*b* to linear sRGB; outside [0, 1] for colours out of gamut.
[[nodiscard]] Rgb linear_from_lab(Vec3 lab);

/// One value per pixel, row-major.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<float> values;

    Plane(int columns, int rows)
        : width(columns),
          height(rows),
          values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))
    {}
    [[nodiscard]] std::span<float> row(int y) { return {&values[begin(y)], columns()}; }
    [[nodiscard]] std::span<const float> row(int y) const { return {&values[begin(y)], columns()}; }

private:
    [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(width); }
    [[nodiscard]] std::size_t begin(int y) const { return static_cast<std::size_t>(y) * columns(); }
};

/// Weights of the pixels at distances -radius to radius; an odd number of them.
using Kernel = std::vector<float>;

/// Correlates rows with `horizontal` and columns with `vertical`. The border pixels are replicated
/// beyond the border.
[[nodiscard]] Plane convolve(const Plane& plane, const Kernel& horizontal, const Kernel& vertical);

/// The tone curve of HDR-FLIP: a fit of ACES [Narkowicz 2016], whose input is scaled by 0.6
/// [Andersson et al. 2021, sec. 4]. Maps [0, inf) to [0, 1].
struct AcesCurve {
    static constexpr double input_scale = 0.6;
    // (a x^2 + b x) / (c x^2 + d x + e)
    static constexpr double a = 2.51;
    static constexpr double b = 0.03;
    static constexpr double c = 2.43;
    static constexpr double d = 0.59;
    static constexpr double e = 0.14;

    [[nodiscard]] static float apply(double scene_linear)
    {
        const double x = input_scale * std::max(scene_linear, 0.0);
        const double shown = x * (a * x + b) / (x * (c * x + d) + e);
        return static_cast<float>(std::clamp(shown, 0.0, 1.0));
    }

    /// Returns the input that the curve maps to `shown`, which is in (0, 1).
    [[nodiscard]] static double inverse(double shown)
    {
        const double qa = a - shown * c;
        const double qb = b - shown * d;
        const double qc = -shown * e;
        return (-qb + std::sqrt(qb * qb - 4.0 * qa * qc)) / (2.0 * qa) / input_scale;
    }
};

}  // namespace bdpt::eval
