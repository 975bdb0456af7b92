#pragma once

#include <bdpt/inspect.h>

#include <filesystem>
#include <optional>
#include <string>

#include "options/render_arguments.h"

namespace bdpt::app {

/// The words of `bdpt inspect` as they were given.
struct InspectWords {
    RenderWords render;  ///< what it shares with `bdpt render`; the rest is left alone
    std::string pixel;
    std::int64_t sample = 0;
    int vertex = 1;
    int width = 512;
    std::optional<std::string> directions{};
};

/// What `bdpt inspect` is to do.
struct InspectArguments {
    RenderArguments stage;  ///< which scene, seen and rendered how
    PixelSample sample;
    std::optional<std::filesystem::path> directions{};  ///< .png or .exr
    int vertex = 1;                                     ///< of whose directions
    int width = 512;                                    ///< of their images [pixels]
};

/// Describes the options of `bdpt inspect` to the parser, which will store into `words`.
void add_inspect_options(CLI::App& command, InspectWords& words);

/// Throws `Error` (usage) for words that make no sense.
[[nodiscard]] InspectArguments understand(const InspectWords& words);

}  // namespace bdpt::app
