#pragma once

#include "math/elementary.h"
#include "math/pdf.h"

#include <bdpt/types.h>

namespace bdpt {

/// Bounding sphere of the whole scene, which lights at infinity illuminate.
struct BoundingSphere {
    Vec3 center{0.0f};
    float radius = 1.0f;

    /// Returns the density of a point on the disk perpendicular to parallel rays through the
    /// sphere.
    [[nodiscard]] PlanarPdf pdf_disk() const { return {1.0f / (pi * radius * radius)}; }
};

}  // namespace bdpt
