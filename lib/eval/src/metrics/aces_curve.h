#pragma once

#include <algorithm>
#include <cmath>

namespace bdpt::eval {

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
