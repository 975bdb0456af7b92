#include "light/painted/painted_environment.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace bdpt {
namespace {

/// Sine and cosine of equally spaced angles.
struct PaintedTurn {
    double sine;
    double cosine;

    void add(const PaintedTurn& by)
    {
        const double before = sine;
        sine = sine * by.cosine + cosine * by.sine;
        cosine = cosine * by.cosine - before * by.sine;
    }
};

}  // namespace

EnvironmentLightDesc painted_environment(const PaintedSize& size,
                                         const std::function<double(const glm::dvec3&)>& radiance)
{
    // Rows are as high as columns are wide. Centres are offset by half of that.
    const PaintedTurn half{size.half_step_sine, size.half_step_cosine};
    PaintedTurn step = half;
    step.add(half);
    std::vector<double> values;
    double sum = 0.0;
    double weights = 0.0;
    PaintedTurn elevation{half.cosine, half.sine};  // top row: just below +y
    for (int row = 0; row < size.rows; ++row) {
        // Columns start at +z, and continue by -x to -z in the centre.
        PaintedTurn azimuth{-half.sine, -half.cosine};
        for (int column = 0; column < 2 * size.rows; ++column) {
            const glm::dvec3 direction(elevation.cosine * azimuth.sine, elevation.sine,
                                       -elevation.cosine * azimuth.cosine);
            const double value = radiance(direction);
            values.push_back(value);
            sum += elevation.cosine * value;
            weights += elevation.cosine;
            azimuth.add(step);
        }
        elevation.add({-step.sine, step.cosine});
    }
    const double mean = sum / weights;
    Image image{.width = 2 * size.rows, .height = size.rows, .pixels = {}};
    for (const double value : values) {
        image.pixels.emplace_back(static_cast<float>(value / mean));
    }
    return {.radiance = std::move(image)};
}

double smooth_step(double x)
{
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace bdpt
