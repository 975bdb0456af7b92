#pragma once

#include <cmath>

namespace bdpt::io {

/// A point of the unit circle.
struct CirclePoint {
    double sin = 0.0;
    double cos = 1.0;
};

/// Returns the point at a fraction of a turn, accurate to the last digits and equal on all
/// machines, unlike the sine of the C library.
[[nodiscard]] inline CirclePoint circle_point(double turns)
{
    const double quadrant = std::floor(4.0 * turns + 0.5);
    const double x = (turns - 0.25 * quadrant) * 6.283185307179586;
    // Taylor series on |x| <= pi/4, evaluated from the last term.
    const double x2 = x * x;
    double s = 1.0;
    double c = 1.0;
    for (int n = 16; n >= 2; n -= 2) {
        s = 1.0 - s * x2 / (n * (n + 1));
        c = 1.0 - c * x2 / (n * (n - 1));
    }
    s *= x;
    switch (static_cast<int>(quadrant - 4.0 * std::floor(0.25 * quadrant))) {
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        case 3:
            return {-c, s};
        default:
            return {s, c};
    }
}

}  // namespace bdpt::io
