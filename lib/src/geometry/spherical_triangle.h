#pragma once

#include "math/elementary.h"

#include <bdpt/types.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace bdpt {

/// The part of the unit sphere that a triangle covers, seen from the origin.
class SphericalTriangle {
public:
    explicit SphericalTriangle(const std::array<Vec3, 3>& corners)
        : corners_(corners),
          a_(normalize(corners[0])),
          b_(normalize(corners[1])),
          c_(normalize(corners[2])),
          cos_ab_(dot(a_, b_)),
          volume_(std::abs(dot(a_, cross(b_, c_)))),
          solid_angle_(2.0f * atan2_exact(volume_, 1.0f + cos_ab_ + dot(b_, c_) + dot(c_, a_)))
    {}

    /// Returns the solid angle [sr] [Van Oosterom and Strackee 1983].
    [[nodiscard]] float solid_angle() const { return solid_angle_; }

    /// Returns a unit direction, uniform in the solid angle [Arvo 1995, "Stratified Sampling of
    /// Spherical Triangles"].
    [[nodiscard]] Vec3 sample(Vec2 u) const
    {
        // The angle at a, between the planes of two edges.
        const Vec3 ab = cross(a_, b_);
        const Vec3 ac = cross(a_, c_);
        const float scale = 1.0f / std::sqrt(dot(ab, ab) * dot(ac, ac));
        const float cos_angle = scale * dot(ab, ac);
        const float sin_angle = scale * volume_;
        // The corner c moves along its edge to a, until the rest has this share of the area.
        const SinCos area = sin_cos(u.x * solid_angle_);
        const float s = area.sin * cos_angle - area.cos * sin_angle;
        const float t = area.cos * cos_angle + area.sin * sin_angle;
        const float across = t - cos_angle;
        const float along = s + sin_angle * cos_ab_;
        const float divisor = (along * s + across * t) * sin_angle;
        const float cosine =
            divisor != 0.0f ? ((along * t - across * s) * cos_angle - along) / divisor : 1.0f;
        const Vec3 moved = towards(a_, c_, std::clamp(cosine, -1.0f, 1.0f));
        return towards(b_, moved, 1.0f - u.y * (1.0f - dot(moved, b_)));
    }

    /// Returns the barycentric coordinates, weights of the second and third corner, of the point in
    /// a direction; of one of its edges where rounding misses it.
    [[nodiscard]] Vec2 barycentrics(Vec3 direction) const
    {
        const auto& [a, b, c] = corners_;
        const float sign = dot(a, cross(b, c)) < 0.0f ? -1.0f : 1.0f;
        const Vec3 volumes{dot(direction, cross(b, c)), dot(direction, cross(c, a)),
                           dot(direction, cross(a, b))};
        const Vec3 weights = max(sign * volumes, Vec3(0.0f));
        return Vec2(weights.y, weights.z) / (weights.x + weights.y + weights.z);
    }

private:
    /// Returns the direction whose angle to `from`, on the way to `to`, has this cosine.
    [[nodiscard]] static Vec3 towards(Vec3 from, Vec3 to, float cosine)
    {
        const Vec3 level = to - dot(to, from) * from;
        const float length2 = dot(level, level);
        const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
        return length2 > 0.0f ? cosine * from + sine / std::sqrt(length2) * level : from;
    }

    std::array<Vec3, 3> corners_;
    Vec3 a_;  ///< unit
    Vec3 b_;
    Vec3 c_;
    float cos_ab_;
    float volume_;  ///< of the parallelepiped of the three directions
    float solid_angle_;
};

}  // namespace bdpt
