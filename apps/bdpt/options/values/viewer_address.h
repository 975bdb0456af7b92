#pragma once

#include <optional>
#include <string>

namespace bdpt::app {

/// Where an image viewer listens.
struct DisplayAddress {
    std::string host;
    std::string port;
    [[nodiscard]] bool operator==(const DisplayAddress&) const = default;
};

/// "HOST", "HOST:PORT", ":PORT" (this machine) or "[IPV6]:PORT". Without a port: 14158, that of
/// tev.
[[nodiscard]] std::optional<DisplayAddress> parse_address(const std::string& text);

}  // namespace bdpt::app
