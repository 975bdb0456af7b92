#pragma once

#include "geometry/segment_end.h"

namespace bdpt {

/// `medium_transmittance` where at least one end has a medium that absorbs.
[[nodiscard]] Rgb absorbed_transmittance(const SegmentEnd& a, const SegmentEnd& b, Vec3 w,
                                         float distance) noexcept;

/// What a medium leaves of light over a segment that is known to be free. `w`: from a to b, any
/// length. The medium is what lies at an end on the side where the segment runs. Should the ends
/// disagree (bodies that are open, or lie partly in others), the denser one counts, in each
/// channel: the rule must be the same in both directions.
[[nodiscard]] inline Rgb medium_transmittance(const SegmentEnd& a, const SegmentEnd& b, Vec3 w,
                                              float distance) noexcept
{
    const bool clear = a.media == nullptr && b.media == nullptr;
    return clear ? Rgb(1.0f) : absorbed_transmittance(a, b, w, distance);
}

}  // namespace bdpt
