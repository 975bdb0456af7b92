#pragma once

#include <optional>
#include <string>

#include "options/option_list.h"
#include "options/values/view.h"

namespace bdpt::app {

/// Adds --camera, stored in `camera`, and the options that change or frame a view.
void add_camera_options(OptionList& options, std::optional<std::string>& camera,
                        ViewOverrides& view);

/// Throws `OptionError` if the given options are incompatible.
void check_camera_options(const OptionList& options, const std::optional<std::string>& camera);

}  // namespace bdpt::app
