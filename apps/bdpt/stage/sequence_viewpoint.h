#pragma once

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// The camera of `image`, one of a sequence, which goes around if that is asked for; else `first`,
/// the one that the scene was loaded with. Throws `Error`.
[[nodiscard]] Viewpoint sequence_viewpoint(const PreparedScene& stage, const Viewpoint& first,
                                           const RenderArguments& image);

}  // namespace bdpt::app
