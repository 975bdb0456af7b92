#pragma once

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// The camera of `image`, one of a sequence, which goes around if that is asked for; else `first`,
/// the one that the scene was loaded with. Throws `Error`.
[[nodiscard]] Viewpoint sequence_viewpoint(const PreparedScene& stage, const Viewpoint& first,
                                           const RenderArguments& image);

/// `still` as a view of a turntable shows it, that has gone by `angle` [rad] around the object,
/// when the environment goes with the camera.
[[nodiscard]] Scene with_turned_environment(const Scene& still, double angle);

}  // namespace bdpt::app
