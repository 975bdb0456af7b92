#pragma once

#include <filesystem>
#include <string>

#include "options/option_list.h"
#include "options/render_arguments.h"
#include "options/values/viewer_address.h"

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

}  // namespace bdpt::app
