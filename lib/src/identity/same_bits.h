#pragma once

#include "identity/scene_identity.h"

#include <cstddef>
#include <cstring>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace bdpt {

/// Tests whether descriptions have the same bits. Names are ignored, as in `DescHasher`. Does
/// not support descriptions that contain images.
template <typename T>
[[nodiscard]] bool same_bits(const T& a, const T& b);

/// Compares lists item by item.
template <typename T>
[[nodiscard]] bool same_bits(const std::vector<T>& a, const std::vector<T>& b)
{
    if (a.size() != b.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!same_bits(a[i], b[i])) {
            return false;
        }
    }
    return true;
}

/// Compares optional values.
template <typename T>
[[nodiscard]] bool same_bits(const std::optional<T>& a, const std::optional<T>& b)
{
    return a.has_value() == b.has_value() && (!a || same_bits(*a, *b));
}

template <typename T>
bool same_bits(const T& a, const T& b)
{
    if constexpr (std::is_same_v<T, std::string>) {
        return true;
    } else if constexpr (HasFields<T>) {
        return std::apply(
            [&](const auto&... field) {
                return (same_bits(a.*(field.member), b.*(field.member)) && ...);
            },
            fields<T>);
    } else {
        static_assert(PlainValue<T>);
        return std::memcmp(&a, &b, sizeof a) == 0;
    }
}

}  // namespace bdpt
