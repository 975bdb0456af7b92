#pragma once

#include "math/distribution_2d.h"
#include "math/pdf.h"

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace bdpt {

/// A camera path of a pilot that was scattered and then left the scene.
struct Escape {
    Vec3 p{0.0f};             ///< last vertex in the scene, in world space
    Vec3 direction{0.0f};     ///< unit, towards the environment
    std::size_t tile = 0;     ///< tile of the environment that it reached
    float throughput = 0.0f;  ///< luminance, >= 0 and finite
};

/// Density of the places where light from similar directions enters the scene: a grid on a plane
/// that these directions cross steeply.
class EntryWindow {
public:
    EntryWindow() = default;  ///< admits nothing
    /// Learns from `escapes` in similar directions. The plane contains `origin`; the grid exceeds
    /// the escapes by `margin` [m], which is positive. The density is proportional to the root of
    /// their throughput per area.
    EntryWindow(std::span<const Escape> escapes, Vec3 origin, float margin);

    /// Tests whether light that travels in this direction enters here, at a steep angle.
    [[nodiscard]] bool admits(Vec3 direction) const noexcept
    {
        return cells_ && is_steep(-direction);
    }
    /// Samples a point on the plane; the window admits some direction.
    [[nodiscard]] Vec3 sample(Vec2 u) const noexcept;
    /// Returns the density of rays of this direction, which it admits, through `p`, on the plane
    /// perpendicular to them; 0 beside the grid.
    [[nodiscard]] PlanarPdf pdf(Vec3 p, Vec3 direction) const noexcept;
    /// Returns the integral of the root of the throughput per area over the plane [m].
    [[nodiscard]] double root_of_throughput() const noexcept { return root_of_throughput_; }

private:
    /// Tests whether a direction towards the environment crosses the plane at a steep angle.
    [[nodiscard]] bool is_steep(Vec3 direction) const noexcept
    {
        constexpr float min_cosine = 0.25f;
        return dot(direction, normal_) > min_cosine;
    }
    /// Returns where the line through `p` crosses the plane, in the grid's [0, 1)^2.
    [[nodiscard]] Vec2 project(Vec3 p, Vec3 direction) const noexcept;

    Vec3 origin_{0.0f};
    Vec3 x_{0.0f};  // axes of the plane
    Vec3 y_{0.0f};
    Vec3 normal_{0.0f};
    Vec2 corner_{0.0f};
    Vec2 size_{1.0f};
    std::optional<Distribution2D> cells_;
    double root_of_throughput_ = 0.0;
};

}  // namespace bdpt
