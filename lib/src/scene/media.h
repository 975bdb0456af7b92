#pragma once

#include "geometry/ray.h"
#include "light/light_samples.h"
#include "material/medium.h"
#include "math/rgb.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace bdpt {

/// Transmittance of a segment that no surface blocks, and the densities of walks along it for MIS
/// weights: means of the channels' densities, which depend on the segment alone and are equal in
/// both directions. What a walk really samples depends on its throughput (`ChannelChoice`).
struct SegmentTransmission {
    Rgb transmittance{1.0f};
    float p_unscattered = 1.0f;  ///< probability that a walk reaches the end without scattering
    float pdf_scatter = 1.0f;    ///< density of scattering at the end [1/m]

    /// Returns the probability or density of a walk reaching the end, which is a scattering event
    /// in a medium or not.
    [[nodiscard]] float pdf_of_end(bool in_medium) const
    {
        return in_medium ? pdf_scatter : p_unscattered;
    }
};

/// Scattering event in a medium.
struct MediumEvent {
    float distance = 0.0f;  ///< [m]
    MediumId medium = MediumId::clear;
};

/// The fog-filled part of a segment [m].
struct FogSpan {
    float begin = 0.0f;
    float end = 0.0f;  ///< > begin
};

/// The media of a scene.
///
/// The medium of a segment is determined by both ends, on the side where the segment lies. If the
/// ends disagree (open or partially overlapping bodies), a scattering medium takes precedence, the
/// denser of two; without any, the larger absorption counts in each channel. The rule must be
/// symmetric in both directions.
class Media {
public:
    /// Adds a medium; returns `MediumId::clear` for a clear one.
    [[nodiscard]] MediumId add(const Medium& medium);
    /// Adds the fog, which is bounded by the sphere; returns `MediumId::clear` if it is clear.
    [[nodiscard]] MediumId add_fog(const Medium& medium, const BoundingSphere& extent);

    [[nodiscard]] const Medium& operator[](MediumId id) const
    {
        return media_[static_cast<std::size_t>(id)];
    }
    /// Tests whether any medium absorbs or scatters.
    [[nodiscard]] bool any() const { return media_.size() > 1; }
    [[nodiscard]] bool any_scatters() const { return any_scatters_; }

    /// Returns the transmission from `a` to `b` in direction `w`, of any length; the segment is
    /// `distance` long.
    [[nodiscard]] SegmentTransmission transmission(const SegmentEnd& a, const SegmentEnd& b, Vec3 w,
                                                   float distance) const noexcept
    {
        const bool clear = a.media.are_clear() && b.media.are_clear();
        return clear ? SegmentTransmission{} : transmission_through(a, b, w, distance);
    }
    /// Returns the medium of the segment: one that scatters, or else one that absorbs.
    [[nodiscard]] MediumId along(const SegmentEnd& a, const SegmentEnd& b, Vec3 w) const noexcept;
    /// Tests whether a medium scatters light on the segment.
    [[nodiscard]] bool scatter(const SegmentEnd& a, const SegmentEnd& b, Vec3 w) const noexcept
    {
        return any_scatters_ && scatterer(a, b, w) != MediumId::clear;
    }
    /// Returns the part of the segment where fog may scatter light; nullopt in bodies, and if it
    /// does not scatter.
    [[nodiscard]] std::optional<FogSpan> fog_between(const SegmentEnd& a, const SegmentEnd& b,
                                                     Vec3 w, float distance) const noexcept;
    [[nodiscard]] MediumId fog() const { return fog_; }
    /// Notes that the medium fills a body; `mean_chord` as in `Medium::mean_scatterings`.
    void fill_body(MediumId id, float mean_chord);
    /// Returns `Medium::mean_scatterings` in the largest of its bodies; 1 without any, as for fog.
    [[nodiscard]] float mean_scatterings(MediumId id) const
    {
        return mean_scatterings_[static_cast<std::size_t>(id)];
    }
    /// Tests whether a walk usually scatters several times in a body.
    [[nodiscard]] bool any_body_scatters() const
    {
        return std::any_of(mean_scatterings_.begin(), mean_scatterings_.end(),
                           [](float mean) { return mean > 1.0f; });
    }
    /// Samples a scattering event at the distance that one of the channels determines; nullopt if
    /// the walk reaches `b`. `w` is unit length, and `scatter` is true.
    [[nodiscard]] std::optional<MediumEvent> draw_event(const SegmentEnd& a, const SegmentEnd& b,
                                                        Vec3 w, float distance,
                                                        const ChannelChoice& channels,
                                                        Vec2 u) const noexcept;
    /// Returns the probability of `draw_event` reaching `b`, or with `in_medium` the density of a
    /// scattering event there [1/m]; 1 if no medium scatters on the segment. `transmittance` is
    /// that of the segment.
    [[nodiscard]] float walk_density(const SegmentEnd& a, const SegmentEnd& b, Vec3 w,
                                     Rgb transmittance, const ChannelChoice& channels,
                                     bool in_medium) const noexcept;

private:
    [[nodiscard]] SegmentTransmission transmission_through(const SegmentEnd& a, const SegmentEnd& b,
                                                           Vec3 w, float distance) const noexcept;
    [[nodiscard]] MediumId scatterer(const SegmentEnd& a, const SegmentEnd& b,
                                     Vec3 w) const noexcept;
    /// Returns the part of the segment that a medium fills.
    [[nodiscard]] FogSpan filled(MediumId medium, Vec3 from, Vec3 w, float distance) const noexcept;

    std::vector<Medium> media_{Medium{}};        // one per id
    std::vector<float> mean_scatterings_{1.0f};  // one per id
    bool any_scatters_ = false;
    MediumId fog_ = MediumId::clear;
    BoundingSphere extent_;  // extent of the fog
};

}  // namespace bdpt
