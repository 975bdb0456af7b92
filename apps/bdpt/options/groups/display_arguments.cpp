#include "options/groups/display_arguments.h"

#include <fmt/core.h>

#include <charconv>
#include <cstddef>

#include "options/values/value_types.h"

namespace bdpt::app {

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

void add_display_options(OptionList& options, DisplayArguments& display)
{
    // 2^100 is far beyond any ratio of a scene to a screen.
    options.add("--exposure", "EV", "Exposure of .png: pixels times 2^EV. Default: automatic",
                display.exposure, number(-100.0, 100.0, "EV from -100 to 100"));
    const auto curves = choices_of(io::all_tone_curves, io::tone_curve_name);
    options.add("--tone-map", choice_text(curves.words()),
                "Tone mapping of .png: filmic (default), pbr-neutral (keeps base colours under "
                "grey light, best with --exposure), agx, or none (clamps)",
                display.curve, curves.type());
    Option& background = options.add(
        "--background", "transparent|black|#RRGGBB",
        "Leave out the environment where the camera sees it directly; it still lights the scene. "
        ".exr gets alpha (colours are premultiplied), .png gets alpha (transparent) or that sRGB "
        "colour there",
        display.backdrop,
        parsed_by([](const std::string& text) { return parse_backdrop(text); },
                  "transparent, black, or a colour of six hexadecimal digits like #f0f0f0"));
    background.uses.plan_render = true;    // merging needs its alpha
    background.uses.python_render = true;  // as does save()
    const Choices<TexelType> depths{{{"8", TexelType::unorm8}, {"16", TexelType::unorm16}}};
    options.add("--png-bits", "8|16", "Bits of each channel of .png: 8 (default) or 16",
                display.type, depths.type());
}

}  // namespace bdpt::app
