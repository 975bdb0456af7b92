#pragma once

#include "math/pdf.h"
#include "math/rgb.h"
#include "scene/world.h"

#include <optional>

namespace bdpt {

/// State of a walk that is about to sample its next vertex.
struct WalkStep {
    Vec3 direction{0.0f};
    Rgb beta{1.0f};
    SolidAnglePdf pdf;
    /// Set for the first step from a light at infinity, which has no density of directions.
    std::optional<PlanarPdf> pdf_plane;
    /// Origin of the ray: the last vertex, or the edge of the scene.
    const SegmentEnd* origin = nullptr;

    /// Returns the area density at a point at that squared distance, with that cosine there.
    [[nodiscard]] AreaPdf pdf_of_point(float cosine, float distance_squared) const
    {
        return pdf_plane ? to_area(*pdf_plane, cosine) : to_area(pdf, cosine, distance_squared);
    }
};

}  // namespace bdpt
