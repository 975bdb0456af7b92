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

/// `noisy` with its shadow denoised: its opacity where the ground is seen. The layers are those
/// that it is of.
[[nodiscard]] Matte denoised(const io::Denoiser& denoiser, const Matte& noisy,
                             std::span<const Layer> layers);

/// Puts `matte` into those layers, and adds the shadow of `other` as a layer of that name; nothing
/// without a shadow.
void put(const Matte& matte, const Matte& other, const char* name_of_other,
         std::vector<Layer>& layers);

}  // namespace bdpt::app
