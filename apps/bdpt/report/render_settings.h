#pragma once

#include <bdpt/io/image_metadata.h>

#include <nlohmann/json_fwd.hpp>

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// Returns all settings that the image depends on.
[[nodiscard]] nlohmann::ordered_json make_settings(const RenderArguments& arguments,
                                                   const PreparedScene& stage);

/// Returns the metadata of image files; samples and times are filled in after rendering.
[[nodiscard]] io::ImageMetadata make_metadata(const RenderArguments& arguments,
                                              const PreparedScene& stage,
                                              const nlohmann::ordered_json& settings);

}  // namespace bdpt::app
