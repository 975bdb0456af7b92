#pragma once

/// @file
/// Shows a scene in the browser while it renders: what the command `bdpt view` does.

#include <cstdint>
#include <functional>
#include <string>

namespace bdpt::job {
class Console;
class OptionList;
struct NetworkAddress;
}  // namespace bdpt::job

namespace bdpt::view {

/// Samples per pixel of a finished picture, unless --spp says otherwise.
inline constexpr std::int64_t view_samples = 4096;

/// Addresses of the page.
struct PageAddress {
    std::string url;       ///< with a secret, which requests need
    std::string url_once;  ///< leads to the page once, for command lines, which others can see
};

/// Serves the page of the render that `options` describe, those of `bdpt render`, and renders for
/// it on this thread until SIGINT, SIGTERM or SIGHUP. `on_listening` is called once it listens on
/// `address`, of which port 0 is any free one.
/// Throws `Error`: output if it cannot listen, and those of loading the scene.
void serve(const job::OptionList& options, const job::NetworkAddress& address,
           job::Console& console, const std::function<void(const PageAddress&)>& on_listening);

}  // namespace bdpt::view
