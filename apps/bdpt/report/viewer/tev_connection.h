#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "options/values/viewer_address.h"

namespace bdpt::app {

/// A connection to a viewer, in which nothing waits for long: whoever takes no bytes for ten
/// seconds is taken for dead, and `stopped` is asked ten times a second. Throws std::runtime_error.
class TevConnection {
public:
    TevConnection(const DisplayAddress& address, const std::function<bool()>& stopped);
    ~TevConnection();
    TevConnection(const TevConnection&) = delete;
    TevConnection& operator=(const TevConnection&) = delete;

    /// Throws when the viewer is gone, takes nothing, or `stopped` says so.
    void send(std::string_view bytes) const;
    /// Has the viewer closed the connection?
    [[nodiscard]] bool is_closed() const;

private:
    [[nodiscard]] bool wait_until_writable(double seconds) const;

    std::function<bool()> stopped_;
    int socket_ = -1;
};

}  // namespace bdpt::app
