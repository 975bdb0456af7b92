#pragma once

#include <string>
#include <string_view>

#include "stage/prepared_scene.h"
#include "view/live_render.h"

namespace bdpt::app {

/// A file that a browser saves.
struct Download {
    int status = 200;     ///< HTTP status
    std::string type;     ///< "image/png"
    std::string name;     ///< for people; empty: none
    std::string content;  ///< contents, or the reason for a failure, one line
};

/// Returns "scene.exr" or "scene.png": the file that `bdpt render` would write for the same
/// samples, with that extension. Throws `Error`.
[[nodiscard]] Download saved_image(const LiveRender& render, const PreparedScene& stage,
                                   std::string_view extension);

/// Returns the exposure [EV] of files for screens. Throws `Error`.
[[nodiscard]] float compute_exposure(const LiveRender& render, const PreparedScene& stage,
                                     const Image& image);

}  // namespace bdpt::app
