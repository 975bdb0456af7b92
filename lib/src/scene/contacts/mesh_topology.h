#pragma once

#include "geometry/placed_mesh.h"
#include "scene/contacts/box_tree.h"
#include "scene/contacts/contact_faces.h"

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// Returns for each vertex the first one, in a fixed order, at the same position.
[[nodiscard]] std::vector<std::uint32_t> weld(const std::vector<Vec3>& positions);

/// The shells of a mesh: parts whose triangles are connected by edges. Where more than two
/// triangles meet at an edge, as on bodies that touch in one mesh, those are connected that bound
/// the same wedge of the inside.
struct Shells {
    std::vector<std::uint32_t> of_triangles;  ///< index of the shell of each triangle
    std::vector<bool> are_closed;             ///< by shell
    /// Number of edges that lack a triangle on the other side, or have one with opposite
    /// orientation: 0 for the boundary of a closed body. Vertices at the same position count as
    /// one. Degenerate triangles do not count.
    std::size_t open_edges = 0;
};

[[nodiscard]] Shells find_shells(const MeshDesc& mesh);

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
