#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "options/option_list.h"

namespace bdpt::app {

/// Place of the denoised image in .exr files: it is the main image or a layer; the noisy image is
/// the other one.
enum class DenoisedAs : std::uint8_t { image, layer };

/// Options of denoising.
struct DenoiseArguments {
    DenoisedAs as = DenoisedAs::image;
    std::optional<std::filesystem::path> library{};  ///< none: the one that the system finds
};

/// Adds --denoise and --denoiser-library.
void add_denoise_options(OptionList& options, DenoiseArguments& denoise);

/// Returns `denoise` if --denoise is given. Throws `OptionError` for the other option alone.
[[nodiscard]] std::optional<DenoiseArguments> checked(const DenoiseArguments& denoise,
                                                      const OptionList& options);

}  // namespace bdpt::app
