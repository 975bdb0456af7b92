#pragma once

#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <optional>

#include "options/option_list.h"

namespace bdpt::app {

/// The lens that a view gets.
struct LensChoice {
    std::optional<double> radius{};          ///< [m]
    std::optional<double> f_stop{};          ///< focal length over diameter
    std::optional<double> focus_distance{};  ///< [m]
};

/// Adds --lens-radius, --f-stop and --focus-distance.
void add_lens_options(OptionList& options, LensChoice& lens);

/// Throws `OptionError` for a lens that is given in two ways.
void check_lens_options(const OptionList& options);

/// `camera` with `lens`. Focused on what `scene` shows in the middle of the view, if neither `lens`
/// nor the camera's own lens say where. Throws `Error` (usage) when that is nothing, or the camera
/// can have no lens.
[[nodiscard]] CameraDesc with_lens(const LensChoice& lens, CameraDesc camera, const Scene& scene);

}  // namespace bdpt::app
