#pragma once

#include "path/sample_context.h"

#include <optional>

namespace bdpt {

/// Light that a point scatters from one sampled point on a light.
struct DirectLight {
    BsdfEval f;  ///< of the point, towards the light
    /// Of the segment to the light; nullopt if it is blocked, or carries no light and was not
    /// tested.
    std::optional<SegmentTransmission> transmission;
    /// Scattered radiance over the density of the sampled point [nit]; black without transmission.
    Rgb value{0.0f};
    /// Density with which a BSDF sample hits the point on the light, per solid angle; 0 for a delta
    /// light.
    float bsdf_pdf = 0.0f;
};

/// Evaluates the BSDF at a point towards a light that was sampled for it (`light.incident` is set)
/// and casts the shadow ray. Every light sample of paths and pilots passes here, whoever chose it.
/// `segment` is the key of the shadow ray.
[[nodiscard]] DirectLight direct_light(const SampleContext& sample, const SegmentEnd& end,
                                       const Bsdf& bsdf, const LightSet::NextEvent& light,
                                       SegmentKey segment);

/// Applies Russian roulette to a throughput: the survival probability is that relative to `full`,
/// at least `least`. Survivors are reweighted. Densities exclude it, so that all strategies are
/// treated alike.
[[nodiscard]] bool survives(Rgb& beta, float full, float least, Sampler& sampler);

}  // namespace bdpt
