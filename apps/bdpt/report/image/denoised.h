#pragma once

#include <bdpt/image.h>
#include <bdpt/io/denoise.h>

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

/// Shares of pixels that surfaces cover: by those samples that the image is made of, and without
/// the noise of surfaces that blend.
struct Coverage {
    std::vector<float> noisy;
    std::vector<float> clean;
};

/// The same for an image that is black where surfaces do not cover it. What is denoised are colours
/// of surfaces, so edges stay as they are.
[[nodiscard]] Image denoised(const io::Denoiser& denoiser, const Image& image,
                             std::span<const Layer> layers, const Coverage& coverage);

/// The values of an image as a layer of that name.
[[nodiscard]] Layer layer_of(const Image& image, const char* name);

/// The other way round; the layer has three channels.
[[nodiscard]] Image image_of(const Layer& layer);

}  // namespace bdpt::app
