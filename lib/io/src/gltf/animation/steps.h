#pragma once

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace bdpt::io {

// Tolerances of linear interpolation between the steps of a motion.

/// Relative to the size of what turns: a step of 3.6 degrees.
inline constexpr double turn_tolerance = 5e-4;
/// Relative to the distance that an object moves while the shutter is open.
inline constexpr double way_tolerance = 1.0 / 256.0;

/// Tests whether the interpolated point is close enough to the actual one. `way`: greatest distance
/// from the opening.
[[nodiscard]] inline bool is_close(const glm::dvec3& line, const glm::dvec3& actual, double way)
{
    const double noise = 1e-9 * glm::length(actual);
    return glm::length(line - actual) <= way_tolerance * way + noise;
}

/// Tests the same for transforms: for the position of their origin, and for their axes.
[[nodiscard]] inline bool is_close(const glm::dmat4& line, const glm::dmat4& actual, double way)
{
    double size = 0.0;
    double error = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        size = std::max(size, glm::length(glm::dvec3(actual[axis])));
        error = std::max(error, glm::length(glm::dvec3(line[axis]) - glm::dvec3(actual[axis])));
    }
    const double noise = 1e-9 * (size + glm::length(glm::dvec3(actual[3])));
    return error <= turn_tolerance * size + noise &&
           glm::length(glm::dvec3(line[3]) - glm::dvec3(actual[3])) <= way_tolerance * way + noise;
}

/// Returns the distance between two points, or between the origins of two transforms.
[[nodiscard]] inline double way_between(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::length(b - a);
}
[[nodiscard]] inline double way_between(const glm::dmat4& a, const glm::dmat4& b)
{
    return glm::length(glm::dvec3(b[3]) - glm::dvec3(a[3]));
}

template <typename T>
[[nodiscard]] double max_distance(std::span<const T> values)
{
    double way = 0.0;
    for (const T& value : values) {
        way = std::max(way, way_between(values.front(), value));
    }
    return way;
}

/// Tests whether linear interpolation between every `stride`th of equally spaced values is close to
/// the values in between.
template <typename T>
[[nodiscard]] bool are_close(std::span<const T> values, std::size_t stride)
{
    const double way = max_distance(values);
    for (std::size_t first = 0; first + stride < values.size(); first += stride) {
        for (std::size_t i = 1; i < stride; ++i) {
            const double u = static_cast<double>(i) / static_cast<double>(stride);
            const T line = (1.0 - u) * values[first] + u * values[first + stride];
            if (!is_close(line, values[first + i], way)) {
                return false;
            }
        }
    }
    return true;
}

/// Returns the fewest of the values, at 2^n + 1 equally spaced times, whose interpolation is close
/// to all; only the first if all are equal.
template <typename T>
[[nodiscard]] std::vector<T> thinned(std::span<const T> values)
{
    if (std::all_of(values.begin(), values.end(),
                    [&values](const T& value) { return value == values.front(); })) {
        return {values.begin(), values.begin() + std::min<std::ptrdiff_t>(std::ssize(values), 1)};
    }
    std::size_t stride = values.size() - 1;
    while (stride > 1 && !are_close(values, stride)) {
        stride /= 2;
    }
    std::vector<T> result;
    for (std::size_t i = 0; i < values.size(); i += stride) {
        result.push_back(values[i]);
    }
    return result;
}

}  // namespace bdpt::io
