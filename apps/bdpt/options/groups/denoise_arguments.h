#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "options/option_list.h"

namespace bdpt::app {

/// Which of the two is the image of .exr files; the other one is a layer.
enum class DenoisedAs : std::uint8_t { image, layer };

/// How images are denoised.
struct DenoiseArguments {
    DenoisedAs as = DenoisedAs::image;
    std::optional<std::filesystem::path> library{};  ///< none: where the system finds it
};

/// Adds --denoise and --denoiser-library.
void add_denoise_options(OptionList& options, DenoiseArguments& denoise);

/// `denoise` where --denoise is given. Throws `OptionError` for the other option alone.
[[nodiscard]] std::optional<DenoiseArguments> checked(const DenoiseArguments& denoise,
                                                      const OptionList& options);

}  // namespace bdpt::app
