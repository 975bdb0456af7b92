#pragma once

/// @file
/// Counts the rays and the paths of a render.
///
/// @code{.cpp}
/// void print_rays(const bdpt::RenderResult& result)
/// {
///     const auto rays = static_cast<double>(result.stats.rays.total());
///     std::cout << rays / result.seconds << " rays a second\n";
/// }
/// @endcode

#include <cstdint>

namespace bdpt {

/// Rays traced through the scene, by purpose.
struct RayCounts {
    std::uint64_t camera = 0;  ///< rays of camera subpaths
    std::uint64_t light = 0;   ///< rays of light subpaths
    /// Shadow rays between two points, or to a light at infinity.
    std::uint64_t shadow = 0;
    std::uint64_t aov = 0;  ///< rays for AOVs, including shadow rays from the ground
    /// Part of `shadow`: from light subpaths to the lens (t = 1).
    std::uint64_t shadow_to_lens = 0;
    std::uint64_t shadow_interior = 0;  ///< part of `shadow`: between both subpaths (s, t >= 2)

    [[nodiscard]] std::uint64_t total() const { return camera + light + shadow + aov; }
    [[nodiscard]] bool operator==(const RayCounts&) const = default;
};

/// Subpaths that were started.
struct PathCounts {
    std::uint64_t camera = 0;
    std::uint64_t light = 0;
    [[nodiscard]] bool operator==(const PathCounts&) const = default;
};

/// Amount of work of a render. Like the image, it depends on scene, camera and options only.
struct RenderStats {
    RayCounts rays;
    PathCounts paths;

    RenderStats& operator+=(const RenderStats& other)
    {
        rays.camera += other.rays.camera;
        rays.light += other.rays.light;
        rays.shadow += other.rays.shadow;
        rays.aov += other.rays.aov;
        rays.shadow_to_lens += other.rays.shadow_to_lens;
        rays.shadow_interior += other.rays.shadow_interior;
        paths.camera += other.paths.camera;
        paths.light += other.paths.light;
        return *this;
    }
    [[nodiscard]] bool operator==(const RenderStats&) const = default;
};

}  // namespace bdpt
