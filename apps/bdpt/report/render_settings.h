#pragma once

#include <nlohmann/json_fwd.hpp>

#include "options/render_arguments.h"
#include "stage/stage.h"

namespace bdpt::app {

/// All that the picture depends on.
[[nodiscard]] nlohmann::ordered_json settings_of(const RenderArguments& arguments,
                                                 const Stage& stage);

}  // namespace bdpt::app
