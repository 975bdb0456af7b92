#include "options/groups/film_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "options/arguments.h"

namespace bdpt::app {
namespace {

constexpr std::array<std::pair<std::string_view, FilterKind>, 4> filters{
    {{"box", FilterKind::box},
     {"tent", FilterKind::tent},
     {"gaussian", FilterKind::gaussian},
     {"blackman-harris", FilterKind::blackman_harris}}};

constexpr std::array<std::pair<std::string_view, Aov>, 9> aovs{{{"albedo", Aov::albedo},
                                                                {"normal", Aov::normal},
                                                                {"depth", Aov::depth},
                                                                {"position", Aov::position},
                                                                {"samples", Aov::sample_count},
                                                                {"variance", Aov::variance},
                                                                {"alpha", Aov::alpha},
                                                                {"object", Aov::object},
                                                                {"material", Aov::material}}};

/// The parts of `text` between commas; empty ones too.
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

/// The value beside `name` in a table.
template <typename Table>
auto look_up(const Table& table, std::string_view name)
    -> std::optional<typename Table::value_type::second_type>
{
    const auto found = std::find_if(table.begin(), table.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    return found != table.end() ? std::optional(found->second) : std::nullopt;
}

}  // namespace

std::optional<FilterOptions> parse_filter(std::string_view text)
{
    const std::size_t colon = text.find(':');
    const std::optional<FilterKind> kind = look_up(filters, text.substr(0, colon));
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
        const std::optional<Aov> aov = look_up(aovs, part);
        if (!aov) {
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

const char* filter_name(FilterKind kind)
{
    const auto found = std::find_if(filters.begin(), filters.end(),
                                    [&](const auto& entry) { return entry.second == kind; });
    return found->first.data();  // of a literal, so it ends with a zero
}

void add_film_options(CLI::App& command, FilmWords& words)
{
    const auto group = "Film";
    command
        .add_option("--filter", words.filter,
                    "Pixel filter: box (default, radius 0.5), tent (1), gaussian (1.5, sigma is a "
                    "third of it) or blackman-harris (1.5)")
        ->type_name("NAME[:RADIUS]")
        ->group(group);
    command
        .add_option("--aov", words.aovs,
                    "Extra .exr layers (AOVs), comma-separated: albedo, normal, depth, position, "
                    "samples, variance, alpha; object, material: Cryptomatte")
        ->type_name("LIST")
        ->group(group);
    command
        .add_option(
            "--crop", words.crop,
            "Render only columns x0..x1-1 and rows y0..y1-1; pixels equal those of the whole image")
        ->type_name("X0,Y0,X1,Y1")
        ->group(group);
    command
        .add_option("--clamp", words.clamp,
                    "Clamp each contribution to a pixel to this radiance [nit]: fewer fireflies, "
                    "but biased; the light lost is reported")
        ->type_name("NIT")
        ->group(group);
}

RenderOptions with_film(const FilmWords& words, RenderOptions options)
{
    if (words.filter) {
        const std::optional<FilterOptions> filter = parse_filter(*words.filter);
        if (!filter) {
            reject("--filter", *words.filter,
                   "box, tent, gaussian or blackman-harris, and perhaps a radius from 0.01 to 16, "
                   "like gaussian:2");
        }
        options.film.filter = *filter;
    }
    if (words.aovs) {
        const std::optional<AovSet> set = parse_aovs(*words.aovs);
        if (!set) {
            reject("--aov", *words.aovs,
                   "albedo, normal, depth, position, samples, variance, alpha, object, material "
                   "or some of them, with commas between");
        }
        options.film.aovs = *set;
    }
    if (words.crop) {
        options.film.crop = parse_crop(*words.crop);
        if (!options.film.crop) {
            reject("--crop", *words.crop,
                   "four whole numbers x0,y0,x1,y1 with x0 < x1 and y0 < y1");
        }
    }
    if (words.clamp) {
        options.film.clamp = static_cast<float>(*words.clamp);
        if (!(options.film.clamp > 0.0f)) {
            reject("--clamp", fmt::format("{}", *words.clamp), "a number above 0");
        }
    }
    return options;
}

}  // namespace bdpt::app
