#pragma once

#include "scene/scene_geometry.h"

#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// For each place of a horizontal ground, the directions that the scene may occlude while the
/// shutter is open. Light from all others is never blocked, so that it needs no shadow rays
/// (docs/decisions/0064-light-that-the-ground-may-lose.md).
class GroundOccluders {
public:
    /// Directions are divided into strips of equal azimuth, and rows of equal polar angle from the
    /// zenith (0) to the horizon.
    static constexpr std::size_t strips = 64;
    static constexpr std::size_t rows = 128;
    /// Rows of a strip that the scene may block; empty if `begin` is `end`.
    struct Rows {
        std::uint8_t begin = 0;
        std::uint8_t end = 0;
    };
    /// Number of rows of places, and of places in a row.
    static constexpr std::size_t side = 64;
    using Skyline = std::array<Rows, strips>;

    /// Finds the occluders above `height`. Keeps no reference to the geometry.
    GroundOccluders(const SceneGeometry& geometry, float height);

    /// Tests whether nothing stands above the ground. Then there are no places.
    [[nodiscard]] bool empty() const { return skylines_.empty(); }
    [[nodiscard]] std::size_t place_count() const { return skylines_.size(); }
    /// Returns the place of a point on the ground: a cell of a grid that is fine under the scene
    /// and coarser with distance; row (z) * `side` + column (x).
    [[nodiscard]] std::size_t place(Vec3 p) const;
    /// Returns a point of a place, x and z, for `within` in [0, 1)^2; for the outermost places,
    /// some point.
    [[nodiscard]] Vec2 point(std::size_t place, Vec2 within) const;
    [[nodiscard]] const Skyline& skyline(std::size_t place) const { return skylines_[place]; }
    /// Tests whether the scene may block light from the unit direction `to_light`. False is
    /// certain.
    [[nodiscard]] bool may_block(std::size_t place, Vec3 to_light) const;

    /// Returns the azimuth of a direction, or of a vector to an occluder: from 0 to `strips`.
    [[nodiscard]] static float azimuth(float x, float z);

private:
    Vec2 center_{0.0f};   // x and z of the scene's centre
    float reach_ = 1.0f;  // a quarter of the places are nearer than this [m], in x and in z
    std::vector<Skyline> skylines_;
};

}  // namespace bdpt
