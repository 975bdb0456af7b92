#pragma once

#include "path/sample_context.h"

#include <optional>

namespace bdpt {

/// What a ray comes to first: a point where a medium scatters it, a surface, or neither.
struct Encounter {
    std::optional<MediumEvent> in_medium;
    std::optional<RayHit> surface;  ///< of the ray, whether or not it gets there
    Flight flight;                  ///< to where it ends

    /// Probability of getting there, or its density along the ray.
    [[nodiscard]] float probability() const { return flight.to(in_medium.has_value()); }
    /// What a throughput is multiplied by.
    [[nodiscard]] Rgb weight() const { return flight.transmittance / probability(); }
};

/// Which walk it is, and how many vertices it has.
struct WalkPlace {
    bool from_camera = true;
    int vertices = 1;
};

/// Follows the ray from `origin` in the unit direction `direction`.
[[nodiscard]] Encounter follow(SampleContext& sample, const SegmentEnd& origin, Vec3 direction,
                               SegmentKey segment, const WalkPlace& place);

/// What was met, if anything: the walk's next vertex.
[[nodiscard]] inline SurfacePoint point_of(const SampleContext& sample, const Encounter& met,
                                           const SegmentEnd& origin, Vec3 direction,
                                           SegmentKey segment)
{
    return met.in_medium ? sample.world.medium_point(origin, direction, *met.in_medium)
                         : sample.world.surface_at(*met.surface, direction, segment,
                                                   sample.camera.pixel_cone());
}

}  // namespace bdpt
