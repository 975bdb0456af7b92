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
    DenoiseArguments denoise{};
    Printed printed{};
};

extern const char* const develop_footer;

/// Adds the options of `bdpt develop`.
void add_develop_options(OptionList& options, DevelopArguments& arguments);

/// Throws `OptionError` for incompatible options.
void check(const DevelopArguments& arguments, const OptionList& options);

}  // namespace bdpt::app
