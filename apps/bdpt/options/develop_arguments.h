#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "options/groups/denoise_arguments.h"
#include "options/groups/display_arguments.h"
#include "options/option_list.h"
#include "options/part_arguments.h"

namespace bdpt::app {

/// Arguments of `bdpt develop`.
struct DevelopArguments {
    std::filesystem::path file{};  ///< .exr
    std::vector<std::filesystem::path> outputs{};
    DisplayArguments display{};
    std::optional<DenoiseArguments> denoise{};
    Printed printed{};
};

/// Options of `bdpt develop`, as given.
struct DevelopRequest {
    DevelopArguments arguments{};
    DenoiseArguments denoise{};
};

extern const char* const develop_footer;

/// Adds the options of `bdpt develop`.
void add_develop_options(OptionList& options, DevelopRequest& request);

/// Checks and converts the options. Throws `OptionError` for incompatible ones.
[[nodiscard]] DevelopArguments checked(const DevelopRequest& request, const OptionList& options);

}  // namespace bdpt::app
