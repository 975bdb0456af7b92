#pragma once

/// @file
/// Gives the values of enumerations their names in options and files.
///
/// @code{.cpp}
/// if (const auto kind = bdpt::parse_enumerator<bdpt::IntegratorKind>("vcm")) {
///     std::cout << "--integrator " << bdpt::to_name(*kind) << '\n';
/// }
/// @endcode

#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

namespace bdpt {

/// An enumerator and its name in options and files.
template <typename Enum>
struct Enumerator {
    Enum value;
    std::string_view name;
};  /// Deduces the type of the enumeration.
template <typename Enum>
Enumerator(Enum, const char*) -> Enumerator<Enum>;

/// All enumerators of `Enum` with their names; specialised beside each enumeration that has them.
template <typename Enum>
inline constexpr std::nullptr_t enumerators = nullptr;

/// Tests whether the enumerators of `T` have names.
template <typename T>
concept HasEnumerators = !std::is_null_pointer_v<std::remove_cv_t<decltype(enumerators<T>)>>;

/// Returns the name of `value` in options and files.
template <HasEnumerators Enum>
[[nodiscard]] constexpr std::string_view to_name(Enum value)
{
    for (const auto& enumerator : enumerators<Enum>) {
        if (enumerator.value == value) {
            return enumerator.name;
        }
    }
    return {};
}

/// Returns the enumerator with that name; nullopt if there is none.
template <HasEnumerators Enum>
[[nodiscard]] constexpr std::optional<Enum> parse_enumerator(std::string_view name)
{
    for (const auto& enumerator : enumerators<Enum>) {
        if (enumerator.name == name) {
            return enumerator.value;
        }
    }
    return std::nullopt;
}

}  // namespace bdpt
