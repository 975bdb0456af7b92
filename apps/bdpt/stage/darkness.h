#pragma once

#include <bdpt/render_options.h>

#include <optional>
#include <string>

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// The share of what the camera sees that would be black, by a small render with few samples; 0
/// when it sees nothing. Exposure [EV] is that of the image; none: automatic.
[[nodiscard]] double dark_share(const PreparedScene& stage, RenderOptions options,
                                const std::optional<float>& exposure);

/// That the image will show next to nothing, and what helps.
[[nodiscard]] std::optional<std::string> warning_of_darkness(const RenderArguments& arguments,
                                                             const PreparedScene& stage);

}  // namespace bdpt::app
