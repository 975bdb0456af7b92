#include <bdpt/light/studio_environment.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace bdpt {
namespace {

using StudioDirection = glm::dvec3;

constexpr int texel_columns = 256;
constexpr int texel_rows = 128;

/// Sine and cosine of equally spaced angles. Turning takes no sine of the C library, which may
/// differ between machines.
struct StudioTurn {
    double sine;
    double cosine;

    void add(const StudioTurn& by)
    {
        const double before = sine;
        sine = sine * by.cosine + cosine * by.sine;
        cosine = cosine * by.cosine - before * by.sine;
    }
};

// Rows and columns have the same height and width: pi / 128. They begin half of it from their
// edge.
constexpr StudioTurn studio_step{0.024541228522912288, 0.99969881869620425};
constexpr StudioTurn half_studio_step{0.012271538285719925, 0.99992470183914450};

/// A rectangle at distance 1 that shines, upright, with soft edges.
struct SoftBox {
    StudioDirection towards;  ///< from the middle of the scene
    double half_width;        ///< of the box, at distance 1
    double half_height;       ///< likewise
    double radiance;
};

// +z is the front, +x on the right of who looks at it.
constexpr double key_radiance = 9.0;
const std::array studio_boxes{
    SoftBox{{-0.55, 0.85, 0.75}, 0.62, 0.50, key_radiance},         // high on the left
    SoftBox{{1.0, 0.25, 0.15}, 0.28, 0.75, 0.35 * key_radiance},    // on the right, upright
    SoftBox{{-0.35, 0.55, -1.0}, 0.85, 0.16, 0.80 * key_radiance},  // behind, lying
};
constexpr double soft_edge = 0.16;  // width of the soft edge, at distance 1

/// From 0 to 1 while x goes from -soft_edge / 2 to soft_edge / 2.
double soft_step(double x)
{
    const double t = std::clamp(x / soft_edge + 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

double radiance_of(const SoftBox& box, const StudioDirection& direction)
{
    const StudioDirection forward = glm::normalize(box.towards);
    const double ahead = glm::dot(direction, forward);
    if (!(ahead > 0.0)) {
        return 0.0;
    }
    const StudioDirection right =
        glm::normalize(glm::cross(forward, StudioDirection(0.0, 1.0, 0.0)));
    const StudioDirection up = glm::cross(right, forward);
    const double x = glm::dot(direction, right) / ahead;
    const double y = glm::dot(direction, up) / ahead;
    return box.radiance * soft_step(box.half_width - std::max(x, -x)) *
           soft_step(box.half_height - std::max(y, -y));
}

/// Walls that get darker upwards, and a floor that is brightest below the scene.
double studio_room(double sine)
{
    constexpr double wall = 0.42;
    const double up = std::max(sine, 0.0);
    const double down = std::max(-sine, 0.0);
    return wall - 0.22 * up + 0.45 * down * down;
}

}  // namespace

EnvironmentLightDesc studio_environment()
{
    std::vector<double> radiance;
    double sum = 0.0;
    double weights = 0.0;
    StudioTurn elevation{half_studio_step.cosine,
                         half_studio_step.sine};  // of the top row: just below +y
    for (int row = 0; row < texel_rows; ++row) {
        // Columns begin at +z, and go by -x... to -z in the middle.
        StudioTurn azimuth{-half_studio_step.sine, -half_studio_step.cosine};
        for (int column = 0; column < texel_columns; ++column) {
            const StudioDirection direction(elevation.cosine * azimuth.sine, elevation.sine,
                                            -elevation.cosine * azimuth.cosine);
            double value = studio_room(elevation.sine);
            for (const SoftBox& box : studio_boxes) {
                value += radiance_of(box, direction);
            }
            radiance.push_back(value);
            sum += elevation.cosine * value;
            weights += elevation.cosine;
            azimuth.add(studio_step);
        }
        elevation.add({-studio_step.sine, studio_step.cosine});
    }
    const double mean = sum / weights;
    EnvironmentLightDesc result;
    result.radiance.width = texel_columns;
    result.radiance.height = texel_rows;
    for (const double value : radiance) {
        result.radiance.pixels.emplace_back(static_cast<float>(value / mean));
    }
    return result;
}

}  // namespace bdpt
