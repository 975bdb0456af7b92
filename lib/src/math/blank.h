#pragma once

namespace bdpt {

/// A T with default values, to be copied. Where a larger T is constructed for every vertex, g++
/// would clear it by `rep stos`, whose start-up takes longer than such a copy.
template <typename T>
inline constexpr T blank{};

}  // namespace bdpt
