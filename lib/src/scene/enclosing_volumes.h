#pragma once

#include "geometry/embree_scene.h"
#include "geometry/placed_mesh.h"
#include "geometry/sphere.h"
#include "scene/contacts/contact_faces.h"

#include <bdpt/scene.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// Nested dielectrics: the transparent bodies of a scene, and their nesting. They are found by rays
/// when the scene is built: a point is in a body if a ray from it leaves the body once more often
/// than it enters. The majority of three rays decides.
class EnclosingVolumes {
public:
    /// Maximum number of bodies whose nesting is examined: the work may grow with the square of
    /// their number.
    static constexpr std::size_t most = 1024;
    /// Maximum nesting depth: the work grows with it for each body.
    static constexpr std::size_t max_depth = 64;

    /// `instances` are those whose meshes bound bodies, `most` at most. All other arguments must
    /// outlive this, except `embree`, whose filter must only if it concerns any mesh. `bonds` are
    /// sorted. Throws `Error` (invalid_input) if more than `max_depth` bodies are nested.
    EnclosingVolumes(std::span<const PlacedMesh> placed, std::vector<std::uint32_t> instances,
                     std::span<const Sphere> spheres, const EmbreeScene& embree,
                     std::span<const Bond> bonds = {});

    /// Returns for each instance the innermost other body that contains all of it, determined by
    /// points on its front all over the mesh.
    [[nodiscard]] std::vector<std::optional<std::uint32_t>> around_all() const;
    /// Returns the innermost body at a point that lies on no surface.
    [[nodiscard]] std::optional<std::uint32_t> at(Vec3 p) const;

private:
    /// Sorted indices of bodies.
    using Set = std::vector<std::size_t>;

    [[nodiscard]] Set left_by(Vec3 origin, Vec3 direction, const Set& bodies) const;
    [[nodiscard]] Set voted(Vec3 p, const Set& bodies) const;
    [[nodiscard]] Set containing(Vec3 p, Set bodies) const;
    [[nodiscard]] Set containing(std::uint32_t instance) const;
    [[nodiscard]] std::optional<std::uint32_t> innermost(const Set& bodies) const;

    std::span<const PlacedMesh> placed_;
    std::span<const Sphere> spheres_;
    EmbreeScene embree_;
    std::span<const Bond> bonds_;
    std::vector<std::uint32_t> instances_;
    std::vector<std::optional<std::size_t>> volume_of_instance_;
    Set all_;
    std::vector<Bounds> bounds_;  // one per body
    std::vector<Set> around_;     // for each body the bodies that contain it
};

}  // namespace bdpt
