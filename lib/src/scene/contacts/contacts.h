#pragma once

#include "geometry/placed_mesh.h"
#include "scene/contacts/mesh_topology.h"

#include <bdpt/shared_scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace bdpt {

/// What faces of an instance are where they touch others.
enum class ContactRole : std::uint8_t {
    sheet,  ///< opaque, or a thin pane: it stays in place
    lamp,   ///< emits light
    body,   ///< refracts light that enters its inside
};

/// Returns the role of each instance of a valid description.
[[nodiscard]] std::vector<ContactRole> contact_roles(const SharedSceneDesc& desc);

/// Shells of meshes, by index of the mesh.
using ShellTable = std::map<std::size_t, std::shared_ptr<const Shells>>;

/// Returns the shells of the meshes of bodies and lamps; those in `known` are not found again.
[[nodiscard]] ShellTable find_shells(const SharedSceneDesc& desc,
                                     std::span<const ContactRole> roles, const ShellTable& known);

/// What touches in a scene, and what follows.
struct Contacts {
    std::map<std::size_t, MeshDesc> meshes;  ///< with moved faces, by index of the original mesh
    std::size_t pairs = 0;                   ///< of instances, or shells of one, that touch
    /// Instances with opposite faces so near each other that rays cannot tell them apart.
    std::vector<std::size_t> thin;
};

/// Moves faces that touch, or are closer than rays can tell apart (`BoundedPoint::error`), by a few
/// times that distance, as rays that leave one of them would miss the other: a body that refracts
/// would lose a boundary. A thin film of air remains between bodies; an opaque face stays in place
/// on the outside of the body that it touches. Faces of bodies and of closed lamps move towards
/// their inside, others of lamps to the side that they shine to. Shells of one mesh touch like
/// meshes; faces of one shell do not. Contacts are those at shutter open. `placed` and
/// `roles` have an item for each instance.
[[nodiscard]] Contacts separate_contacts(const SharedSceneDesc& desc,
                                         std::span<const PlacedMesh> placed,
                                         std::span<const ContactRole> roles,
                                         const ShellTable& shells);

}  // namespace bdpt
