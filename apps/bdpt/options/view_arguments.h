#pragma once

#include <bdpt/inspect.h>

#include <filesystem>
#include <optional>
#include <string>

#include "options/arguments.h"
#include "options/option_list.h"
#include "options/render_arguments.h"

namespace bdpt::app {

/// Arguments of `bdpt view`.
struct ViewArguments {
    DisplayAddress listen{.host = "127.0.0.1", .port = "0"};  ///< port 0: any free port
    bool opens_browser = false;
    RenderArguments stage{};
};

/// Options of `bdpt view`, as given.
struct ViewRequest {
    RenderRequest render{};  ///< options shared with `bdpt render`; the rest is unused
    ViewArguments arguments{};
};

extern const char* const view_footer;
extern const char* const view_short_footer;

/// Samples per pixel of a finished picture, unless --spp says otherwise.
inline constexpr std::int64_t view_samples = 4096;

/// Parses "HOST", "HOST:PORT", ":PORT" or "[IPV6]:PORT", or "PORT" of this machine; without a port,
/// or with 0, any free one.
[[nodiscard]] std::optional<DisplayAddress> parse_listen_address(const std::string& typed);

/// Adds the options of `bdpt view`: those of `bdpt render` that select what is shown, and its own.
void add_view_command_options(OptionList& options, ViewRequest& request);

/// Stores the picture's options of the job in `file` into `options`, those of `bdpt view`, except
/// options that were already given. Other options, such as output names, are checked and ignored.
/// Throws `Error` like `load_job`.
void load_viewed_job(const std::filesystem::path& file, OptionList& options);

/// Checks and converts the options. Throws `OptionError` for incompatible ones.
[[nodiscard]] ViewArguments checked(const ViewRequest& request, const OptionList& options);

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
