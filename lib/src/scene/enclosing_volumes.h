#pragma once

#include "geometry/embree_scene.h"
#include "geometry/placed_mesh.h"
#include "geometry/sphere.h"

#include <bdpt/scene.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// Nested dielectrics: the bodies of a scene that light passes through, and what lies within them.
/// They are found by rays when the scene is built: a point is in a body when a ray from it leaves
/// the body once more often than it enters. Of three rays two decide.
class EnclosingVolumes {
public:
    /// The most bodies whose nesting is examined: the work may grow with the square of their
    /// number.
    static constexpr std::size_t most = 1024;
    /// The most bodies that may lie one in the other: the work grows with that for each of them.
    static constexpr std::size_t max_depth = 64;

    /// `instances` are those whose meshes bound bodies, `most` of them. All else must outlive this,
    /// but for `embree`, whose filter must only if it concerns any mesh.
    /// Throws `Error` (invalid_input) if more than `max_depth` lie one in the other.
    EnclosingVolumes(std::span<const PlacedMesh> placed, std::vector<std::uint32_t> instances,
                     std::span<const Sphere> spheres, const EmbreeScene& embree);

    /// For each instance the innermost body that all of it lies within, itself excepted. It is
    /// judged by points on its front all over the mesh.
    [[nodiscard]] std::vector<std::optional<std::uint32_t>> around_all() const;
    /// The innermost body at a point that lies on no surface.
    [[nodiscard]] std::optional<std::uint32_t> at(Vec3 p) const;

private:
    /// Numbers of bodies in ascending order.
    using Set = std::vector<std::size_t>;

    [[nodiscard]] Set left_by(Vec3 origin, Vec3 direction, const Set& bodies) const;
    [[nodiscard]] Set voted(Vec3 p, const Set& bodies) const;
    [[nodiscard]] Set containing(Vec3 p, Set bodies) const;
    [[nodiscard]] Set containing(std::uint32_t instance) const;
    [[nodiscard]] std::optional<std::uint32_t> innermost(const Set& bodies) const;

    std::span<const PlacedMesh> placed_;
    std::span<const Sphere> spheres_;
    EmbreeScene embree_;
    std::vector<std::uint32_t> instances_;
    std::vector<std::optional<std::size_t>> volume_of_instance_;
    Set all_;
    std::vector<Bounds> bounds_;  // by body
    std::vector<Set> around_;     // by body: those that it lies in
};

}  // namespace bdpt
