#pragma once

#include <bdpt/render_options.h>

#include <cstdint>

#include "options/arguments.h"

namespace bdpt::app {

/// Returns the memory of the film of a render of `size`, with its layers and the image that it is
/// developed to [bytes].
[[nodiscard]] std::uint64_t film_bytes(const RenderOptions& options, const Size& size);

/// Returns the memory that Open Image Denoise takes for a render of `size` [bytes].
[[nodiscard]] std::uint64_t denoiser_bytes(const RenderOptions& options, const Size& size);

}  // namespace bdpt::app
