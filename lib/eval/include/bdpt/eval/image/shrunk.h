#pragma once

#include <bdpt/export.h>
#include <bdpt/image.h>

namespace bdpt::eval {

/// Averages squares of `factor` x `factor` pixels; those at the right and lower border may be
/// smaller.
[[nodiscard]] BDPT_EXPORT Image shrunk(const Image& image, int factor);

}  // namespace bdpt::eval
