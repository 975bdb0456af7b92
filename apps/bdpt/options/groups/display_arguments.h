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

/// Background shown instead of the environment.
struct Backdrop {
    std::optional<io::SrgbColor> color{};
    std::filesystem::path photo{};  ///< file of an image shown instead of a colour; empty: none

    [[nodiscard]] bool is_transparent() const { return !color && photo.empty(); }
};

/// Options of images for screens.
struct DisplayArguments {
    /// None: by light if there is a backdrop and for frames, else automatic.
    std::optional<Exposure> exposure{};
    io::ToneCurve curve = io::ToneCurve::filmic;
    TexelType type = TexelType::unorm8;  ///< type of .png files
    std::optional<Backdrop> backdrop{};  ///< none: the environment is shown
};

/// Parses "transparent", "black", "white", "#rrggbb", "#rgb" or sRGB-encoded "r,g,b" from 0 to 1,
/// or the name of an image: .png, .jpg, .webp, .exr or .hdr.
[[nodiscard]] std::optional<Backdrop> parse_backdrop(std::string_view text);

/// Formats a backdrop, the inverse of `parse_backdrop`; black is "#000000".
[[nodiscard]] std::string backdrop_text(const Backdrop& backdrop);

/// Throws `OptionError` if a transparent image goes to one of `outputs` that has no alpha.
void check_transparency(const DisplayArguments& display,
                        std::span<const std::filesystem::path> outputs);

/// Adds --exposure, --tone-map, --background and --png-bits.
void add_display_options(OptionList& options, DisplayArguments& display);

}  // namespace bdpt::app
