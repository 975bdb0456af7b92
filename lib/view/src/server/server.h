#pragma once

#include <bdpt/view.h>

#include <memory>
#include <string>
#include <string_view>

#include "session/session.h"

namespace bdpt::view {

/// The server of `bdpt view`: the page, a web socket for each window, files. It runs on one thread
/// and never waits for a slow reader: each window has one picture in flight, and newer ones replace
/// the waiting one. What an audience does is thread-safe.
class Server : public Audience {
public:
    [[nodiscard]] virtual PageAddress page_address() const = 0;
    /// Serves what `session` renders, on a thread of its own, until `stop()`. SIGINT, SIGTERM and
    /// SIGHUP stop the session; a second one ends the process.
    virtual void start(Session& session) = 0;
    /// Stops serving.
    virtual void stop() = 0;
};

/// Starts to listen. Throws `Error` (output) if that fails.
[[nodiscard]] std::unique_ptr<Server> make_server(const NetworkAddress& address);

/// Returns the self-contained page of `bdpt view`.
[[nodiscard]] std::string view_page();

// Parts of the page: files of lib/view/src/page, and those shared with the report of bdpt bench.
[[nodiscard]] std::string_view page_template();
[[nodiscard]] std::string_view page_style();
[[nodiscard]] std::string_view page_script();

}  // namespace bdpt::view
