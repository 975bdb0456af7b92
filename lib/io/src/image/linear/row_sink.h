#pragma once

#include <bdpt/types.h>

#include <functional>
#include <span>

namespace bdpt::io {

/// Receives an image row by row.
struct RowSink {
    std::function<void(int width, int height)> begin;  ///< may throw, if the image is too large
    /// Takes the next row from the top and may change its values; returns false to stop.
    std::function<bool(std::span<Rgb> row)> add;
};

}  // namespace bdpt::io
