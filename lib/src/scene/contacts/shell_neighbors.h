#pragma once

#include "geometry/placed_mesh.h"
#include "scene/contacts/box_tree.h"
#include "scene/contacts/contact_face.h"
#include "scene/contacts/mesh_topology.h"

#include <vector>

namespace bdpt {

/// Returns the error of points in a box [m].
[[nodiscard]] float error_in(const Bounds& box);

/// Which faces of an instance may touch others of the same instance: those near another shell, and
/// those of shells whose opposite faces may be too near each other to be told apart. A closed shell
/// with a mean thickness of many errors is not one of them, so that meshes far from the origin, or
/// of thousands of drops, need not be searched whole.
class ShellNeighbors {
public:
    ShellNeighbors() = default;
    /// A face is near another shell if its bounds with `margin` errors around overlap the other's.
    ShellNeighbors(const PlacedMesh& placed, const Shells& shells, float margin);

    [[nodiscard]] bool any() const { return any_; }
    [[nodiscard]] bool is_near(const ContactFace& face) const
    {
        return any_ && (may_be_thin_[face.shell] ||
                        (has_near_[face.shell] && overlaps_other(face.box(margin_), face.shell)));
    }

private:
    [[nodiscard]] bool overlaps_other(const Bounds& box, std::uint32_t shell) const;

    float margin_ = 0.0f;  // [errors]
    bool any_ = false;
    BoxTree boxes_;                  // of shells
    std::vector<bool> may_be_thin_;  // by shell
    std::vector<bool> has_near_;     // by shell: another one
};

}  // namespace bdpt
