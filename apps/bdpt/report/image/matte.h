#pragma once

#include <bdpt/image.h>
#include <bdpt/io/denoise.h>

#include <span>
#include <vector>

namespace bdpt::app {

/// How far the pixels of an image hide what is put behind it, each in [0, 1]; empty where no layer
/// tells.
struct Matte {
    std::vector<float> alpha{};
    std::vector<float> shadow{};  ///< the part of alpha that is a shadow on the ground
};

[[nodiscard]] Matte matte_of(std::span<const Layer> layers);

/// Shares of pixels that surfaces cover: alpha without the shadow.
[[nodiscard]] std::vector<float> coverage_of(const Matte& matte);

/// The same by the layer `opacity`, if there is one, which has no noise where surfaces blend.
[[nodiscard]] std::vector<float> clean_coverage(const Matte& noisy, std::span<const Layer> layers);

/// `noisy` with clean coverage, and with its shadow denoised: its opacity where the ground is seen.
/// The layers are those that it is of.
[[nodiscard]] Matte denoised(const io::Denoiser& denoiser, const Matte& noisy,
                             std::span<const Layer> layers);

/// What is not put into the place of the other is kept as a layer of that name.
struct MatteNames {
    const char* alpha;
    const char* shadow;
};

/// Puts `matte` into those layers, and adds those of `other` under their names, as far as they
/// differ: the shadow if there is one, alpha if there is a layer `opacity`.
void put(const Matte& matte, const Matte& other, const MatteNames& names_of_other,
         std::vector<Layer>& layers);

}  // namespace bdpt::app
