#pragma once

#include "math/pdf.h"
#include "path/sample_context.h"
#include "path/subpath.h"

#include <limits>
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

/// Limits of a random walk.
struct WalkLimits {
    int max_vertices = 1;  ///< vertices of the subpath, including the lens or the light
    int rr_start = std::numeric_limits<int>::max();  ///< edges before Russian roulette
    /// Minimum survival probability of Russian roulette.
    float rr_survival = 0.0f;
};

/// Traces a camera subpath from the lens through `raster` into `path`; the first vertex is on the
/// lens, and the last may be on the environment at infinity.
void trace_camera_subpath(SampleContext& sample, Vec2 raster, const WalkLimits& limits,
                          Subpath& path);

/// Traces a light subpath from a randomly chosen light into `path`; the first vertex is on the
/// light. Records where the walk crosses the camera's finite lens. Empty if no light has power.
/// `sampling` is that of next-event estimation, whose density it stores.
void trace_light_subpath(SampleContext& sample, const WalkLimits& limits,
                         NextEventSampling sampling, Subpath& path);

}  // namespace bdpt
