#pragma once

#include <nlohmann/json_fwd.hpp>

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// All that the image depends on.
[[nodiscard]] nlohmann::ordered_json settings_of(const RenderArguments& arguments,
                                                 const PreparedScene& stage);

}  // namespace bdpt::app
