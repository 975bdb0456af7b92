#pragma once

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt {

/// What a normal map makes of a point: a facet with a normal of its own in a surface that has
/// another one, the macroscopic normal. Directions are unit, point away from the surface and are
/// local to the facet, whose normal is +z. docs/decisions/0032 tells why it is like that.
class TiltedFacet {
public:
    /// `macro`: unit, macro.z > 0.
    explicit TiltedFacet(Vec3 macro) noexcept : macro_(macro)
    {
        const float sine = std::sqrt(macro.x * macro.x + macro.y * macro.y);
        const Vec2 lean = sine > 0.0f ? Vec2(macro) / sine : Vec2(1.0f, 0.0f);
        upright_ = {macro.z * lean.x, macro.z * lean.y, -sine};
    }

    [[nodiscard]] Vec3 macro_normal() const { return macro_; }
    /// The cosine to the macroscopic normal.
    [[nodiscard]] float height(Vec3 w) const { return dot(w, macro_); }
    /// Is `w` on the same side of the facet as of the surface?
    [[nodiscard]] bool faces(Vec3 w) const { return w.z * height(w) > 0.0f; }

    /// The reflection of `w` at the second facet of Schuessler et al. [2017, "Microfacet-based
    /// Normal Mapping for Robust Monte Carlo Path Tracing", sec. 3], which stands upright on the
    /// surface so that both together have its normal. It keeps the height.
    [[nodiscard]] Vec3 mirrored(Vec3 w) const { return w - 2.0f * dot(w, upright_) * upright_; }
    /// The share of the surface, as seen from `w`, that the upright facet hides or takes up: 0
    /// where it is turned away, 1 where the facet of the map is [same, eq. 9]. Where it is above 0
    /// the mirrored direction faces the facet.
    [[nodiscard]] float mirrored_share(Vec3 w) const
    {
        const float h = height(w);
        const float facing = h > 0.0f ? w.z : -w.z;
        return std::clamp(1.0f - facing / (macro_.z * std::abs(h)), 0.0f, 1.0f);
    }

    /// Where light comes from that a facet would see through the surface: directions on one side
    /// are taken to the other one, so that even density becomes density by the cosine; the azimuth
    /// stays.
    [[nodiscard]] Vec3 raised(Vec3 w) const
    {
        const float h = height(w);
        const float sine = 1.0f / std::sqrt(1.0f + std::abs(h));
        return (w - h * macro_) * sine - std::copysign(std::sqrt(std::abs(h)), h) * macro_;
    }
    /// The direction that `raised` takes to `w`; its solid angle is `lowering(w)` times that of w.
    [[nodiscard]] Vec3 lowered(Vec3 w) const
    {
        const float h = height(w);
        return (w - h * macro_) * std::sqrt(1.0f + h * h) - std::copysign(h * h, h) * macro_;
    }
    [[nodiscard]] float lowering(Vec3 w) const { return 2.0f * std::abs(height(w)); }

    /// The probability by which samples of the eye's direction go by way of the upright facet,
    /// where it is in sight.
    [[nodiscard]] float mirror_choice() const { return -upright_.z / (1.0f - upright_.z); }

private:
    Vec3 macro_;
    Vec3 upright_;  ///< unit normal of the second facet, at a right angle to `macro_`
};

}  // namespace bdpt
