#pragma once

#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <optional>

namespace CLI {
class App;
}

namespace bdpt::app {

/// What the words after `bdpt render` say about the lens, as they were given.
struct LensWords {
    std::optional<double> radius;          // [m]
    std::optional<double> f_stop;          // focal length over diameter
    std::optional<double> focus_distance;  // [m]
};

void add_lens_options(CLI::App& command, LensWords& words);

/// Throws `Error` (usage) that names the option and the value.
void check_lens(const LensWords& words);

/// `camera` with the lens of `words`, which have been checked. Focused on what `scene` shows in the
/// middle of the view, if neither `words` nor the camera's own lens say where. Throws `Error`
/// (usage) when that is nothing, or the camera can have no lens.
[[nodiscard]] CameraDesc with_lens(const LensWords& words, CameraDesc camera, const Scene& scene);

}  // namespace bdpt::app
