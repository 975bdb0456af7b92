#include "options/groups/film_arguments.h"

#include <bdpt/film/exact_sum.h>
#include <bdpt/film/id_film.h>
#include <bdpt/options/integrators.h>
#include <bdpt/options/option_text.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "options/groups/transport_arguments.h"
#include "options/value_types.h"

namespace bdpt::job {

namespace {}  // namespace

std::optional<FilterOptions> parse_filter(std::string_view text)
{
    const std::size_t colon = text.find(':');
    const std::optional<FilterKind> kind =
        parse_enumerator<FilterKind>(lower_case(text.substr(0, colon)));
    if (!kind) {
        return std::nullopt;
    }
    FilterOptions result{.kind = *kind, .radius = {}};
    if (colon != std::string_view::npos) {
        result.radius = parse_float(text.substr(colon + 1));
        if (!result.radius || !(*result.radius >= 0.01f && *result.radius <= 16.0f)) {
            return std::nullopt;
        }
    }
    return result;
}

std::optional<AovSet> parse_aovs(std::string_view text)
{
    AovSet result;
    for (const std::string_view part : split(text, ',')) {
        const std::optional<Aov> aov = parse_enumerator<Aov>(lower_case(part));
        if (!aov || *aov == Aov::shadow) {  // requested by --ground
            return std::nullopt;
        }
        result.insert(*aov);
    }
    return result;
}

std::optional<PixelRect> parse_crop(std::string_view text)
{
    constexpr std::size_t largest = 65535;
    std::array<int, 4> corners{};
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != corners.size()) {
        return std::nullopt;
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::optional<std::size_t> corner = parse_index(parts[i]);
        if (!corner || *corner > largest) {
            return std::nullopt;
        }
        corners[i] = static_cast<int>(*corner);
    }
    const auto [x0, y0, x1, y1] = corners;
    if (x0 >= x1 || y0 >= y1) {
        return std::nullopt;
    }
    return PixelRect{.x0 = x0, .y0 = y0, .x1 = x1, .y1 = y1};
}

ValueType<FilterOptions> filter_type()
{
    return parsed_by(parse_filter,
                     "box, tent, gaussian or blackman-harris, optionally with a radius from 0.01 "
                     "to 16, like gaussian:2");
}

ValueType<AovSet> aov_type()
{
    return parsed_by(
        parse_aovs,
        "a comma-separated list of albedo, normal, depth, position, samples, variance, alpha, "
        "opacity, object and material");
}

ValueType<PixelRect> crop_type()
{
    return parsed_by(parse_crop, "four whole numbers x0,y0,x1,y1 with x0 < x1 and y0 < y1");
}

void add_ground_option(OptionList& options, Ground& ground)
{
    const Choices<Ground> grounds{{{"shadow", Ground::shadow}, {"none", Ground::none}}};
    options.add("--ground", "shadow|none",
                "shadow: shadow catcher, a horizontal ground that is invisible itself, also in "
                "reflections. The shadow is black: it darkens the visible environment, or adds to "
                "the alpha of --background; .exr also gets it as layer shadow.A. Default: none",
                ground, grounds.type());
}

FilmOptions with_ground(Ground ground, FilmOptions film, const OptionList& options)
{
    if (ground == Ground::none) {
        if (options.given("--ground-height")) {
            throw OptionError("--ground-height needs --ground shadow");
        }
        return film;
    }
    static constexpr std::array conflicts{Conflict{"--ground", "--fog"},
                                          Conflict{"--ground", "--volume"}};
    check(conflicts, options);
    film.aovs.insert(Aov::shadow);
    return film;
}

namespace {

constexpr std::uint64_t color_sum = 3 * sizeof(ExactSum);
constexpr std::uint64_t shadow_sums = 2 * sizeof(ExactSum) + sizeof(std::uint64_t);

/// Typical cost of a pixel's ids; each further one takes 8 bytes, and the heap's overhead.
constexpr std::uint64_t two_ids = sizeof(IdCounts) + 32;
constexpr std::uint64_t id_channels = 2 * IdFilm::levels;

/// Returns the size of the sums of a pixel in an `AovFilm` or `IdFilm` [bytes].
std::uint64_t count_sum_bytes(const AovLayer& layer)
{
    switch (layer.aov) {
        case Aov::object:
        case Aov::material:
            return two_ids;
        case Aov::alpha:
            return sizeof(std::uint64_t);
        case Aov::opacity:
            return sizeof(ExactSum);
        case Aov::shadow:
            return shadow_sums;
        default:
            return layer.mean == AovMean::none ? 0 : layer.channels.size() * sizeof(ExactSum);
    }
}

std::uint64_t count_pixels(const RenderOptions& options, const Size& size)
{
    const PixelRect region = options.film.crop.value_or(
        PixelRect{.x0 = 0, .y0 = 0, .x1 = size.width, .y1 = size.height});
    return static_cast<std::uint64_t>(region.width()) * static_cast<std::uint64_t>(region.height());
}

}  // namespace

std::uint64_t film_bytes(const RenderOptions& options, const Size& size)
{
    const bool splats = info(options.integrator).traces_light_paths;
    constexpr std::uint64_t halves = 2;
    std::uint64_t pixel = halves * (splats ? 2 : 1) * color_sum + sizeof(Rgb);
    for (const AovLayer& layer : aov_layers) {
        if (options.film.aovs.contains(layer.aov)) {
            const bool is_id = layer.aov == Aov::object || layer.aov == Aov::material;
            const std::uint64_t channels = is_id ? id_channels : layer.channels.size();
            // Developed, and once more in the channel order of a file.
            pixel += count_sum_bytes(layer) + 2 * channels * sizeof(float);
        }
    }
    return pixel * count_pixels(options, size);
}

std::uint64_t denoiser_bytes(const RenderOptions& options, const Size& size)
{
    // Measured with version 2.5.1 from 16x16 to 3840x2160; it splits large images into tiles.
    constexpr std::uint64_t program = 100'000'000;
    constexpr std::uint64_t pixel = 700;
    constexpr std::uint64_t most = 3'600'000'000;
    return std::min(program + pixel * count_pixels(options, size), most);
}

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
            const std::optional<double> value = parse_number<double>(text);
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

}  // namespace

template <typename Group>
void add_fields(OptionList& options, Group& group)
{
    for_each_field(group, [&options](const auto& field, auto& value) {
        if constexpr (requires { option_text(value); }) {
            add_field(options, field, value);
        }
    });
}

template void add_fields(OptionList& options, FilmOptions& group);
template void add_fields(OptionList& options, SamplingOptions& group);
template void add_fields(OptionList& options, TransportOptions& group);
template void add_fields(OptionList& options, BidirectionalOptions& group);
template void add_fields(OptionList& options, SystemOptions& group);

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

}  // namespace bdpt::job
