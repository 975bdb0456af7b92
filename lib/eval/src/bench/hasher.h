#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace bdpt::eval {

/// FNV-1a, 64 bits, over values one after the other; sequences with their length before them.
class Hasher {
public:
    void add_bytes(const void* data, std::size_t size)
    {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) {
            hash_ = (hash_ ^ bytes[i]) * 0x100000001b3ULL;
        }
    }
    /// Eight bytes at a time: for the large arrays of scenes.
    void add_words(const void* data, std::size_t size)
    {
        const auto* bytes = static_cast<const unsigned char*>(data);
        std::size_t i = 0;
        for (; i + 8 <= size; i += 8) {
            std::array<unsigned char, 8> word{};
            for (std::size_t k = 0; k < 8; ++k) {
                word[k] = bytes[i + k];
            }
            hash_ = (hash_ ^ std::bit_cast<std::uint64_t>(word)) * 0x100000001b3ULL;
            hash_ ^= hash_ >> 32;  // else the high bits of a word never reach the low ones
        }
        add_bytes(bytes + i, size - i);
    }

    /// Numbers and enumerators.
    template <typename T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
    void add(T value) { add_bytes(&value, sizeof value); }
    void add(std::string_view text)
    {
        add(text.size());
        add_bytes(text.data(), text.size());
    }
    /// Vectors and matrices of GLM, which have no padding.
    template <typename T>
    requires requires(const T& t)
    {
        t.length();
    } &&(!std::is_convertible_v<T, std::string_view>)void add(const T& value)
    {
        add_bytes(&value, sizeof value);
    }
    /// Arrays of such.
    template <typename T>
    void add_array(const std::vector<T>& values)
    {
        add(values.size());
        add_words(values.data(), values.size() * sizeof(T));
    }

    [[nodiscard]] std::uint64_t hash() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325ULL;
};

/// As 16 hexadecimal digits.
[[nodiscard]] inline std::string hex_text(std::uint64_t value)
{
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
    return text.data();
}

}  // namespace bdpt::eval
