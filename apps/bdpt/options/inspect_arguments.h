#pragma once

#include <bdpt/inspect.h>

#include <filesystem>
#include <optional>
#include <string>

#include "options/render_arguments.h"

namespace bdpt::app {

/// Arguments of `bdpt inspect`.
struct InspectArguments {
    RenderArguments stage{};  ///< scene, view and render options
    PixelSample sample{};
    std::optional<std::filesystem::path> directions{};  ///< .png or .exr
    int vertex = 1;   ///< index of the vertex whose directions are shown
    int width = 512;  ///< width of images of directions [pixels]
};

/// Options of `bdpt inspect`, as given.
struct InspectRequest {
    RenderRequest render{};  ///< options shared with `bdpt render`; the rest is unused
    InspectArguments arguments{};
};

extern const char* const inspect_footer;

/// Adds the options of `bdpt inspect`.
void add_inspect_options(OptionList& options, InspectRequest& request);

/// Checks and converts the options. Throws `OptionError` for incompatible ones.
[[nodiscard]] InspectArguments checked(const InspectRequest& request, const OptionList& options);

}  // namespace bdpt::app
