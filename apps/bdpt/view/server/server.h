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
/// the waiting one.
class Server : public Audience {
public:
    /// Starts to listen. Throws `Error` (output) if that fails.
    Server(const DisplayAddress& address, std::string page);
    ~Server() override;
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// Returns the address of the page, with the token.
    [[nodiscard]] std::string url() const;
    /// Returns an address that leads to the page once, for command lines, which others can see.
    [[nodiscard]] std::string url_once() const;
    /// Serves until `stop()`. SIGINT, SIGTERM and SIGHUP call `doors.stop`; a second one ends the
    /// process.
    void start(Doors doors);
    /// Stops serving.
    void stop();
    /// Returns the signal that was received, or 0.
    [[nodiscard]] int signal() const;

    // Thread-safe:
    void tell(std::string state) override;
    void show(std::shared_ptr<const Frame> frame) override;
    void answer(ClientId client, std::string text) override;

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace bdpt::app
