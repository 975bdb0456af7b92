#include "scene/contacts/contact_face.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace bdpt {
namespace {

/// Cuts off what lies beyond the edge from `a` to `b` of a triangle with that normal.
FaceOverlap clipped(const FaceOverlap& shape, Vec3 a, Vec3 b, Vec3 normal)
{
    const Vec3 inwards = cross(normal, b - a);
    FaceOverlap result;
    for (std::size_t i = 0; i < shape.count; ++i) {
        const Vec3 p = shape.corners[i];
        const Vec3 q = shape.corners[(i + 1) % shape.count];
        const float of_p = dot(p - a, inwards);
        const float of_q = dot(q - a, inwards);
        if (of_p >= 0.0f) {
            result.corners[result.count++] = p;
        }
        if ((of_p >= 0.0f) != (of_q >= 0.0f)) {
            result.corners[result.count++] = p + of_p / (of_p - of_q) * (q - p);
        }
    }
    return result;
}

}  // namespace

std::optional<ContactFace> make_face(const PlacedMesh& placed, std::uint32_t instance,
                                     std::uint32_t triangle)
{
    constexpr float min_height = 16.0f;  // times the error
    auto corners = placed.corners(triangle, 0.0f);
    if (placed.front_sign() < 0.0f) {
        std::swap(corners[1], corners[2]);
    }
    const Vec3 normal = placed.area_normal(triangle, 0.0f);
    const float area = length(normal);
    const float longest =
        std::max({distance(corners[0], corners[1]), distance(corners[1], corners[2]),
                  distance(corners[2], corners[0])});
    const float error = placed.point(triangle, Vec2(1.0f / 3.0f), 0.0f).error;
    if (!(area > min_height * error * longest)) {
        return std::nullopt;
    }
    return ContactFace{corners, normal / area, error, instance, triangle};
}

FaceOverlap overlap_of(const ContactFace& a, const ContactFace& b)
{
    FaceOverlap shape;
    for (const Vec3& corner : b.corners) {
        shape.corners[shape.count++] = corner;
    }
    for (std::size_t i = 0; i < 3 && shape.count > 0; ++i) {
        shape = clipped(shape, a.corners[i], a.corners[(i + 1) % 3], a.normal);
    }
    return shape;
}

float touching_area(const ContactFace& a, const ContactFace& b)
{
    constexpr float max_sine = 0.1f;
    const Vec3 sine = cross(a.normal, b.normal);
    if (dot(sine, sine) > max_sine * max_sine) {
        return 0.0f;
    }
    const float tolerance = (a.error + b.error);
    if (std::abs(dot(b.corners[0] - a.corners[0], a.normal)) > tolerance &&
        std::abs(dot(b.corners[1] - a.corners[0], a.normal)) > tolerance &&
        std::abs(dot(b.corners[2] - a.corners[0], a.normal)) > tolerance) {
        return 0.0f;
    }
    const FaceOverlap shape = overlap_of(a, b);
    Vec3 twice_area(0.0f);
    float around = 0.0f;
    for (std::size_t i = 0; i < shape.count; ++i) {
        const Vec3 p = shape.corners[i] - shape.corners[0];
        const Vec3 q = shape.corners[(i + 1) % shape.count] - shape.corners[0];
        if (std::abs(dot(shape.corners[i] - a.corners[0], a.normal)) > tolerance) {
            return 0.0f;
        }
        twice_area += cross(p, q);
        around += distance(p, q);
    }
    const float area = 0.5f * length(twice_area);
    return area > tolerance * around ? area : 0.0f;
}

}  // namespace bdpt
