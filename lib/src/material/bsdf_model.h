#pragma once

#include "math/pdf.h"

#include <bdpt/types.h>

#include <cmath>
#include <limits>
#include <optional>

namespace bdpt {

/// Which quantity a walk carries: from the eye radiance, from the light importance-weighted power.
/// Refraction and shading normals scatter the two differently [Veach 1997, ch. 5].
enum class TransportMode { radiance, importance };

/// The BSDF and both sampling densities for one pair of directions: all that a join needs, from one
/// call. Delta lobes are left out of f_cos; the choice probabilities of the other lobes are not
/// renormalised for that.
struct BsdfEval {
    Rgb f_cos{0.0f};        ///< f(wo, wi) |cos(wi)|  [1/sr]
    SolidAnglePdf pdf_fwd;  ///< of sampling wi given wo
    SolidAnglePdf pdf_rev;  ///< of sampling wo given wi
};

/// A sampled direction. For a delta lobe the densities hold P |cos| n^2, where P is the probability
/// of choosing the lobe and cos and n (refractive index) are those on the side that is sampled
/// towards. The Dirac factor is left out: it stands in every strategy that can make the path, and
/// cancels (docs/mis.md).
struct BsdfSample {
    Vec3 wi{0.0f};     ///< unit
    Rgb weight{0.0f};  ///< f_cos / pdf_fwd; F/P for a delta lobe  [1]
    SolidAnglePdf pdf_fwd{};
    SolidAnglePdf pdf_rev{};
    bool delta = false;
};

/// The whole sample of a direction that is not a delta lobe's; none where it has no density.
[[nodiscard]] inline std::optional<BsdfSample> smooth_sample(Vec3 wi, const BsdfEval& value)
{
    if (!(value.pdf_fwd.value >= std::numeric_limits<float>::min())) {
        return std::nullopt;
    }
    return BsdfSample{wi, value.f_cos * (1.0f / value.pdf_fwd.value), value.pdf_fwd, value.pdf_rev,
                      false};
}

/// Nothing scatters closer to the surface: the products of two cosines would vanish.
[[nodiscard]] inline bool grazes(Vec3 w)
{
    return std::abs(w.z) < 1e-15f;
}

/// Those of a direction to the two normals of a surface.
struct Cosines {
    float geometric;
    float shading;

    /// In sign; where they do not, nothing scatters, for light neither leaks through a surface nor
    /// comes from below it.
    [[nodiscard]] bool agree() const { return geometric * shading > 0.0f; }
    /// Where they agree.
    [[nodiscard]] float ratio() const { return geometric / shading; }
};

}  // namespace bdpt
