#pragma once

#include <bdpt/part/content_hash.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace bdpt::test {

/// Returns `bytes` of a part file with a valid seal, replacing an existing one: anybody who can
/// write a file can forge one.
[[nodiscard]] inline std::string sealed_part(std::string_view bytes)
{
    constexpr std::string_view name = "bdpt part, v. 1.";
    constexpr std::size_t size = 40;
    if (bytes.size() >= size && bytes.substr(bytes.size() - size, name.size()) == name) {
        bytes.remove_suffix(size);
    }
    ContentHasher hasher;
    hasher.add(bytes.data(), bytes.size());
    const ContentHash hash = hasher.hash();
    std::string result = std::string(bytes) + std::string(name);
    for (const std::uint64_t number : {std::uint64_t{bytes.size()}, hash.low, hash.high}) {
        for (int shift = 0; shift < 64; shift += 8) {
            result += static_cast<char>(number >> shift);
        }
    }
    return result;
}

}  // namespace bdpt::test
