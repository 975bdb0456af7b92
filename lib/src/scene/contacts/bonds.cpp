#include "scene/contacts/bonds.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bdpt {
namespace {

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
