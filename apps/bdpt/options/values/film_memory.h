#pragma once

#include <bdpt/render_options.h>

#include <cstdint>

#include "options/arguments.h"

namespace bdpt::app {

/// Memory that the film of a render of `size` takes, with the layers that are asked for and the
/// image that it is developed to [bytes].
[[nodiscard]] std::uint64_t film_bytes(const RenderOptions& options, const Size& size);

}  // namespace bdpt::app
