#pragma once

#include "geometry/placed_mesh.h"
#include "scene/contacts/contact_faces.h"
#include "scene/contacts/mesh_topology.h"

#include <bdpt/shared_scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// What faces of an instance are where they touch others.
enum class ContactRole : std::uint8_t {
    sheet,  ///< opaque, or a thin pane: it stays in place
    lamp,   ///< emits light
    body,   ///< refracts light that enters its inside
};

/// An instance, as contacts see it.
struct ContactPart {
    ContactRole role = ContactRole::sheet;
    /// Index of refraction of a body that may be bonded: it rests, does not shine, and is opaque to
    /// alpha.
    std::optional<float> bonding_ior{};

    friend bool operator==(const ContactPart&, const ContactPart&) = default;
};

/// Returns the part of each instance of a valid description.
[[nodiscard]] std::vector<ContactPart> contact_parts(const SharedSceneDesc& desc);

/// Shells of meshes, by index of the mesh.
using ShellTable = std::map<std::size_t, std::shared_ptr<const Shells>>;

/// Returns the shells of the meshes of bodies and lamps; those in `known` are not found again.
[[nodiscard]] ShellTable find_shells(const SharedSceneDesc& desc,
                                     std::span<const ContactPart> parts, const ShellTable& known);

/// What touches in a scene, and what follows.
struct Contacts {
    std::map<std::size_t, MeshDesc> meshes;  ///< with moved faces, by index of the original mesh
    std::size_t pairs = 0;                   ///< of instances, or shells of one, that touch
    std::size_t bonded_pairs = 0;            ///< those of them with bonded faces
    std::vector<Bond> bonds;                 ///< sorted
    /// Copies, by instance, without the faces that are bonded to those in `bonds`.
    std::map<std::size_t, MeshDesc> open;
    /// Instances with opposite faces so near each other that rays cannot tell them apart.
    std::vector<std::size_t> thin;
};

/// Moves faces that touch, or are closer than rays can tell apart (`BoundedPoint::error`), by a few
/// times that distance, as rays that leave one of them would miss the other: a body that refracts
/// would lose a boundary. A thin film of air remains between bodies; an opaque face stays in place
/// on the outside of the body that it touches. Faces of bodies and of closed lamps move towards
/// their inside, others of lamps to the side that they shine to. Shells of one mesh touch like
/// meshes; faces of one shell do not. Bonded faces stay, as one boundary. Contacts are those at
/// shutter open. `placed` and `parts` have an item for each instance.
[[nodiscard]] Contacts separate_contacts(const SharedSceneDesc& desc,
                                         std::span<const PlacedMesh> placed,
                                         std::span<const ContactPart> parts,
                                         const ShellTable& shells);

}  // namespace bdpt
