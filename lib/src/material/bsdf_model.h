#pragma once

#include "math/pdf.h"

#include <bdpt/types.h>

#include <cmath>
#include <limits>
#include <optional>

namespace bdpt {

/// The quantity that a walk carries: camera walks carry radiance, light walks importance-weighted
/// power (the adjoint). Refraction and shading normals scatter the two differently [Veach 1997, ch.
/// 5].
enum class TransportMode { radiance, importance };

/// The BSDF and both sampling densities for one pair of directions: all that a connection needs,
/// from one call. f_cos excludes delta lobes; the choice probabilities of the other lobes are not
/// renormalised for that.
struct BsdfEval {
    Rgb f_cos{0.0f};        ///< f(wo, wi) |cos(wi)|  [1/sr]
    SolidAnglePdf pdf_fwd;  ///< density of sampling wi given wo
    SolidAnglePdf pdf_rev;  ///< density of sampling wo given wi
};

/// A sampled direction. For a delta lobe the densities hold P |cos| n^2, where P is the probability
/// of choosing the lobe, and cos and n (refractive index) are those on the side of the sampled
/// direction. The Dirac factor is omitted: it appears in every strategy that can sample the path,
/// and cancels (docs/mis.md).
struct BsdfSample {
    Vec3 wi{0.0f};     ///< unit
    Rgb weight{0.0f};  ///< f_cos / pdf_fwd; F/P for a delta lobe  [1]
    SolidAnglePdf pdf_fwd{};
    SolidAnglePdf pdf_rev{};
    bool delta = false;
};

/// Returns the complete sample of a direction of a lobe that is not delta; nullopt if its density
/// is zero.
[[nodiscard]] inline std::optional<BsdfSample> smooth_sample(Vec3 wi, const BsdfEval& value)
{
    if (!(value.pdf_fwd.value >= std::numeric_limits<float>::min())) {
        return std::nullopt;
    }
    return BsdfSample{wi, value.f_cos * (1.0f / value.pdf_fwd.value), value.pdf_fwd, value.pdf_rev,
                      false};
}

/// Tests whether a direction is too close to the surface to scatter: the products of two cosines
/// would vanish.
[[nodiscard]] inline bool grazes(Vec3 w)
{
    return std::abs(w.z) < 1e-15f;
}

/// Cosines of a direction to the two normals of a surface.
struct Cosines {
    float geometric;
    float shading;

    /// Tests whether the signs agree; otherwise nothing scatters, as light neither leaks through a
    /// surface nor arrives from below it.
    [[nodiscard]] bool agree() const { return geometric * shading > 0.0f; }
    /// Returns the ratio of the cosines; requires `agree()`.
    [[nodiscard]] float ratio() const { return geometric / shading; }
};

}  // namespace bdpt
