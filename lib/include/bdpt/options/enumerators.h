#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

namespace bdpt {

/// A value of an enumeration, and its name in options and files.
template <typename Enum>
struct Enumerator {
    Enum value;
    std::string_view name;
};  /// Deduces its type.
template <typename Enum>
Enumerator(Enum, const char*) -> Enumerator<Enum>;

/// All values of `Enum` with their names; specialised beside each enumeration that has them.
template <typename Enum>
inline constexpr std::nullptr_t enumerators = nullptr;

/// Has `T` names for its values?
template <typename T>
concept HasEnumerators = !std::is_null_pointer_v<std::remove_cv_t<decltype(enumerators<T>)>>;

/// The name of `value` in options and files.
template <HasEnumerators Enum>
[[nodiscard]] constexpr std::string_view name_of(Enum value)
{
    for (const auto& enumerator : enumerators<Enum>) {
        if (enumerator.value == value) {
            return enumerator.name;
        }
    }
    return {};
}

/// The value that has that name.
template <HasEnumerators Enum>
[[nodiscard]] constexpr std::optional<Enum> enumerator_of(std::string_view name)
{
    for (const auto& enumerator : enumerators<Enum>) {
        if (enumerator.name == name) {
            return enumerator.value;
        }
    }
    return std::nullopt;
}

}  // namespace bdpt
