#pragma once

namespace bdpt {

/// A T with default values, to be copied. Where a larger T is made anew for every vertex, g++ would
/// clear it by `rep stos`, which takes longer to start than such a copy takes.
template <typename T>
inline constexpr T blank{};

}  // namespace bdpt
