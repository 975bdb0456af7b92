#pragma once

#include "geometry/ray.h"
#include "math/frame.h"
#include "math/pdf.h"

#include <bdpt/scene_desc.h>

#include <optional>
#include <vector>

namespace bdpt {

/// A primary ray. Importance over density is one: a camera subpath starts with beta = 1.
struct CameraRay {
    SegmentEnd lens;       ///< origin; ng is set if light can hit the lens
    Vec3 direction{0.0f};  ///< unit
    /// Density of the point on the lens; 1 for a pinhole and parallel rays.
    AreaPdf pdf_lens;
    SolidAnglePdf pdf_direction;  ///< density of the direction, for perspective
    std::optional<PlanarPdf>
        pdf_plane;  ///< orthographic: density of the ray's position; the direction is fixed
};

/// A connection from a scene point to the lens: the strategies with t = 1. The densities are those
/// with which generate_ray samples the reversed ray.
struct LensSample {
    SegmentEnd lens;
    Vec3 wi{0.0f};  ///< unit, from the scene point towards the lens
    float distance = 0.0f;
    Vec2 raster{0.0f};    ///< raster position of the scene point on the film [pixels]
    float weight = 0.0f;  ///< We |cos at lens| / (distance^2 pdf_lens); orthographic: We
    AreaPdf pdf_lens;
    SolidAnglePdf pdf_direction;
    std::optional<PlanarPdf> pdf_plane;
};

/// A light path that hit the lens by chance: the strategies with t = 0.
struct LensHit {
    SegmentEnd lens;
    float distance = 0.0f;
    Vec2 raster{0.0f};
    float importance = 0.0f;  ///< importance We
    AreaPdf pdf_lens;
    SolidAnglePdf pdf_direction;
};

/// Half-open rectangle of the film's plane [pixels].
struct RasterBounds {
    Vec2 min{0.0f};
    Vec2 max{0.0f};
};

/// A pinhole, thin-lens or orthographic camera. It samples the whole film uniformly, and its
/// importance We is normalised over the film: W * H camera paths and W * H light paths are equal
/// numbers of samples.
class Camera {
public:
    /// `width` and `height` are the film size [pixels].
    Camera(const CameraDesc& desc, int width, int height);
    /// Restricts connections to the lens to `visible`, which may extend beyond the film. The lens
    /// lies in `medium`.
    Camera(const CameraDesc& desc, int width, int height, const RasterBounds& visible,
           MediumId medium = MediumId::clear);

    /// Returns the camera in another pose, which `can_move` from the first.
    [[nodiscard]] Camera moved_to(const Mat4& world_from_camera) const;

    [[nodiscard]] bool is_perspective() const { return perspective_; }
    /// Tests whether light can hit the lens by chance.
    [[nodiscard]] bool has_finite_lens() const { return lens_radius_ > 0.0f; }

    /// Returns the ray through `raster` [pixels, origin at the top left], which may lie beside the
    /// film. `u_lens` selects the point on a finite lens.
    [[nodiscard]] CameraRay generate_ray(Vec2 raster, Vec2 u_lens) const;
    /// Returns a world vector in the axes of the camera, those of glTF.
    [[nodiscard]] Vec3 to_local(Vec3 world_vector) const;
    /// Returns the width of a pixel of the film in the scene; the narrower side of a pixel that is
    /// not square.
    [[nodiscard]] const PixelCone& pixel_cone() const { return pixel_cone_; }
    /// Returns the distance of a point along the camera's axis [m]; positive in front.
    [[nodiscard]] float depth(Vec3 scene_point) const;
    /// Returns the raster position at which the middle of the lens sees a point; nullopt if it is
    /// not in front of the lens.
    [[nodiscard]] std::optional<Vec2> project(Vec3 scene_point) const;
    /// Samples a point on the lens; nullopt if the scene point is behind the lens or appears
    /// outside of the visible bounds.
    [[nodiscard]] std::optional<LensSample> sample_lens(Vec3 scene_point, Vec2 u_lens) const;
    /// Intersects a ray with unit `direction` with a finite lens, from the front.
    [[nodiscard]] std::optional<LensHit> hit_lens(Vec3 origin, Vec3 direction) const;

private:
    void look_from(const Mat4& world_from_camera);
    [[nodiscard]] bool is_visible(Vec2 raster) const;
    [[nodiscard]] Vec3 lens_point(Vec2 u_lens) const;  // in local coordinates
    [[nodiscard]] SegmentEnd lens_end(Vec3 local_point) const;
    /// Returns the density of a direction at the lens, given its length per unit along the axis (1
    /// / cos).
    [[nodiscard]] SolidAnglePdf compute_pdf(float inv_cos) const;
    /// Returns the raster position of the ray from a lens point in the local direction `d`
    /// [pixels].
    [[nodiscard]] Vec2 compute_raster(Vec3 lens, Vec3 d) const;
    /// Returns the raster position of a local point for an orthographic camera [pixels].
    [[nodiscard]] Vec2 compute_parallel_raster(Vec3 local_point) const;

    Vec3 position_;
    MediumId medium_;
    Mat3 world_from_camera_;  // orthonormal
    Vec2 film_size_;          // [pixels]
    RasterBounds visible_;
    bool perspective_;
    Vec2 half_extent_;  // half size of the film: one unit in front of the lens; orthographic: in
                        // the world [m]
    Vec2 axis_;         // distance of the axis from the film's left and top edge, in half sizes of
                        // the film; (1, 1): in the middle
    float film_area_;   // area of the whole film at that distance
    float lens_radius_;
    float focus_distance_;
    AreaPdf pdf_lens_{1.0f};
    PixelCone pixel_cone_;
};

/// A camera while the shutter is open.
class MovingCamera {
public:
    /// Constructs a static camera.
    explicit MovingCamera(const Camera& camera) : first_(camera) {}
    /// `camera` is `desc` on its film; moves as `desc` does.
    MovingCamera(const CameraDesc& desc, const Camera& camera)
        : first_(camera), pose_(desc.world_from_camera), motion_(desc.motion)
    {}

    [[nodiscard]] bool moves() const { return !motion_.empty(); }
    /// Returns the camera at shutter open.
    [[nodiscard]] const Camera& first() const { return first_; }
    /// Returns the camera at a time in [0, 1]: its matrix is interpolated linearly between steps,
    /// its axes stay orthonormal.
    [[nodiscard]] Camera at(float time) const;

private:
    Camera first_;
    Mat4 pose_{1.0f};  ///< at shutter open
    std::vector<Mat4> motion_;
};

/// A moving camera at one time; a static camera is not copied, and must outlive this.
class TimedCamera {
public:
    TimedCamera(const MovingCamera& camera, float time)
        : moved_(camera.moves() ? std::optional(camera.at(time)) : std::nullopt),
          camera_(moved_ ? *moved_ : camera.first())
    {}
    TimedCamera(const TimedCamera&) = delete;
    TimedCamera& operator=(const TimedCamera&) = delete;

    [[nodiscard]] const Camera& get() const { return camera_; }

private:
    std::optional<Camera> moved_;
    const Camera& camera_;
};

}  // namespace bdpt
