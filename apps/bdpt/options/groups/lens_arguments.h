#pragma once

#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <optional>

#include "options/option_list.h"

namespace bdpt::app {

/// Lens of a view.
struct LensChoice {
    std::optional<double> radius{};          ///< [m]
    std::optional<double> f_stop{};          ///< focal length over diameter
    std::optional<double> focus_distance{};  ///< [m]
};

/// Adds --lens-radius, --f-stop and --focus-distance.
void add_lens_options(OptionList& options, LensChoice& lens);

/// Throws `OptionError` for a lens that is given in two ways.
void check_lens_options(const OptionList& options);

/// Returns `camera` with `lens`. If neither `lens` nor the camera's own lens has a focus distance,
/// it focuses on the surface in the middle of the view of `scene`. Throws `Error` (usage) if there
/// is none, or if the camera cannot have a lens.
[[nodiscard]] CameraDesc with_lens(const LensChoice& lens, CameraDesc camera, const Scene& scene);

}  // namespace bdpt::app
