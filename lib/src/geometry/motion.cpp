#include "geometry/motion.h"

#include <bdpt/motion.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <cmath>
#include <cstdlib>

namespace bdpt {
namespace {

/// Returns the Bernstein coefficients of det((1 - f) a + f b): for f in [0, 1] it is between their
/// minimum and maximum.
std::array<double, 4> determinants(const glm::dmat3& a, const glm::dmat3& b)
{
    const auto of = [](const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z) {
        return dot(x, cross(y, z));
    };
    return {of(a[0], a[1], a[2]),
            (of(b[0], a[1], a[2]) + of(a[0], b[1], a[2]) + of(a[0], a[1], b[2])) / 3.0,
            (of(a[0], b[1], b[2]) + of(b[0], a[1], b[2]) + of(b[0], b[1], a[2])) / 3.0,
            of(b[0], b[1], b[2])};
}

/// Returns upper bounds of the magnitudes of the cofactors of all matrices between a and b.
glm::dmat3 cofactor_bounds(const glm::dmat3& a, const glm::dmat3& b)
{
    glm::dmat3 bounds(0.0);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        bounds[i] = max(max(abs(cross(a[j], a[k])), abs(cross(b[j], b[k]))),
                        0.5 * abs(cross(a[j], b[k]) + cross(b[j], a[k])));
    }
    return bounds;
}

}  // namespace

MotionBounds motion_bounds(const Mat4& from, const Mat4& to)
{
    const glm::dmat3 a(from);
    const glm::dmat3 b(to);
    const std::array<double, 4> coefficients = determinants(a, b);
    MotionBounds bounds{.min_determinant = std::abs(coefficients[0])};
    for (const double coefficient : coefficients) {
        const bool same_side = coefficient * coefficients[0] > 0.0;  // false for NaN
        if (!same_side || !std::isnormal(static_cast<float>(coefficient))) {
            return {};
        }
        bounds.min_determinant = std::min(bounds.min_determinant, std::abs(coefficient));
    }
    // The inverse is the transposed matrix of cofactors over the determinant, so its rows are the
    // columns of the cofactors.
    const glm::dmat3 cofactors = cofactor_bounds(a, b);
    for (int i = 0; i < 3; ++i) {
        const double sum = cofactors[i].x + cofactors[i].y + cofactors[i].z;
        bounds.inverse_stretch = std::max(bounds.inverse_stretch, sum / bounds.min_determinant);
    }
    return bounds;
}

bool can_move(const Mat4& from, const Mat4& to)
{
    return motion_bounds(from, to).min_determinant > 0.0;
}

bool can_move(const Mat4& first, std::span<const Mat4> motion)
{
    for (std::size_t i = 0; i < motion.size(); ++i) {
        if (!can_move(at_step(first, motion, i), motion[i])) {
            return false;
        }
    }
    return true;
}

bool can_turn(Vec3 from, Vec3 to)
{
    const glm::dvec3 a(from);
    const glm::dvec3 b(to);
    const double cosine = dot(a, b) / std::sqrt(dot(a, a) * dot(b, b));
    constexpr double min_cosine = 1e-6;
    return cosine > min_cosine;
}

}  // namespace bdpt
