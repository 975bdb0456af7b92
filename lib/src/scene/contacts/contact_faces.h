#pragma once

#include "geometry/placed_mesh.h"

#include <bdpt/scene.h>

#include <glm/common.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// Returns the bounds of a triangle with a margin around [m].
[[nodiscard]] inline Bounds box_around(const std::array<Vec3, 3>& corners, float margin)
{
    return {.min = min(corners[0], min(corners[1], corners[2])) - margin,
            .max = max(corners[0], max(corners[1], corners[2])) + margin};
}

/// A triangle in world space.
struct ContactFace {
    std::array<Vec3, 3> corners;  ///< counter-clockwise from the front
    Vec3 normal;                  ///< unit, on the front
    float error;
    std::uint32_t instance;
    std::uint32_t triangle;
    std::uint32_t shell = 0;  ///< of its mesh, as far as that is known

    /// Tests whether both are of one shell of an instance.
    [[nodiscard]] bool is_of_shell(const ContactFace& other) const
    {
        return instance == other.instance && shell == other.shell;
    }
    /// Returns its bounds with `errors` times its error around.
    [[nodiscard]] Bounds box(float errors) const { return box_around(corners, errors * error); }
};

/// Returns the triangle, unless it is so narrow that its normal is noise.
[[nodiscard]] std::optional<ContactFace> make_face(const PlacedMesh& placed, std::uint32_t instance,
                                                   std::uint32_t triangle);

/// The part of a plane where two triangles overlap: a convex polygon.
struct FaceOverlap {
    std::array<Vec3, 9> corners;
    std::size_t count = 0;
};

/// Returns the part of `b` that lies along the normal of `a` before or behind `a`.
[[nodiscard]] FaceOverlap overlap_of(const ContactFace& a, const ContactFace& b);

/// Returns the area in which the faces touch [m^2]: they are parallel and nowhere farther apart
/// than rays can tell where they overlap. 0 where they do not, or where the overlap is narrower
/// than that.
[[nodiscard]] float touching_area(const ContactFace& a, const ContactFace& b);

/// A triangle that is the boundary of two bodies that are bonded.
struct Bond {
    std::uint32_t instance;
    std::uint32_t triangle;
    std::uint32_t partner;  ///< instance of the body in front of it

    friend auto operator<=>(const Bond&, const Bond&) = default;
};

/// Returns the bond of a triangle in a sorted list; null if there is none.
[[nodiscard]] const Bond* find_bond(std::span<const Bond> sorted, std::uint32_t instance,
                                    std::uint32_t triangle);

/// Two faces that touch, by their index in a list of faces.
struct Touch {
    std::uint32_t face;
    std::uint32_t other;
    float area;  ///< in which they touch [m^2]
};

/// Returns for each face whether it is bonded: bonded faces that touch it cover it, are of one
/// other shell, on its other side, and `can_bond(face, other)` holds. So bonded faces of two shells
/// have equal areas, however these are divided into triangles.
[[nodiscard]] std::vector<bool> find_bonded(
    std::span<const ContactFace> faces, std::span<const Touch> touches,
    const std::function<bool(std::uint32_t, std::uint32_t)>& can_bond);

}  // namespace bdpt
