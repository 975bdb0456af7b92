#pragma once

#include "geometry/segment_end.h"
#include "light/bounding_sphere.h"
#include "material/medium.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace bdpt {

/// What becomes of light on a segment that no surface stops. A walk that scatters light in a medium
/// chooses where in proportion to the mean of the colours' densities, so no colour is preferred
/// [Wilkie et al. 2014, "Hero Wavelength Spectral Sampling"].
struct SegmentTransmission {
    Rgb transmittance{1.0f};
    float p_unscattered =
        1.0f;                  ///< probability that a walk gets to the end without being scattered
    float pdf_scatter = 1.0f;  ///< density of its being scattered there, in length [1/m]

    /// Of a walk coming to the end, which is a point of a medium or not.
    [[nodiscard]] float pdf_of_end(bool in_medium) const
    {
        return in_medium ? pdf_scatter : p_unscattered;
    }
};

/// Where a ray is scattered in a medium.
struct MediumEvent {
    float distance = 0.0f;  ///< [m]
    MediumId medium = MediumId::clear;
};

/// The part of a segment that fog fills [m].
struct FogSpan {
    float begin = 0.0f;
    float end = 0.0f;  ///< > begin
};

/// The media of a scene.
///
/// The medium of a segment is what lies at its ends on the side where it runs. Should the ends
/// disagree (bodies that are open, or lie partly in others), one that scatters counts alone, the
/// denser of two; where none does, the greater absorption counts in each channel. The rule must be
/// the same in both directions.
class Media {
public:
    /// `MediumId::clear` for one that is.
    [[nodiscard]] MediumId add(const Medium& medium);
    /// The same; it ends at the sphere.
    [[nodiscard]] MediumId add_fog(const Medium& medium, const BoundingSphere& extent);

    [[nodiscard]] const Medium& operator[](MediumId id) const
    {
        return media_[static_cast<std::size_t>(id)];
    }
    /// Does any medium of the scene do anything?
    [[nodiscard]] bool any() const { return media_.size() > 1; }
    [[nodiscard]] bool any_scatters() const { return any_scatters_; }

    /// From `a` to `b` in direction `w`, of any length; the segment is `distance` long.
    [[nodiscard]] SegmentTransmission transmission(const SegmentEnd& a, const SegmentEnd& b, Vec3 w,
                                                   float distance) const noexcept
    {
        const bool clear = a.media.are_clear() && b.media.are_clear();
        return clear ? SegmentTransmission{} : transmission_through(a, b, w, distance);
    }
    /// Of the segment: one that scatters, or else one that absorbs.
    [[nodiscard]] MediumId along(const SegmentEnd& a, const SegmentEnd& b, Vec3 w) const noexcept;
    /// Does a medium scatter light there?
    [[nodiscard]] bool scatter(const SegmentEnd& a, const SegmentEnd& b, Vec3 w) const noexcept
    {
        return any_scatters_ && scatterer(a, b, w) != MediumId::clear;
    }
    /// Where fog may scatter light there; nothing in bodies, and where it scatters none.
    [[nodiscard]] std::optional<FogSpan> fog_between(const SegmentEnd& a, const SegmentEnd& b,
                                                     Vec3 w, float distance) const noexcept;
    [[nodiscard]] MediumId fog() const { return fog_; }
    /// Where a walk is scattered by chance; none if it gets to `b`. `w` is unit, and `scatter`
    /// true.
    [[nodiscard]] std::optional<MediumEvent> draw_event(const SegmentEnd& a, const SegmentEnd& b,
                                                        Vec3 w, float distance,
                                                        Vec2 u) const noexcept;

private:
    [[nodiscard]] SegmentTransmission transmission_through(const SegmentEnd& a, const SegmentEnd& b,
                                                           Vec3 w, float distance) const noexcept;
    [[nodiscard]] MediumId scatterer(const SegmentEnd& a, const SegmentEnd& b,
                                     Vec3 w) const noexcept;
    /// What part of the way a medium fills.
    [[nodiscard]] FogSpan filled(MediumId medium, Vec3 from, Vec3 w, float distance) const noexcept;

    std::vector<Medium> media_{Medium{}};  // by id
    bool any_scatters_ = false;
    MediumId fog_ = MediumId::clear;
    BoundingSphere extent_;  // of the fog
};

}  // namespace bdpt
