#include "options/groups/display_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "options/arguments.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

std::vector<std::string> curve_names()
{
    std::vector<std::string> names;
    for (const io::ToneCurve curve : io::all_tone_curves) {
        names.emplace_back(io::tone_curve_name(curve));
    }
    return names;
}

/// The one of that name, which the parser has found.
io::ToneCurve to_curve(const std::string& name)
{
    return *std::find_if(io::all_tone_curves.begin(), io::all_tone_curves.end(),
                         [&](io::ToneCurve curve) { return io::tone_curve_name(curve) == name; });
}

std::optional<float> to_exposure(const std::optional<double>& word)
{
    // 2^100 is far beyond any ratio of a scene to a screen.
    constexpr double most = 100.0;
    if (word && !(std::abs(*word) <= most)) {
        reject("--exposure", fmt::format("{}", *word), "EV from -100 to 100");
    }
    return word ? std::optional(static_cast<float>(*word)) : std::nullopt;
}

}  // namespace

std::optional<Backdrop> parse_backdrop(std::string_view text)
{
    constexpr std::size_t color_size = 7;  // #rrggbb
    constexpr int hexadecimal = 16;
    if (text == "transparent") {
        return Backdrop{};
    }
    if (text == "black") {
        return Backdrop{.color = io::SrgbColor{}};
    }
    if (text.size() != color_size || text.front() != '#') {
        return std::nullopt;
    }
    io::SrgbColor color{};
    for (std::size_t i = 0; i < color.size(); ++i) {
        const std::string_view digits = text.substr(1 + 2 * i, 2);
        const char* end = digits.data() + digits.size();
        const auto [stop, error] = std::from_chars(digits.data(), end, color[i], hexadecimal);
        if (error != std::errc{} || stop != end) {
            return std::nullopt;
        }
    }
    return Backdrop{.color = color};
}

std::string backdrop_text(const Backdrop& backdrop)
{
    return backdrop.color ? fmt::format("#{:02x}{:02x}{:02x}", (*backdrop.color)[0],
                                        (*backdrop.color)[1], (*backdrop.color)[2])
                          : "transparent";
}

void add_display_options(CLI::App& command, DisplayWords& words, const char* group)
{
    command
        .add_option("--exposure", words.exposure,
                    "Exposure of .png: pixels times 2^EV. Default: automatic")
        ->type_name("EV")
        ->group(group);
    command
        .add_option("--tone-map", words.tone_map,
                    "Tone mapping of .png: filmic (default), pbr-neutral (keeps base colours under "
                    "grey light, best with --exposure), agx, or none (clamps)")
        ->check(one_of(curve_names()))
        ->type_name("filmic|pbr-neutral|agx|none")
        ->group(group);
    command
        .add_option("--background", words.background,
                    "Leave out the environment where the camera sees it directly; it lights all "
                    "the same. .exr gets alpha (colours are premultiplied), .png gets alpha "
                    "(transparent) or that sRGB colour there")
        ->type_name("transparent|black|#RRGGBB")
        ->group(group);
    command
        .add_option("--png-bits", words.png_bits, "Bits of each channel of .png: 8 (default) or 16")
        ->check(one_of({"8", "16"}))
        ->type_name("8|16")
        ->group(group);
}

DisplayArguments understand(const DisplayWords& words)
{
    DisplayArguments result{.exposure = to_exposure(words.exposure),
                            .curve = to_curve(words.tone_map),
                            .type = words.png_bits == 16 ? TexelType::unorm16 : TexelType::unorm8};
    if (words.background) {
        result.backdrop = parse_backdrop(*words.background);
        if (!result.backdrop) {
            reject("--background", *words.background,
                   "transparent, black, or a colour of six hexadecimal digits like #f0f0f0");
        }
    }
    return result;
}

}  // namespace bdpt::app
