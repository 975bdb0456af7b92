#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "options/values/viewer_address.h"

namespace bdpt::app {

/// A connection to a viewer that never blocks for long: a viewer that accepts no bytes for ten
/// seconds is taken as dead, and `stopped` is polled ten times a second. Throws std::runtime_error.
class TevConnection {
public:
    TevConnection(const DisplayAddress& address, const std::function<bool()>& stopped);
    ~TevConnection();
    TevConnection(const TevConnection&) = delete;
    TevConnection& operator=(const TevConnection&) = delete;

    /// Throws if the viewer is gone, accepts nothing, or `stopped` returns true.
    void send(std::string_view bytes) const;
    /// Tests whether the viewer has closed the connection.
    [[nodiscard]] bool is_closed() const;

private:
    [[nodiscard]] bool wait_until_writable(double seconds) const;

    std::function<bool()> stopped_;
    int socket_ = -1;
};

}  // namespace bdpt::app
