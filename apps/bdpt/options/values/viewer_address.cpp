#include "options/values/viewer_address.h"

#include <algorithm>
#include <string_view>

#include "options/arguments.h"

namespace bdpt::app {

std::optional<DisplayAddress> parse_address(const std::string& text)
{
    constexpr std::size_t max_port = 65535;
    DisplayAddress address{.host = text, .port = "14158"};
    const std::size_t bracket = text.find(']');
    const bool bracketed = text.starts_with('[') && bracket != std::string::npos;
    const std::size_t colon = text.find(':', bracketed ? bracket : 0);
    if (colon != std::string::npos) {
        address.host = text.substr(0, colon);
        address.port = text.substr(colon + 1);
        const std::optional<std::size_t> port = parse_index(address.port);
        if (!port || *port < 1 || *port > max_port) {
            return std::nullopt;
        }
    }
    if (bracketed) {
        if (address.host.size() != bracket + 1) {
            return std::nullopt;  // text between the bracket and the colon
        }
        address.host = address.host.substr(1, bracket - 1);
    }
    if (address.host.empty()) {
        address.host = "localhost";
    }
    const bool plain = std::none_of(address.host.begin(), address.host.end(), [](unsigned char c) {
        return c <= ' ' || c == '/' || c == '[' || c == ']';
    });
    return plain && !text.empty() ? std::optional(address) : std::nullopt;
}

}  // namespace bdpt::app
