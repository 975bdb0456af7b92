#pragma once

#include <bdpt/image.h>
#include <bdpt/io/display.h>

#include <optional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace bdpt::app {

/// What words say about how images look on a screen, as they were given.
struct DisplayWords {
    std::optional<double> exposure;  // [EV]
    std::string tone_map = "filmic";
    std::optional<std::string> background;
    int png_bits = 8;
};

/// What is seen in place of the environment.
struct Backdrop {
    std::optional<io::SrgbColor> color{};  ///< none: images are transparent there
};

/// The same, understood and checked.
struct DisplayArguments {
    std::optional<float> exposure{};  ///< [EV] none: automatic
    io::ToneCurve curve = io::ToneCurve::filmic;
    TexelType type = TexelType::unorm8;  ///< of .png
    std::optional<Backdrop> backdrop{};  ///< none: the environment is seen
};

/// "transparent", "black" or "#rrggbb".
[[nodiscard]] std::optional<Backdrop> parse_backdrop(std::string_view text);

/// Its inverse; black is "#000000".
[[nodiscard]] std::string backdrop_text(const Backdrop& backdrop);

/// Describes --exposure, --tone-map, --background and --png-bits to the parser.
void add_display_options(CLI::App& command, DisplayWords& words, const char* group);

/// Throws `OptionError`.
[[nodiscard]] DisplayArguments understand(const DisplayWords& words);

}  // namespace bdpt::app
