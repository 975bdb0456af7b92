#pragma once

#include <bdpt/export.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace bdpt {

/// 128 bits that tell contents apart.
struct ContentHash {
    std::uint64_t low = 0;
    std::uint64_t high = 0;
    [[nodiscard]] bool operator==(const ContentHash&) const = default;
};

/// As 32 hexadecimal digits.
[[nodiscard]] BDPT_EXPORT std::string to_string(const ContentHash& hash);

/// XXH3 with 128 bits (xxhash.com) over bytes one after the other. It finds what went wrong by
/// accident; it is no protection against a forger.
class BDPT_EXPORT ContentHasher {
public:
    ContentHasher();
    ~ContentHasher();
    ContentHasher(const ContentHasher&) = delete;
    ContentHasher& operator=(const ContentHasher&) = delete;

    void add(const void* bytes, std::size_t size);
    /// The hash of all bytes so far.
    [[nodiscard]] ContentHash hash() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace bdpt
