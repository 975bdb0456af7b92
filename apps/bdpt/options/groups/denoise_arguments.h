#pragma once

#include <bdpt/aov.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "options/groups/display_arguments.h"
#include "options/option_list.h"

namespace bdpt::app {

/// Which images are denoised. Pictures are files for screens: .png, .jpg, .webp.
enum class Denoising : std::uint8_t {
    automatic,  ///< pictures, where the denoiser and the layers that guide it are found
    none,
    image,  ///< all images; .exr files have the noisy one as a layer
    layer,  ///< pictures; .exr files have the denoised image as a layer
};

/// Options of denoising.
struct DenoiseArguments {
    Denoising kind = Denoising::automatic;
    std::optional<std::filesystem::path> library{};  ///< none: the one that `io::Denoiser` finds

    /// Tests whether the user asked for denoised images.
    [[nodiscard]] bool is_asked() const
    {
        return kind == Denoising::image || kind == Denoising::layer;
    }
};

/// Adds --denoise and --denoiser-library.
void add_denoise_options(OptionList& options, DenoiseArguments& denoise);

/// Tests whether one of `outputs` would be denoised if the denoiser is found.
[[nodiscard]] bool needs_denoiser(const DenoiseArguments& asked,
                                  std::span<const std::filesystem::path> outputs);

/// Returns the layers that guide the denoiser, with opacity if the image has a `backdrop`, except
/// those in `known`.
[[nodiscard]] std::vector<Aov> missing_guides(const AovSet& known,
                                              const std::optional<Backdrop>& backdrop);

}  // namespace bdpt::app
