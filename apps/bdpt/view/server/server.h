#pragma once

#include <functional>
#include <memory>
#include <string>

#include "options/arguments.h"
#include "view/session.h"

namespace bdpt::app {

/// Callbacks for requests of pages, called on the server's thread; `Session` accepts them from any
/// thread.
struct Doors {
    std::function<void(ClientId)> join;
    std::function<void(ClientId)> leave;
    std::function<void(ClientId, const std::string&)> ask;
    std::function<void(const std::string& name, int slot, std::function<void(Download)>)> save;
    std::function<void()> stop;  ///< a signal requests the end
};

/// The server of `bdpt view`: the page, a web socket for each window, files. It runs on one thread
/// and never waits for a slow reader: each window has one picture in flight, and newer ones replace
/// the waiting one. What an audience does is thread-safe.
class Server : public Audience {
public:
    /// Returns the address of the page, with the token.
    [[nodiscard]] virtual std::string url() const = 0;
    /// Returns an address that leads to the page once, for command lines, which others can see.
    [[nodiscard]] virtual std::string url_once() const = 0;
    /// Serves until `stop()`. SIGINT, SIGTERM and SIGHUP call `doors.stop`; a second one ends the
    /// process.
    virtual void start(Doors doors) = 0;
    /// Stops serving.
    virtual void stop() = 0;
};

/// Starts to listen. Throws `Error` (output) if that fails.
[[nodiscard]] std::unique_ptr<Server> make_server(const DisplayAddress& address, std::string page);
}  // namespace bdpt::app
