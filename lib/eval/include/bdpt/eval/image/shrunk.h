#pragma once

/// @file
/// Shrinks images.
///
/// @code{.cpp}
/// bdpt::Image thumbnail(const bdpt::Image& image)
/// {
///     return bdpt::eval::shrunk(image, std::max(1, image.width / 256));
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>

namespace bdpt::eval {

/// Averages squares of `factor` x `factor` pixels; those at the right and lower border may be
/// smaller.
[[nodiscard]] BDPT_EXPORT Image shrunk(const Image& image, int factor);

}  // namespace bdpt::eval
