#pragma once

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt {

/// A facet of a normal map: its normal differs from that of the surface, the macroscopic normal.
/// Directions are unit, point away from the surface and are local to the facet, whose normal is +z.
/// docs/decisions/0032 gives the reasons.
class TiltedFacet {
public:
    /// `macro` is unit, macro.z > 0.
    explicit TiltedFacet(Vec3 macro) noexcept : macro_(macro)
    {
        const float sine = std::sqrt(macro.x * macro.x + macro.y * macro.y);
        const Vec2 lean = sine > 0.0f ? Vec2(macro) / sine : Vec2(1.0f, 0.0f);
        upright_ = {macro.z * lean.x, macro.z * lean.y, -sine};
    }

    [[nodiscard]] Vec3 macro_normal() const { return macro_; }
    /// Returns the cosine to the macroscopic normal.
    [[nodiscard]] float height(Vec3 w) const { return dot(w, macro_); }
    /// Tests whether `w` is on the same side of the facet as of the surface.
    [[nodiscard]] bool faces(Vec3 w) const { return w.z * height(w) > 0.0f; }

    /// Reflects `w` at the second facet of Schuessler et al. [2017, "Microfacet-based Normal
    /// Mapping for Robust Monte Carlo Path Tracing", sec. 3], which stands upright on the surface
    /// so that both together have its normal. The height is preserved.
    [[nodiscard]] Vec3 mirrored(Vec3 w) const { return w - 2.0f * dot(w, upright_) * upright_; }
    /// Returns the fraction of the surface, as seen from `w`, that the upright facet covers: 0
    /// where it faces away, 1 where the facet of the map does [same, eq. 9]. If it is positive the
    /// mirrored direction faces the facet.
    [[nodiscard]] float mirrored_share(Vec3 w) const
    {
        const float h = height(w);
        const float facing = h > 0.0f ? w.z : -w.z;
        return std::clamp(1.0f - facing / (macro_.z * std::abs(h)), 0.0f, 1.0f);
    }

    /// Returns the origin of light that a facet would see through the surface: directions on one
    /// side are mapped to the other, so that uniform density becomes cosine-weighted density; the
    /// azimuth is preserved.
    [[nodiscard]] Vec3 raised(Vec3 w) const
    {
        const float h = height(w);
        const float sine = 1.0f / std::sqrt(1.0f + std::abs(h));
        return (w - h * macro_) * sine - std::copysign(std::sqrt(std::abs(h)), h) * macro_;
    }
    /// Returns the direction that `raised` maps to `w`; its solid angle is `lowering(w)` times that
    /// of w.
    [[nodiscard]] Vec3 lowered(Vec3 w) const
    {
        const float h = height(w);
        return (w - h * macro_) * std::sqrt(1.0f + h * h) - std::copysign(h * h, h) * macro_;
    }
    [[nodiscard]] float lowering(Vec3 w) const { return 2.0f * std::abs(height(w)); }

    /// Returns the probability with which samples of the eye's direction use the upright facet, if
    /// it is visible.
    [[nodiscard]] float mirror_choice() const { return -upright_.z / (1.0f - upright_.z); }

private:
    Vec3 macro_;
    Vec3 upright_;  ///< unit normal of the second facet, perpendicular to `macro_`
};

}  // namespace bdpt
