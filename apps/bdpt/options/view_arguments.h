#pragma once

#include <filesystem>
#include <string>

#include "options/option_list.h"
#include "options/render_arguments.h"
#include "options/values/viewer_address.h"

namespace bdpt::app {

/// Where `bdpt view` listens, and what it shows.
struct ViewArguments {
    DisplayAddress listen{.host = "127.0.0.1", .port = "0"};  ///< port 0: any that is free
    bool opens_browser = false;
    RenderArguments stage{};
};

/// The options of `bdpt view`, as they are given.
struct ViewRequest {
    RenderRequest render{};  ///< what it shares with `bdpt render`; the rest is left alone
    ViewArguments arguments{};
};

extern const char* const view_footer;
extern const char* const view_short_footer;

/// Samples per pixel after which a picture is done, unless --spp says otherwise.
inline constexpr std::int64_t view_samples = 4096;

/// "HOST", "HOST:PORT", ":PORT" or "[IPV6]:PORT"; without a port, or with 0, any that is free.
[[nodiscard]] std::optional<DisplayAddress> parse_listen_address(const std::string& text);

/// Adds the options of `bdpt view`: those of `bdpt render` that say what is seen, and its own.
void add_view_command_options(OptionList& options, ViewRequest& request);

/// Gives `options`, those of `bdpt view`, what the job in `file` says of the picture, but for options
/// that were given already. The rest, such as names of outputs, is checked and left out. Throws
/// `Error` like `load_job`.
void load_viewed_job(const std::filesystem::path& file, OptionList& options);

/// Throws `OptionError` for options that do not go together.
[[nodiscard]] ViewArguments checked(const ViewRequest& request, const OptionList& options);

}  // namespace bdpt::app
