#include "metrics/color_spaces.h"

#include <bdpt/eval/drawing.h>
#include <bdpt/io/display.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>

namespace bdpt::eval {
namespace {

/// Returns a point on a curve through L*a*b* within the sRGB gamut: `t` in [0, 1].
Vec3 lab_on_curve(double t)
{
    constexpr double degrees = std::numbers::pi / 180.0;
    const double lightness = 2.0 + 95.0 * t;
    const double hue = (290.0 + 165.0 * t) * degrees;  // violet, red, orange, yellow
    const double chroma = 68.0 * std::sin(std::numbers::pi * t);
    return Vec3(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
}

}  // namespace

std::vector<Color8> heat_colors()
{
    constexpr std::size_t steps = 8192;
    std::vector<double> lengths{0.0};  // arc length of the curve up to each step
    for (std::size_t i = 1; i <= steps; ++i) {
        const auto at = [](std::size_t k) {
            return lab_on_curve(static_cast<double>(k) / static_cast<double>(steps));
        };
        lengths.push_back(lengths.back() + static_cast<double>(glm::distance(at(i - 1), at(i))));
    }
    constexpr std::size_t colors = 256;
    std::vector<Color8> result;
    std::size_t step = 0;
    for (std::size_t i = 0; i < colors; ++i) {
        const double wanted =
            lengths.back() * static_cast<double>(i) / static_cast<double>(colors - 1);
        while (step < steps && lengths[step] < wanted) {
            ++step;
        }
        const Rgb linear =
            linear_from_lab(lab_on_curve(static_cast<double>(step) / static_cast<double>(steps)));
        result.push_back(
            {io::encode_srgb(linear.r), io::encode_srgb(linear.g), io::encode_srgb(linear.b)});
    }
    return result;
}

}  // namespace bdpt::eval
