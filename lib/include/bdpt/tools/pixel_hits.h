#pragma once

/// @file
/// Finds the surface in the middle of each pixel, and where it is in another frame: depth, masks
/// and optical flow without the mixtures at edges that means over a pixel have.
///
/// @code{.cpp}
/// void print_depth(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     const bdpt::PixelHits seen = bdpt::pixel_hits(scene, camera, 640, 480);
///     if (const auto& hit = seen.at(320, 240)) {
///         std::cout << hit->distance << " m from the camera\n";
///     }
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/film/id_film.h>
#include <bdpt/scene_desc.h>
#include <bdpt/tools/ray_query.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bdpt {

class Scene;

/// What the rays through the middles of an image's pixels hit first.
struct PixelHits {
    int width = 0;
    int height = 0;
    std::vector<std::optional<SurfaceHit>> hits;  ///< row by row from the top left

    /// Returns what pixel (x, y) shows; none if it is empty there.
    [[nodiscard]] const std::optional<SurfaceHit>& at(int x, int y) const
    {
        return hits[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)];
    }
};

/// Returns the first hits of the camera at the opening of its shutter, from the middle of its lens,
/// as by `first_hit`. Throws `Error` (usage) as `first_hit`, and for a size below 1.
[[nodiscard]] BDPT_EXPORT PixelHits pixel_hits(const Scene& scene, const CameraDesc& camera,
                                               int width, int height);

/// The integers that stand for the things of a kind in masks, and their names.
struct IdNumbers {
    std::vector<std::uint32_t> of_instances;  ///< by index of the instance, from 1 on
    /// Name `i` is that of integer `i`: "" of 0, which is nothing, then those of `IdFilm::names`.
    std::vector<std::string> names;
};

/// Returns the integers of all things of a kind in the scene, whether visible or not.
[[nodiscard]] BDPT_EXPORT IdNumbers id_numbers(const Scene& scene, IdKind kind);

/// Returns the integers of what pixels show, row by row. The spheres of lights count as nothing.
/// `numbers` are those of the scene in which the pixels were seen.
[[nodiscard]] BDPT_EXPORT std::vector<std::uint32_t> id_mask(const PixelHits& seen,
                                                             const IdNumbers& numbers);

/// The motion of what a pixel shows.
struct PixelFlow {
    Vec2 motion{0.0f};        ///< [pixels], to the right and downwards
    bool is_visible = false;  ///< the same point is visible in the other frame
};

/// Returns the optical flow from the pixels of `seen` to the image of the same size that `camera`
/// has of `later`: the scene in which they were seen, or the same file at another time, whose
/// instances and triangles have the same indices. It follows points of surfaces, also of deforming
/// ones. Without a surface, or for a point behind the camera, the motion is 0 and not visible.
[[nodiscard]] BDPT_EXPORT std::vector<PixelFlow> optical_flow(const PixelHits& seen,
                                                              const Scene& later,
                                                              const CameraDesc& camera);

}  // namespace bdpt
