#pragma once

#include <cstdint>
#include <string>

namespace bdpt {

/// Formats bytes as "12 MB", rounded up, for messages.
[[nodiscard]] inline std::string megabytes(std::uint64_t bytes)
{
    constexpr std::uint64_t megabyte = 1'000'000;
    return std::to_string(bytes / megabyte + (bytes % megabyte != 0 ? 1 : 0)) + " MB";
}

}  // namespace bdpt
