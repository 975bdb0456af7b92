#pragma once

#include <bdpt/inspect.h>

#include <filesystem>
#include <optional>
#include <string>

#include "options/render_arguments.h"

namespace bdpt::app {

/// What `bdpt inspect` is to do.
struct InspectArguments {
    RenderArguments stage{};  ///< which scene, seen and rendered how
    PixelSample sample{};
    std::optional<std::filesystem::path> directions{};  ///< .png or .exr
    int vertex = 1;                                     ///< of whose directions
    int width = 512;                                    ///< of their images [pixels]
};

/// The options of `bdpt inspect`, as they are given.
struct InspectRequest {
    RenderRequest render{};  ///< what it shares with `bdpt render`; the rest is left alone
    InspectArguments arguments{};
};

extern const char* const inspect_footer;

/// Adds the options of `bdpt inspect`.
void add_inspect_options(OptionList& options, InspectRequest& request);

/// Throws `OptionError` for options that do not go together.
[[nodiscard]] InspectArguments checked(const InspectRequest& request, const OptionList& options);

}  // namespace bdpt::app
