#pragma once

#include <bdpt/image.h>
#include <bdpt/io/denoise.h>

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "options/groups/denoise_arguments.h"

namespace bdpt::app {

/// Opens the denoiser, if there are images for it. Throws as its constructor does, but returns none
/// if nobody asked for it and it is not found.
[[nodiscard]] std::optional<io::Denoiser> open_denoiser(
    const DenoiseArguments& asked, std::span<const std::filesystem::path> outputs, int threads);

/// Tests whether the layers that guide the denoiser are among `layers`.
[[nodiscard]] bool has_guides(std::span<const Layer> layers);

/// Returns `image` denoised, guided by albedo and normal if they are among the layers.
[[nodiscard]] Image denoised(const io::Denoiser& denoiser, const Image& image,
                             std::span<const Layer> layers);

/// Fraction of each pixel that surfaces cover: by the samples of the image, and without the noise
/// of surfaces that blend.
struct Coverage {
    std::vector<float> noisy;
    std::vector<float> clean;
};

/// Returns `image`, which is black where surfaces do not cover it, denoised. The denoiser gets
/// colours of surfaces, so edges are preserved.
[[nodiscard]] Image denoised(const io::Denoiser& denoiser, const Image& image,
                             std::span<const Layer> layers, const Coverage& coverage);

/// Returns the values of an image as a layer of that name.
[[nodiscard]] Layer to_layer(const Image& image, const char* name);

/// Returns a layer of three channels as an image.
[[nodiscard]] Image to_image(const Layer& layer);

}  // namespace bdpt::app
