#pragma once

/// @file
/// Converts cameras from and to the numbers of computer vision.
///
/// @code{.cpp}
/// bdpt::CameraDesc camera;
/// const bdpt::Intrinsics measured{.fx = 702.5, .fy = 701.9, .cx = 318.2, .cy = 241.6};
/// bdpt::set_intrinsics(camera, measured, 640, 480);
/// @endcode

#include <bdpt/export.h>
#include <bdpt/scene_desc.h>

namespace bdpt {

/// Focal lengths and principal point of a perspective camera [pixels]. A point (x, y, z) of
/// OpenCV's axes (x right, y down, z forward) appears at (fx x / z + cx, fy y / z + cy) from the
/// top left corner of the image; the middle of the first pixel is at (0.5, 0.5).
struct Intrinsics {
    double fx = 0.0;
    double fy = 0.0;
    double cx = 0.0;
    double cy = 0.0;
};

// These functions are bit-identical on all machines.

/// Returns the numbers of a perspective camera whose image has `width` x `height` pixels.
[[nodiscard]] BDPT_EXPORT Intrinsics intrinsics(const CameraDesc& camera, int width, int height);

/// Sets field of view, pixel aspect and lens shift of `camera` for images of `width` x `height`
/// pixels. `values` are finite, the focal lengths above 0.
BDPT_EXPORT void set_intrinsics(CameraDesc& camera, const Intrinsics& values, int width,
                                int height);

/// Returns the focal length [pixels] with which `extent` pixels fill an angle [rad] in (0, pi).
[[nodiscard]] BDPT_EXPORT double focal_length(double angle, int extent);

/// Returns that angle.
[[nodiscard]] BDPT_EXPORT double angle_of_view(double focal_length, int extent);

}  // namespace bdpt
