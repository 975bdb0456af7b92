#pragma once

#include "path/path_vertex.h"
#include "path/sample_context.h"

#include <optional>

namespace bdpt {

/// A segment sample: the first interaction along a ray (a scattering event in a medium or a volume,
/// a surface, or nothing), and the segment's transmittance and densities.
struct SegmentSample {
    /// Constructs a sample with the surface alone, which `find_surface()` finds.
    template <typename FindSurface>
    explicit SegmentSample(const FindSurface& find_surface) : surface(find_surface())
    {}

    std::optional<MediumEvent> in_medium;
    std::optional<VolumeEvent> in_volume;
    Rgb passing_weight{1.0f};  ///< weight of `VolumePassage`, times the tint of surfaces passed
    /// Surface hit of the ray, even if the walk scatters before it.
    std::optional<RayHit> surface;
    std::optional<FogSpan> fog;        ///< fog on the segment, whether or not it scatters
    SegmentTransmission transmission;  ///< transmission to the end of the segment
    /// `Media::walk_density` of the end, for the throughput of this walk.
    float walk_density = 1.0f;
    MediumId around = MediumId::clear;  ///< medium around a scattering event in a volume

    /// Returns the probability of reaching the surface, or the density of scattering along the ray,
    /// for MIS weights. Excludes transmittance and extinction of volumes.
    [[nodiscard]] float probability() const
    {
        return transmission.pdf_of_end(in_medium.has_value());
    }
    /// Returns the factor of the throughput: transmittance over the density of this walk.
    [[nodiscard]] Rgb weight() const
    {
        return transmission.transmittance / walk_density * passing_weight;
    }
    [[nodiscard]] bool is_nothing() const { return !in_medium && !in_volume && !surface; }
    [[nodiscard]] VertexKind kind() const
    {
        return in_volume   ? VertexKind::volume
               : in_medium ? VertexKind::medium
                           : VertexKind::surface;
    }
};

/// Returns the first hit of a ray from the lens: at the n-th surface that it may pass, the n-th
/// number of the sample decides, not the segment's key, so the decisions of the samples of a pixel
/// are stratified. `is_tinted` as in `World::first_hit`. Starts another use of `sampler`.
[[nodiscard]] std::optional<RayHit> first_camera_hit(const World& world, Sampler& sampler,
                                                     const SegmentEnd& lens, Vec3 direction,
                                                     SegmentKey segment, bool& is_tinted);

/// The walk that samples a segment.
struct WalkPlace {
    bool from_camera = true;
    int vertices = 1;
    Rgb beta{1.0f};  ///< throughput in the direction of the segment
};

/// Samples a segment of the ray from `origin` in the unit direction `direction`.
[[nodiscard]] SegmentSample sample_segment(SampleContext& sample, const SegmentEnd& origin,
                                           Vec3 direction, SegmentKey segment,
                                           const WalkPlace& place);

/// Constructs the interaction at the end of the segment, which is not nothing: the walk's next
/// vertex.
[[nodiscard]] inline SurfacePoint make_interaction(const SampleContext& sample,
                                                   const SegmentSample& event,
                                                   const SegmentEnd& origin, Vec3 direction,
                                                   SegmentKey segment)
{
    if (event.in_volume) {
        return sample.world.volume_point(origin, direction, *event.in_volume, event.around);
    }
    return event.in_medium ? sample.world.medium_point(origin, direction, *event.in_medium)
                           : sample.world.surface_at(*event.surface, direction, segment,
                                                     sample.camera.pixel_cone());
}

}  // namespace bdpt
