#include <bdpt/default_lights.h>
#include <bdpt/light/studio_environment.h>
#include <bdpt/light_desc.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace bdpt {
namespace {

/// Size of a procedural environment.
struct PaintedSize {
    /// Sine and cosine of half the height of a row, pi / (2 rows): rotating by it needs no sine of
    /// the C library, which may differ between machines.
    double half_step_sine;
    double half_step_cosine;
    int rows;  ///< number of rows; there are twice as many columns
};

constexpr PaintedSize painted_32_rows{0.049067674327418015, 0.99879545620517239, 32};
constexpr PaintedSize painted_128_rows{0.012271538285719925, 0.99992470183914450, 128};

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

/// Returns a grey environment with the radiance that `radiance` gives for unit directions, scaled
/// to a mean of 1 nit. Bit-identical on all machines if `radiance` is.
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

/// Returns 0 for x <= 0, 1 for x >= 1, and a smooth transition between.
double smooth_step(double x)
{
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// A light as wide as a part of the sky: so soft that it causes hardly any noise, and does not look
/// like a lamp in mirrors.
struct SoftLight {
    glm::dvec3 towards;  ///< the middle of the light; any length
    double radiance;     ///< there; before normalisation to a mean of 1 nit, like all of these
    int power;           ///< of the cosine that dims it
};

/// A sky, and a ground that continues from its horizon without an edge, so that it is a backdrop in
/// views from above. The key light is on the left of an observer in front of the objects, the rim
/// light behind them on the right.
struct PaintedSky {
    double horizon;  ///< radiance
    double zenith;   ///< radiance
    double ground;   ///< radiance below 42 degrees under the horizon
    SoftLight key;
    SoftLight rim;
};

constexpr PaintedSky even_sky{.horizon = 0.7,
                              .zenith = 1.2,
                              .ground = 0.5,
                              .key = {{-0.5, 1.0, 0.87}, 5.0, 6},
                              .rim = {{0.5, 0.36, -0.87}, 1.0, 6}};

// Narrow lights shape objects. The sky is darker than white paint, so that white objects stand out.
constexpr PaintedSky dark_sky{.horizon = 0.45,
                              .zenith = 0.25,
                              .ground = 0.32,
                              .key = {{-0.8, 0.9, 0.8}, 14.0, 18},
                              .rim = {{0.4, 0.6, -1.0}, 3.0, 12}};

double radiance(const SoftLight& light, const glm::dvec3& direction)
{
    const double cosine = std::max(glm::dot(direction, glm::normalize(light.towards)), 0.0);
    double result = light.radiance;
    for (int i = 0; i < light.power; ++i) {
        result *= cosine;
    }
    return result;
}

double radiance(const PaintedSky& sky, const glm::dvec3& direction)
{
    const double sine = direction.y;
    const double even = sine > 0.0
                            ? sky.horizon + (sky.zenith - sky.horizon) * sine
                            : sky.horizon + (sky.ground - sky.horizon) * smooth_step(-1.5 * sine);
    return even + radiance(sky.key, direction) + radiance(sky.rim, direction);
}

EnvironmentLightDesc paint(const PaintedSky& sky)
{
    return painted_environment(
        painted_32_rows, [&sky](const glm::dvec3& direction) { return radiance(sky, direction); });
}

/// An upright emitting rectangle at distance 1, with soft edges.
struct SoftBox {
    glm::dvec3 towards;  ///< direction from the centre of the scene
    double half_width;   ///< half width of the box, at distance 1
    double half_height;  ///< half height of the box, at distance 1
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

double evaluate_radiance(const SoftBox& box, const glm::dvec3& direction)
{
    const glm::dvec3 forward = glm::normalize(box.towards);
    const double ahead = glm::dot(direction, forward);
    if (!(ahead > 0.0)) {
        return 0.0;
    }
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 up = glm::cross(right, forward);
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

EnvironmentLightDesc default_environment()
{
    return paint(even_sky);
}

EnvironmentLightDesc object_environment()
{
    return paint(dark_sky);
}

EnvironmentLightDesc studio_environment()
{
    return painted_environment(painted_128_rows, [](const glm::dvec3& direction) {
        double value = studio_room(direction.y);
        for (const SoftBox& box : studio_boxes) {
            value += evaluate_radiance(box, direction);
        }
        return value;
    });
}

}  // namespace bdpt
