#pragma once

#include <bdpt/image.h>
#include <bdpt/io/display.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "options/option_list.h"
#include "options/values/exposure.h"

namespace bdpt::app {

/// What is seen in place of the environment.
struct Backdrop {
    std::optional<io::SrgbColor> color{};
    std::filesystem::path photo{};  ///< a file with an image, in place of a colour; empty: none

    [[nodiscard]] bool is_transparent() const { return !color && photo.empty(); }
};

/// How images look on a screen.
struct DisplayArguments {
    /// None: by light with a backdrop and for frames, else automatic.
    std::optional<Exposure> exposure{};
    io::ToneCurve curve = io::ToneCurve::filmic;
    TexelType type = TexelType::unorm8;  ///< of .png
    std::optional<Backdrop> backdrop{};  ///< none: the environment is seen
};

/// "transparent", "black", "white", "#rrggbb", "#rgb" sRGB-encoded "r,g,b" from 0 to 1, or
/// the name of an image: .png, .jpg, .webp, .exr or .hdr.
[[nodiscard]] std::optional<Backdrop> parse_backdrop(std::string_view text);

/// Its inverse; black is "#000000".
[[nodiscard]] std::string backdrop_text(const Backdrop& backdrop);

/// Throws `OptionError` where a transparent image goes to one of `outputs` that has no alpha.
void check_transparency(const DisplayArguments& display,
                        std::span<const std::filesystem::path> outputs);

/// Adds --exposure, --tone-map, --background and --png-bits.
void add_display_options(OptionList& options, DisplayArguments& display);

}  // namespace bdpt::app
