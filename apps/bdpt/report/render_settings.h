#pragma once

#include <bdpt/io/image_metadata.h>

#include <nlohmann/json_fwd.hpp>

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// All that the image depends on.
[[nodiscard]] nlohmann::ordered_json settings_of(const RenderArguments& arguments,
                                                 const PreparedScene& stage);

/// What files tell about the image; samples and times are filled in when it is rendered.
[[nodiscard]] io::ImageMetadata metadata_of(const RenderArguments& arguments,
                                            const PreparedScene& stage,
                                            const nlohmann::ordered_json& settings);

}  // namespace bdpt::app
