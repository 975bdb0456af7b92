#include "scene/contacts/contact_faces.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Tests whether `area` is all of the face, apart from rounding.
bool covers(float area, const ContactFace& face)
{
    constexpr float max_share = 1e-4f;
    const Vec3 a = face.corners[1] - face.corners[0];
    const Vec3 b = face.corners[2] - face.corners[0];
    const float all = 0.5f * length(cross(a, b));
    const float around = length(a) + length(b) + distance(face.corners[1], face.corners[2]);
    return std::abs(area - all) <= max_share * all + 4.0f * face.error * around;
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

const Bond* find_bond(std::span<const Bond> sorted, std::uint32_t instance, std::uint32_t triangle)
{
    const auto found = std::lower_bound(sorted.begin(), sorted.end(), Bond{instance, triangle, 0});
    return found != sorted.end() && found->instance == instance && found->triangle == triangle
               ? &*found
               : nullptr;
}

std::vector<bool> find_bonded(std::span<const ContactFace> faces, std::span<const Touch> touches,
                              const std::function<bool(std::uint32_t, std::uint32_t)>& can_bond)
{
    constexpr auto none = std::numeric_limits<std::uint32_t>::max();
    std::vector<bool> bonded(faces.size(), true);
    std::vector<float> areas(faces.size(), 0.0f);
    std::vector<std::uint32_t> partners(faces.size(), none);  // a face of the other shell
    for (const auto& [i, k, area] : touches) {
        areas[i] += area;
        bonded[i] = bonded[i] && can_bond(i, k) && dot(faces[i].normal, faces[k].normal) < 0.0f &&
                    (partners[i] == none || faces[partners[i]].is_of_shell(faces[k]));
        partners[i] = k;
    }
    for (std::size_t i = 0; i < faces.size(); ++i) {
        bonded[i] = bonded[i] && covers(areas[i], faces[i]);
    }
    // What touches a face that is not bonded is not either.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_other;
    for (const Touch& touch : touches) {
        by_other.emplace_back(touch.other, touch.face);
    }
    std::sort(by_other.begin(), by_other.end());
    std::vector<std::uint32_t> lost;
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
        if (!bonded[i]) {
            lost.push_back(i);
        }
    }
    while (!lost.empty()) {
        const std::uint32_t other = lost.back();
        lost.pop_back();
        for (auto at = std::lower_bound(by_other.begin(), by_other.end(), std::pair(other, 0U));
             at != by_other.end() && at->first == other; ++at) {
            if (bonded[at->second]) {
                bonded[at->second] = false;
                lost.push_back(at->second);
            }
        }
    }
    return bonded;
}

}  // namespace bdpt
