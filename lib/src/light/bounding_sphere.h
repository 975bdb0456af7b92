#pragma once

#include "math/elementary.h"
#include "math/pdf.h"

#include <bdpt/types.h>

namespace bdpt {

/// Around the whole scene: what lights at infinity shine on.
struct BoundingSphere {
    Vec3 center{0.0f};
    float radius = 1.0f;

    /// Of a point of the disk that parallel rays through the sphere cross at right angles.
    [[nodiscard]] PlanarPdf pdf_disk() const { return {1.0f / (pi * radius * radius)}; }
};

}  // namespace bdpt
