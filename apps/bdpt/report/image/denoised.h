#pragma once

#include <bdpt/image.h>
#include <bdpt/io/denoise.h>
#include <bdpt/layer.h>

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "options/groups/denoise_arguments.h"

namespace bdpt::app {

/// The denoiser that is asked for, if there are images for it. Throws as its constructor does.
[[nodiscard]] std::optional<io::Denoiser> open_denoiser(
    const std::optional<DenoiseArguments>& asked, std::span<const std::filesystem::path> outputs,
    int threads);

/// `image` denoised, by the help of albedo and normal if they are among the layers.
[[nodiscard]] Image denoised(const io::Denoiser& denoiser, const Image& image,
                             std::span<const Layer> layers);

/// The values of an image as a layer of that name.
[[nodiscard]] Layer layer_of(const Image& image, const char* name);

}  // namespace bdpt::app
