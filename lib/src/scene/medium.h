#pragma once

#include "geometry/segment_end.h"

namespace bdpt {

/// `medium_transmittance` where at least one end bounds a medium that absorbs.
[[nodiscard]] Rgb absorbed_transmittance(const SegmentEnd& a, const SegmentEnd& b, Vec3 w,
                                         float distance) noexcept;

/// What a medium leaves of light over a segment that is known to be free. `w`: from a to b, any
/// length. The medium is what lies behind the surface at an end if the segment runs there. Should
/// the ends disagree (open bodies, bodies in bodies), the denser one counts, in each channel: the
/// rule must be the same in both directions.
[[nodiscard]] inline Rgb medium_transmittance(const SegmentEnd& a, const SegmentEnd& b, Vec3 w,
                                              float distance) noexcept
{
    const bool clear = a.absorption == Rgb(0.0f) && b.absorption == Rgb(0.0f);
    return clear ? Rgb(1.0f) : absorbed_transmittance(a, b, w, distance);
}

}  // namespace bdpt
