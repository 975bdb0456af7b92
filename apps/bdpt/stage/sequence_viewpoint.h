#pragma once

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// Returns the camera of `image`, one of a sequence, which orbits on request; else `first`, the one
/// that the scene was loaded with. Throws `Error`.
[[nodiscard]] Viewpoint sequence_viewpoint(const PreparedScene& stage, const Viewpoint& first,
                                           const RenderArguments& image);

/// Returns `still` for a view of a turntable at `angle` [rad] around the object, with the
/// environment turned along with the camera.
[[nodiscard]] Scene with_turned_environment(const Scene& still, double angle);

}  // namespace bdpt::app
