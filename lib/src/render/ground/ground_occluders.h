#pragma once

#include "scene/scene_geometry.h"

#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace bdpt {

/// For each place of a level ground, the directions in which the scene may stand while the shutter
/// is open. Light from all others is never blocked, so that it needs no shadow rays
/// (docs/decisions/0064-light-that-the-ground-may-lose.md).
class GroundOccluders {
public:
    /// Directions are in strips of equal azimuth, and in rows of equal polar angle from straight up
    /// (0) to the horizon.
    static constexpr std::size_t strips = 64;
    static constexpr std::size_t rows = 128;
    /// Of a strip: those rows that the scene may block; none if `begin` is `end`.
    struct Rows {
        std::uint8_t begin = 0;
        std::uint8_t end = 0;
    };
    /// Places are in as many rows of as many.
    static constexpr std::size_t side = 64;
    using Skyline = std::array<Rows, strips>;

    /// Of what stands above `height`. Does not refer to the geometry later.
    GroundOccluders(const SceneGeometry& geometry, float height);

    /// Does nothing stand above the ground? Then there are no places.
    [[nodiscard]] bool empty() const { return skylines_.empty(); }
    [[nodiscard]] std::size_t place_count() const { return skylines_.size(); }
    /// The place of a point on the ground: a cell of a grid that is fine under the scene and ever
    /// coarser around it.
    [[nodiscard]] std::size_t place(Vec3 p) const;
    /// A point of a place, x and z, for `within` in [0, 1)^2; of the last places, some point.
    [[nodiscard]] Vec2 point(std::size_t place, Vec2 within) const;
    [[nodiscard]] const Skyline& skyline(std::size_t place) const { return skylines_[place]; }
    /// May the scene block light from the unit direction `to_light`? False is certain.
    [[nodiscard]] bool may_block(std::size_t place, Vec3 to_light) const;

    /// Azimuth of a direction, or of a vector to what stands there: from 0 to `strips`.
    [[nodiscard]] static float azimuth(float x, float z);

private:
    Vec2 center_{0.0f};   // x and z of the scene's middle
    float reach_ = 1.0f;  // [m] a quarter of the places are nearer, in x and in z
    std::vector<Skyline> skylines_;
};

}  // namespace bdpt
