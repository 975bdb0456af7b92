#pragma once

/// @file
/// Lists the fields of descriptions, so that code can loop over them.
///
/// @code{.cpp}
/// const bdpt::MaterialDesc material{};
/// bdpt::for_each_field(material, [](const auto& field, const auto& value) {
///     if constexpr (std::is_same_v<decltype(value), const float&>) {
///         std::cout << field.name << ": " << value << '\n';
///     }
/// });
/// @endcode

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace bdpt {

// The fields of a description, such as `MaterialDesc`, are listed once, beside it. Operations on
// all of them (checks, hashes) use that list; a list that misses a field does not compile.

/// The range of a number, or of each channel of a colour: [low, high], or (low, high].
struct Limits {
    float low = 0.0f;
    float high = 0.0f;
    bool low_is_excluded = false;

    /// Returns [0, 1].
    [[nodiscard]] static constexpr Limits unit() { return {.low = 0.0f, .high = 1.0f}; }
    /// Returns the range of all finite numbers.
    [[nodiscard]] static constexpr Limits finite()
    {
        return at_least(-std::numeric_limits<float>::max());
    }
    /// Returns the range of finite numbers of at least `low`.
    [[nodiscard]] static constexpr Limits at_least(float low)
    {
        return {.low = low, .high = std::numeric_limits<float>::max()};
    }
    /// Returns the range of numbers above `low`, including infinity.
    [[nodiscard]] static constexpr Limits above(float low)
    {
        return {
            .low = low, .high = std::numeric_limits<float>::infinity(), .low_is_excluded = true};
    }
};

/// A field and its human-readable name.
template <typename Desc, typename T>
struct Field {
    std::string_view name;
    T Desc::*member;
};  /// Deduces both types.
template <typename Desc, typename T>
Field(const char*, T Desc::*) -> Field<Desc, T>;

/// A numeric or colour field whose valid range does not depend on other fields.
template <typename Desc, typename T>
struct Number {
    std::string_view name;
    T Desc::*member;
    Limits limits;
};  /// Deduces both types.
template <typename Desc, typename T>
Number(const char*, T Desc::*, Limits) -> Number<Desc, T>;

/// The effect of an option's value.
enum class OptionRole : std::uint8_t {
    image,    ///< affects bits of the image: part of the identity of a render
    samples,  ///< selects samples, each of which is independent of the others
    limit,    ///< limits the accepted values
    machine,  ///< affects how the machine does the work
};

/// The valid range of a number: [low, high], or (low, high].
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_is_excluded = false;

    [[nodiscard]] constexpr bool contains(double value) const
    {
        return (low_is_excluded ? value > low : value >= low) && value <= high;
    }
};

/// The documentation and range of an option. Its command-line flag is "--" and its name, with '-'
/// for '_'.
struct OptionInfo {
    Range range{};  ///< valid range of numbers
    /// Placeholder of the value in help texts, such as "N"; empty for enumerations with names
    /// (`enumerators`).
    std::string_view value{};
    std::string_view help{};  ///< description of the effect; empty: not an option of commands
    /// The default in words; empty: the default is printed as a value.
    std::string_view otherwise{};
    OptionRole role = OptionRole::image;
};

/// A field that users can set.
template <typename Desc, typename T>
struct OptionField {
    std::string_view name;
    T Desc::*member;
    OptionInfo info;
};  /// Deduces both types.
template <typename Desc, typename T>
OptionField(const char*, T Desc::*, OptionInfo) -> OptionField<Desc, T>;

/// The list of the fields of `Desc`, in their order; specialised beside each description.
template <typename Desc>
inline constexpr std::nullptr_t fields = nullptr;

/// Tests whether `T`, which may be a reference or const, has a list of its fields.
template <typename T>
concept HasFields =
    !std::is_null_pointer_v<std::remove_cv_t<decltype(fields<std::remove_cvref_t<T>>)>>;

/// Tests whether `Desc` is an aggregate whose first members have these types.
template <typename Desc, typename... T>
concept BeginsWith = requires(T... values)
{
    Desc{std::move(values)...};
};
/// Tests whether `Desc` has more members than those.
template <typename Desc, typename... T>
concept HasMoreThan = requires(T... values)
{
    Desc{std::move(values)..., {}};
};

namespace detail {

/// Tests whether two pointers point to the same member. Those of different types do not.
template <typename A, typename B>
constexpr bool is_same_member(const A& a, const B& b)
{
    if constexpr (std::is_same_v<A, B>) {
        return a == b;
    } else {
        return false;
    }
}

/// Returns the number of pairs of equal members in the list: the number of members if each is
/// listed once.
template <typename... Members>
constexpr std::size_t count_pairs(Members... members)
{
    const auto count = [=](auto member) {
        return (std::size_t{0} + ... + (is_same_member(member, members) ? 1U : 0U));
    };
    return (std::size_t{0} + ... + count(members));
}

}  // namespace detail

/// Returns a list of fields (`Field`, `Number`, `OptionField`) that has all of those of `Desc`,
/// each once.
template <template <typename, typename> typename... Kinds, typename Desc, typename... T>
[[nodiscard]] consteval std::tuple<Kinds<Desc, T>...> all_fields(Kinds<Desc, T>... list)
{
    static_assert(BeginsWith<Desc, T...>, "the list is not in the order of the members");
    static_assert(!HasMoreThan<Desc, T...>, "the list misses members");
    if (detail::count_pairs(list.member...) != sizeof...(T)) {
        throw "the list has a member twice";
    }
    return {list...};
}

/// Calls `visit(field, value)` for each field of `desc`.
template <HasFields Desc, typename Visitor>
constexpr void for_each_field(Desc& desc, Visitor&& visit)
{
    std::apply([&](const auto&... field) { (visit(field, desc.*(field.member)), ...); },
               fields<std::remove_const_t<Desc>>);
}

}  // namespace bdpt
