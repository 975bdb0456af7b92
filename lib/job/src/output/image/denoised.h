#pragma once

#include <bdpt/image.h>
#include <bdpt/io/denoise.h>

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "options/groups/display_arguments.h"

namespace bdpt::job {

/// Returns the values of partially visible content: `layer` divided by `shares`, one in [0, 1] per
/// pixel, by which its values are premultiplied. Pixels that show nothing get the mean of the
/// smallest block of pixels around that shows something, by a pyramid as in [Gortler et al. 1996,
/// "The Lumigraph", 3.4], so that a filter finds no edge there.
[[nodiscard]] Layer visible_values(const Layer& layer, std::span<const float> shares);

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

/// Opacity of the pixels of an image towards its background, each in [0, 1]; empty if there is no
/// such layer.
struct Matte {
    std::vector<float> alpha{};
    std::vector<float> shadow{};  ///< part of alpha that is a shadow on the ground
};

[[nodiscard]] Matte find_matte(std::span<const Layer> layers);

/// Returns the fraction of each pixel that surfaces cover: alpha without the shadow.
[[nodiscard]] std::vector<float> compute_coverage(const Matte& matte);

/// Returns the fraction of each pixel that surfaces cover by the layer `opacity`, if there is one,
/// which has no noise where surfaces blend.
[[nodiscard]] std::vector<float> clean_coverage(const Matte& noisy, std::span<const Layer> layers);

/// Returns `noisy` with clean coverage, and with its shadow denoised: the shadow's opacity where
/// the ground is visible. The layers belong to the same image.
[[nodiscard]] Matte denoised(const io::Denoiser& denoiser, const Matte& noisy,
                             std::span<const Layer> layers);

/// Returns `image`, which shows the environment, with the black `shadow` of the ground over it, by
/// the opacity of each pixel; an empty shadow changes nothing.
[[nodiscard]] Image with_shadow(Image image, std::span<const float> shadow);

/// Layer names for the values of a matte that are replaced in the main layers.
struct MatteNames {
    const char* alpha;
    const char* shadow;
};

/// Stores `matte` in the layers, and adds the values of `other` under their names where both may
/// differ: the shadow if there is one, alpha if there is a layer `opacity`.
void put(const Matte& matte, const Matte& other, const MatteNames& names_of_other,
         std::vector<Layer>& layers);

}  // namespace bdpt::job
