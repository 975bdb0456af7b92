#pragma once

#include "math/pdf.h"
#include "math/rgb.h"
#include "scene/world.h"

#include <optional>

namespace bdpt {

/// The state of a walk that is about to look for its next vertex.
struct WalkStep {
    Vec3 direction{0.0f};
    Rgb beta{1.0f};
    SolidAnglePdf pdf;
    /// Set for the first step from a light at infinity, which has no density of directions.
    std::optional<PlanarPdf> pdf_plane;
    /// Where the ray starts: the last vertex, or the edge of the scene.
    const SegmentEnd* origin = nullptr;

    /// Density of sampling a point at that squared distance, with that cosine there.
    [[nodiscard]] AreaPdf pdf_of_point(float cosine, float distance_squared) const
    {
        return pdf_plane ? to_area(*pdf_plane, cosine) : to_area(pdf, cosine, distance_squared);
    }
};

}  // namespace bdpt
