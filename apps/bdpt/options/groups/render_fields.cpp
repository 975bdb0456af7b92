#include "options/groups/render_fields.h"

#include <bdpt/options/option_text.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "options/groups/film_arguments.h"
#include "options/groups/transport_arguments.h"
#include "options/values/value_types.h"

namespace bdpt::app {
namespace {

/// Returns "--light-samples" for "light_samples".
std::string to_flag(std::string_view name)
{
    std::string flag = "--" + std::string(name);
    std::replace(flag.begin(), flag.end(), '_', '-');
    return flag;
}

std::string format_range(const Range& range)
{
    if (range.high == std::numeric_limits<double>::infinity()) {
        return fmt::format("a number {} {}", range.low_is_excluded ? "above" : "from", range.low);
    }
    return range.low_is_excluded
               ? fmt::format("a number above {} and up to {}", range.low, range.high)
               : fmt::format("a number from {} to {}", range.low, range.high);
}

template <typename T>
struct Unwrapped {
    using Type = T;
};
template <typename T>
struct Unwrapped<std::optional<T>> {
    using Type = T;
};

/// Returns the value type for a field of type `T`.
template <typename T>
auto value_type(const OptionInfo& info)
{
    if constexpr (std::is_same_v<T, std::uint64_t>) {
        return info.role == OptionRole::limit ? memory_size() : any_seed();
    } else if constexpr (std::is_integral_v<T>) {
        return whole_number(static_cast<std::int64_t>(info.range.low),
                            static_cast<std::int64_t>(info.range.high));
    } else if constexpr (std::is_floating_point_v<T>) {
        const auto parse = [range = info.range](const std::string& text) {
            const std::optional<double> value = decimal_number(text);
            return value && range.contains(*value) ? value : std::nullopt;
        };
        return ValueType<double>{.parse = parse,
                                 .expected = format_range(info.range),
                                 .info = {.json = JsonType::number, .range = info.range}};
    } else if constexpr (std::is_same_v<T, FilterOptions>) {
        return filter_type();
    } else if constexpr (std::is_same_v<T, AovSet>) {
        return aov_type();
    } else if constexpr (std::is_same_v<T, SampleRange>) {
        return sample_range();
    } else if constexpr (std::is_same_v<T, PixelRect>) {
        return crop_type();
    } else if constexpr (std::is_same_v<T, std::vector<Strategy>>) {
        return strategies_type();
    } else {
        return choices_of_enumeration<T>().type();
    }
}

template <typename T>
std::string format_value(const OptionInfo& info)
{
    if constexpr (HasEnumerators<T>) {
        return choice_text(choices_of_enumeration<T>().words());
    } else {
        return std::string(info.value);
    }
}

template <typename Field, typename Value>
void add_field(OptionList& options, const Field& field, Value& value)
{
    if (field.info.help.empty()) {
        return;
    }
    using T = typename Unwrapped<Value>::Type;
    const std::string standard =
        field.info.otherwise.empty() ? option_text(value) : std::string(field.info.otherwise);
    options.add(to_flag(field.name), format_value<T>(field.info),
                fmt::format("{}. Default: {}", field.info.help, standard), value,
                value_type<T>(field.info));
}

template <typename Group>
void add_all(OptionList& options, Group& group)
{
    for_each_field(group, [&options](const auto& field, auto& value) {
        if constexpr (requires { option_text(value); }) {
            add_field(options, field, value);
        }
    });
}

}  // namespace

void add_fields(OptionList& options, FilmOptions& film)
{
    add_all(options, film);
}

void add_fields(OptionList& options, SamplingOptions& sampling)
{
    add_all(options, sampling);
}

void add_fields(OptionList& options, TransportOptions& transport)
{
    add_all(options, transport);
}

void add_fields(OptionList& options, BidirectionalOptions& bidirectional)
{
    add_all(options, bidirectional);
}

void add_fields(OptionList& options, SystemOptions& system)
{
    add_all(options, system);
}

void add_fields(OptionList& options, RenderOptions& render, std::span<const std::string_view> names)
{
    for_each_option(render, [&](const auto& field, auto& value) {
        if constexpr (requires { option_text(value); }) {
            if (std::find(names.begin(), names.end(), field.name) != names.end()) {
                add_field(options, field, value);
            }
        }
    });
}

}  // namespace bdpt::app
