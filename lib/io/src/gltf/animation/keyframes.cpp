#include "gltf/animation/animation.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>

namespace bdpt::io {

namespace {

using Values = std::vector<double>;

/// Kinds of rows of values at a key frame.
enum class Row : std::uint8_t { in_tangent, value, out_tangent };

Values row(const KeyFrames& frames, std::size_t key, Row which)
{
    const bool spline = frames.interpolation == Interpolation::cubic_spline;
    const std::size_t index = spline ? 3 * key + static_cast<std::size_t>(which) : key;
    const auto first = frames.values.begin() + static_cast<std::ptrdiff_t>(index * frames.width);
    return {first, first + static_cast<std::ptrdiff_t>(frames.width)};
}

glm::dquat to_quaternion(const Values& xyzw)
{
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

Values to_values(const glm::dquat& q)
{
    return {q.x, q.y, q.z, q.w};
}

/// Normalizes a quaternion; one of length 0 stays as it is.
Values normalized(const Values& xyzw)
{
    const glm::dquat q = to_quaternion(xyzw);
    const double length = glm::length(q);
    return length > 0.0 && std::isfinite(length) ? to_values(q / length) : xyzw;
}

Values linear(const Values& a, const Values& b, double u)
{
    Values result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        result[i] = a[i] + u * (b[i] - a[i]);
    }
    return result;
}

/// Interpolates along the shorter great circle between unit quaternions, at constant speed. Bisects
/// the arc down to `u`, as the sine and arccosine of the C library may differ between machines.
Values slerp(Values a, Values b, double u)
{
    if (std::inner_product(a.begin(), a.end(), b.begin(), 0.0) < 0.0) {
        std::transform(b.begin(), b.end(), b.begin(), std::negate<>());
    }
    constexpr int bits = 52;
    for (int bit = 0; bit < bits; ++bit) {
        const Values middle = normalized(linear(a, b, 0.5));
        (u < 0.5 ? b : a) = middle;
        u = u < 0.5 ? 2.0 * u : 2.0 * u - 1.0;
    }
    return a;
}

/// Evaluates Hermite's spline; tangents are per second, so they are multiplied by the seconds
/// between the keys.
Values hermite(const KeyFrames& frames, std::size_t key, double u, double seconds)
{
    const Values v0 = row(frames, key, Row::value);
    const Values out = row(frames, key, Row::out_tangent);
    const Values in = row(frames, key + 1, Row::in_tangent);
    const Values v1 = row(frames, key + 1, Row::value);
    const double u2 = u * u;
    const double u3 = u2 * u;
    Values result(v0.size());
    for (std::size_t i = 0; i < v0.size(); ++i) {
        result[i] = (2.0 * u3 - 3.0 * u2 + 1.0) * v0[i] + seconds * (u3 - 2.0 * u2 + u) * out[i] +
                    (3.0 * u2 - 2.0 * u3) * v1[i] + seconds * (u3 - u2) * in[i];
    }
    return result;
}

Values between(const KeyFrames& frames, Quantity quantity, std::size_t key, double time)
{
    if (frames.interpolation == Interpolation::step) {
        return row(frames, key, Row::value);
    }
    const double start = static_cast<double>(frames.times[key]);
    const double seconds = static_cast<double>(frames.times[key + 1]) - start;
    const double u = (time - start) / seconds;
    if (frames.interpolation == Interpolation::cubic_spline) {
        return hermite(frames, key, u, seconds);
    }
    const Values a = row(frames, key, Row::value);
    const Values b = row(frames, key + 1, Row::value);
    return quantity == Quantity::rotation ? slerp(normalized(a), normalized(b), u)
                                          : linear(a, b, u);
}

}  // namespace

std::vector<double> value_at(const KeyFrames& frames, Quantity quantity, double time)
{
    // The first key frame after `time`.
    const auto next =
        std::upper_bound(frames.times.begin(), frames.times.end(), time,
                         [](double t, float key) { return t < static_cast<double>(key); });
    const auto after = static_cast<std::size_t>(std::distance(frames.times.begin(), next));
    const Values values = after == 0 ? row(frames, 0, Row::value)
                          : after == frames.times.size()
                              ? row(frames, after - 1, Row::value)
                              : between(frames, quantity, after - 1, time);
    return quantity == Quantity::rotation ? normalized(values) : values;
}

}  // namespace bdpt::io
