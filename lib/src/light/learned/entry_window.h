#pragma once

#include "math/pdf.h"

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <array>
#include <cstddef>
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
        constexpr float min_cosine = 0.25f;
        return size_.x > 0.0f && -dot(direction, normal_) > min_cosine;
    }
    /// Samples a point on the plane; the window admits some direction.
    [[nodiscard]] Vec3 sample(Vec2 u) const noexcept;
    /// Returns the density of rays of this direction, which it admits, through `p`, on the plane
    /// perpendicular to them; 0 beside the grid.
    [[nodiscard]] PlanarPdf pdf(Vec3 p, Vec3 direction) const noexcept;
    /// Returns the integral of the root of the throughput per area over the plane [m].
    [[nodiscard]] double root_of_throughput() const noexcept { return root_of_throughput_; }

private:
    static constexpr std::size_t side = 16;  // cells
    using Cells = std::array<double, side * side>;

    /// Returns where the line through `p` crosses the plane [m].
    [[nodiscard]] Vec2 project(Vec3 p, Vec3 direction) const noexcept;
    void fill(const Cells& throughputs);

    Vec3 origin_{0.0f};
    Vec3 x_{0.0f};  // axes of the plane
    Vec3 y_{0.0f};
    Vec3 normal_{0.0f};
    Vec2 corner_{0.0f};
    Vec2 size_{0.0f};
    std::array<float, side * side + 1> sums_{};  // probabilities of the cells before each
    double root_of_throughput_ = 0.0;
};

}  // namespace bdpt
