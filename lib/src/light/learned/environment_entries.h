#pragma once

#include "light/bounding_sphere.h"
#include "light/environment/environment_tiles.h"
#include "light/learned/entry_window.h"
#include "math/pdf.h"

#include <bdpt/types.h>

#include <cstddef>
#include <vector>

namespace bdpt {

/// The directions and places from which an environment's light enters the scene on its way to what
/// the camera sees, as a pilot learned them by tiles of the environment
/// (docs/decisions/0073-learned-entries.md). Light paths start there; no density is zero.
class EnvironmentEntries {
public:
    /// A ray's entry into the scene.
    struct Entry {
        Vec3 p{0.0f};   ///< in front of the whole scene
        PlanarPdf pdf;  ///< density on the plane perpendicular to the ray
    };

    EnvironmentEntries(std::vector<Escape> escapes, const EnvironmentTiles& tiles,
                       const BoundingSphere& bounds);

    /// Returns the factors of the tiles' weights, in [min_factor, 1].
    [[nodiscard]] const TileFactors& tiles() const noexcept { return factors_; }
    /// Samples the entry of light that travels in `direction`, coming from `tile`.
    [[nodiscard]] Entry sample(std::size_t tile, Vec3 direction, Vec2 u) const noexcept;
    /// Returns the density of the entry of such light through `p`.
    [[nodiscard]] PlanarPdf pdf(std::size_t tile, Vec3 direction, Vec3 p) const noexcept;

    /// Factor of a tile that no camera path reached.
    static constexpr float min_factor = 0.05f;
    /// Fraction of entries that are uniform over the disk in front of the scene.
    static constexpr float uniform_part = 0.1f;

private:
    BoundingSphere bounds_;
    TileFactors factors_;
    std::vector<EntryWindow> windows_;  // per tile
};

}  // namespace bdpt
