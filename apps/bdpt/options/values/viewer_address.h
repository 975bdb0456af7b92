#pragma once

#include <optional>
#include <string>

namespace bdpt::app {

/// Network address of an image viewer.
struct DisplayAddress {
    std::string host;
    std::string port;
    [[nodiscard]] bool operator==(const DisplayAddress&) const = default;
};

/// Parses "HOST", "HOST:PORT", ":PORT" (this machine) or "[IPV6]:PORT". The default port is 14158,
/// that of tev.
[[nodiscard]] std::optional<DisplayAddress> parse_address(const std::string& text);

}  // namespace bdpt::app
