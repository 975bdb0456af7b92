#pragma once

/// @file
/// Hashes bytes, to tell contents apart.
///
/// @code{.cpp}
/// const std::string text = "the contents of a file";
/// bdpt::ContentHasher hasher;
/// hasher.add(text.data(), text.size());
/// std::cout << bdpt::to_string(hasher.hash()) << '\n';
/// @endcode

#include <bdpt/export.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace bdpt {

/// 128-bit content hash.
struct ContentHash {
    std::uint64_t low = 0;
    std::uint64_t high = 0;
    [[nodiscard]] bool operator==(const ContentHash&) const = default;
};

/// Formats a hash as 32 hexadecimal digits.
[[nodiscard]] BDPT_EXPORT std::string to_string(const ContentHash& hash);

/// Computes the 128-bit XXH3 hash (xxhash.com) of a sequence of bytes. It detects accidental
/// corruption; it does not protect against forgery.
class BDPT_EXPORT ContentHasher {
public:
    ContentHasher();
    ~ContentHasher();
    ContentHasher(const ContentHasher&) = delete;
    ContentHasher& operator=(const ContentHasher&) = delete;

    void add(const void* bytes, std::size_t size);
    /// Returns the hash of all bytes added so far.
    [[nodiscard]] ContentHash hash() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace bdpt
