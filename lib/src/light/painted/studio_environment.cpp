#include <bdpt/light/studio_environment.h>

#include "light/painted/painted_environment.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>

namespace bdpt {
namespace {

using StudioDirection = glm::dvec3;

/// An upright emitting rectangle at distance 1, with soft edges.
struct SoftBox {
    StudioDirection towards;  ///< direction from the centre of the scene
    double half_width;        ///< half width of the box, at distance 1
    double half_height;       ///< half height of the box, at distance 1
    double radiance;
};

// +z is the front, +x to the right of an observer in front.
constexpr double key_radiance = 9.0;
const std::array studio_boxes{
    SoftBox{{-0.55, 0.85, 0.75}, 0.62, 0.50, key_radiance},         // high on the left
    SoftBox{{1.0, 0.25, 0.15}, 0.28, 0.75, 0.35 * key_radiance},    // on the right, upright
    SoftBox{{-0.35, 0.55, -1.0}, 0.85, 0.16, 0.80 * key_radiance},  // behind, horizontal
};
constexpr double soft_edge = 0.16;  // width of the soft edge, at distance 1

/// Returns 0 to 1 while x increases from -soft_edge / 2 to soft_edge / 2.
double soft_step(double x)
{
    return smooth_step(x / soft_edge + 0.5);
}

double evaluate_radiance(const SoftBox& box, const StudioDirection& direction)
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

/// Returns walls that darken upwards, and a floor that is brightest below the scene.
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
    return painted_environment(painted_128_rows, [](const StudioDirection& direction) {
        double value = studio_room(direction.y);
        for (const SoftBox& box : studio_boxes) {
            value += evaluate_radiance(box, direction);
        }
        return value;
    });
}

}  // namespace bdpt
