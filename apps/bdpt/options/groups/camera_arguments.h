#pragma once

#include <optional>
#include <string>

#include "options/option_list.h"
#include "options/values/view.h"

namespace bdpt::app {

/// Adds --camera, which goes to `camera`, and what changes or frames a view.
void add_camera_options(OptionList& options, std::optional<std::string>& camera,
                        ViewOverrides& view);

/// Throws `OptionError` when those that were given do not go together.
void check_camera_options(const OptionList& options, const std::optional<std::string>& camera);

}  // namespace bdpt::app
