#include "options/groups/film_arguments.h"

#include <bdpt/options/option_fields.h>

#include <array>
#include <string>
#include <vector>

#include "options/arguments.h"
#include "options/values/value_types.h"

namespace bdpt::app {
namespace {

/// Splits `text` at commas; parts may be empty.
std::vector<std::string_view> split_at_commas(std::string_view text)
{
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t comma = text.find(',');
        parts.push_back(text.substr(0, comma));
        if (comma == std::string_view::npos) {
            return parts;
        }
        text.remove_prefix(comma + 1);
    }
}

}  // namespace

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
    for (const std::string_view part : split_at_commas(text)) {
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
    const std::vector<std::string_view> parts = split_at_commas(text);
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
    return parsed_by([](const std::string& text) { return parse_filter(text); },
                     "box, tent, gaussian or blackman-harris, optionally with a radius from 0.01 "
                     "to 16, like gaussian:2");
}

ValueType<AovSet> aov_type()
{
    return parsed_by(
        [](const std::string& text) { return parse_aovs(text); },
        "a comma-separated list of albedo, normal, depth, position, samples, variance, alpha, "
        "opacity, object and material");
}

ValueType<PixelRect> crop_type()
{
    return parsed_by([](const std::string& text) { return parse_crop(text); },
                     "four whole numbers x0,y0,x1,y1 with x0 < x1 and y0 < y1");
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

}  // namespace bdpt::app
