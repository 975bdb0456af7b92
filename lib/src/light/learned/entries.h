#pragma once

#include "light/environment/environment_tiles.h"
#include "light/light_samples.h"
#include "math/distributions.h"
#include "math/pdf.h"

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// A camera path of a pilot that was scattered and then left the scene, or was connected to a sun.
struct Escape {
    Vec3 p{0.0f};             ///< last vertex in the scene, in world space
    Vec3 direction{0.0f};     ///< unit, towards the light
    std::size_t tile = 0;     ///< tile of the environment that it reached, or number of the sun
    float throughput = 0.0f;  ///< luminance, >= 0 and finite
};

/// Density of the places where light from similar directions enters the scene: a grid on a plane
/// that these directions cross steeply, and a uniform part over the disk in front of the scene.
class EntryWindow {
public:
    /// A ray's entry into the scene.
    struct Entry {
        Vec3 p{0.0f};   ///< in front of the whole scene
        PlanarPdf pdf;  ///< density on the plane perpendicular to the ray
    };

    /// All entries are uniform over the disk.
    explicit EntryWindow(const BoundingSphere& bounds) : bounds_(bounds) {}
    /// Learns from `escapes` in similar directions. The plane contains `origin`. The density is
    /// proportional to the root of their throughput per area.
    EntryWindow(std::span<const Escape> escapes, Vec3 origin, const BoundingSphere& bounds);

    /// Samples the entry of light that travels in `direction`.
    [[nodiscard]] Entry sample(Vec3 direction, Vec2 u) const noexcept;
    /// Returns the density of the entry of such light through `p`.
    [[nodiscard]] PlanarPdf pdf(Vec3 p, Vec3 direction) const noexcept;
    /// Returns the integral of the root of the throughput per area over the plane [m].
    [[nodiscard]] double root_of_throughput() const noexcept { return root_of_throughput_; }

    /// Fraction of entries that are uniform over the disk.
    static constexpr float uniform_part = 0.1f;

private:
    /// Tests whether light that travels in this direction enters through the grid.
    [[nodiscard]] bool admits(Vec3 direction) const noexcept
    {
        return cells_ && is_steep(-direction);
    }
    /// Tests whether a direction towards the environment crosses the plane at a steep angle.
    [[nodiscard]] bool is_steep(Vec3 direction) const noexcept
    {
        constexpr float min_cosine = 0.25f;
        return dot(direction, normal_) > min_cosine;
    }
    /// Returns where the line through `p` crosses the plane, in the grid's [0, 1)^2.
    [[nodiscard]] Vec2 project(Vec3 p, Vec3 direction) const noexcept;

    BoundingSphere bounds_;
    Vec3 origin_{0.0f};
    Vec3 x_{0.0f};  // axes of the plane
    Vec3 y_{0.0f};
    Vec3 normal_{0.0f};
    Vec2 corner_{0.0f};
    Vec2 size_{1.0f};
    std::optional<Distribution2D> cells_;
    double root_of_throughput_ = 0.0;
};

/// The directions and places from which an environment's light enters the scene on its way to what
/// the camera sees, as a pilot learned them by tiles of the environment
/// (docs/decisions/0073-learned-entries.md). Light paths start there; no density is zero.
class EnvironmentEntries {
public:
    EnvironmentEntries(std::vector<Escape> escapes, const EnvironmentTiles& tiles,
                       const BoundingSphere& bounds);

    /// Returns the factors of the tiles' weights, in [min_factor, 1].
    [[nodiscard]] const TileFactors& factors() const noexcept { return factors_; }
    /// Returns the weights of the tiles.
    [[nodiscard]] const EnvironmentTiles::Worth& worth() const noexcept { return worth_; }
    /// Returns where light of a tile enters the scene.
    [[nodiscard]] const EntryWindow& window(std::size_t tile) const noexcept
    {
        return windows_[tile];
    }

    /// Factor of a tile that no camera path reached.
    static constexpr float min_factor = 0.05f;

private:
    TileFactors factors_;
    EnvironmentTiles::Worth worth_;
    std::vector<EntryWindow> windows_;  // per tile
};

}  // namespace bdpt
