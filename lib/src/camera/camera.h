#pragma once

#include "geometry/ray.h"
#include "math/pdf.h"

#include <bdpt/scene_desc.h>

#include <optional>

namespace bdpt {

/// A primary ray. Importance over density is one: a camera subpath starts with beta = 1.
struct CameraRay {
    Ray ray;  ///< unit direction
    SolidAnglePdf pdf_direction;
};

/// A connection from a scene point to the lens: the strategies with t = 1.
struct LensSample {
    Vec3 p{0.0f};   ///< point on the lens
    Vec3 wi{0.0f};  ///< unit, from the scene point towards p
    float distance = 0.0f;
    Vec2 raster{0.0f};            ///< where the scene point appears on the film [pixels]
    float weight = 0.0f;          ///< We |cos at lens| / (distance^2 pdf of p)
    SolidAnglePdf pdf_direction;  ///< of generate_ray sampling the reversed direction
};

/// Half-open rectangle of the film's plane [pixels].
struct RasterBounds {
    Vec2 min{0.0f};
    Vec2 max{0.0f};
};

/// A pinhole camera. It samples the whole film uniformly, and its importance We is normalised over
/// the film: W * H camera paths and W * H light paths are equal numbers of samples.
class Camera {
public:
    /// `width`, `height`: film size [pixels].
    Camera(const CameraDesc& desc, int width, int height);
    /// Connections to the lens are wanted within `visible` only; it may reach beyond the film.
    Camera(const CameraDesc& desc, int width, int height, const RasterBounds& visible);

    [[nodiscard]] Vec3 position() const { return position_; }
    /// The ray through `raster` [pixels, origin at the top left], which may lie beside the film.
    [[nodiscard]] CameraRay generate_ray(Vec2 raster) const;
    /// Distance of a point along the camera's axis [m]; positive in front.
    [[nodiscard]] float depth(Vec3 scene_point) const;
    /// Nothing when the point is behind the lens or appears outside of the visible bounds.
    [[nodiscard]] std::optional<LensSample> sample_lens(Vec3 scene_point) const;

private:
    Vec3 position_;
    Mat3 world_from_camera_;  // orthonormal
    Vec2 film_size_;          // [pixels]
    RasterBounds visible_;
    Vec2 half_extent_;  // of the film one unit in front of the lens
    float film_area_;   // of the whole film there
};

}  // namespace bdpt
