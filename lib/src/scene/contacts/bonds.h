#pragma once

#include "scene/contacts/contact_face.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace bdpt {

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
