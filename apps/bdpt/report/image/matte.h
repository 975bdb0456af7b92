#pragma once

#include <bdpt/image.h>
#include <bdpt/io/denoise.h>

#include <span>
#include <vector>

namespace bdpt::app {

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

}  // namespace bdpt::app
