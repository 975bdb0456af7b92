#pragma once

#include <string>
#include <string_view>

#include "stage/prepared_scene.h"
#include "view/live_render.h"

namespace bdpt::app {

/// A file that a browser keeps.
struct Download {
    int status = 200;     ///< of HTTP
    std::string type;     ///< "image/png"
    std::string name;     ///< for people; empty: there is none
    std::string content;  ///< or why there is none, one line
};

/// "scene.exr" or "scene.png": what `bdpt render` would write of the same samples, in a file of
/// that extension. Throws `Error`.
[[nodiscard]] Download saved_image(const LiveRender& render, const PreparedScene& stage,
                                   std::string_view extension);

/// Exposure [EV] of what files for screens show. Throws `Error`.
[[nodiscard]] float exposure_of(const LiveRender& render, const PreparedScene& stage,
                                const Image& image);

}  // namespace bdpt::app
