#pragma once

#include <functional>
#include <memory>
#include <string>

#include "options/values/viewer_address.h"
#include "view/session.h"

namespace bdpt::app {

/// Whom the server brings what pages say. Called on its thread; `Session` takes it from any.
struct Doors {
    std::function<void(ClientId)> join;
    std::function<void(ClientId)> leave;
    std::function<void(ClientId, const std::string&)> ask;
    std::function<void(const std::string& name, int slot, std::function<void(Download)>)> save;
    std::function<void()> stop;  ///< a signal asks for the end
};

/// The server of `bdpt view`: the page, a web socket for each window, files. One thread does it
/// all, and nobody waits for a slow reader: each window has one picture on its way, and newer ones
/// replace the one that waits.
class Server : public Audience {
public:
    /// Listens. Throws `Error` (output) if that cannot be.
    Server(const DisplayAddress& address, std::string page);
    ~Server() override;
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// Where the page is, with the token.
    [[nodiscard]] std::string url() const;
    /// Serves until `stop()`. SIGINT, SIGTERM and SIGHUP call `doors.stop`; a second one
    /// ends the process.
    void start(Doors doors);
    /// Nobody is served any more.
    void stop();
    /// The signal that came, or 0.
    [[nodiscard]] int signal() const;

    // From any thread:
    void tell(std::string state) override;
    void show(std::shared_ptr<const Frame> frame) override;
    void answer(ClientId client, std::string text) override;

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace bdpt::app
