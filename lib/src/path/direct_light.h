#pragma once

#include "path/sample_context.h"

#include <algorithm>
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
[[nodiscard]] inline DirectLight direct_light(const SampleContext& sample, const SegmentEnd& end,
                                              const Bsdf& bsdf, const LightSet::NextEvent& light,
                                              SegmentKey segment)
{
    const IncidentSample& incident = *light.incident;
    const Light& source = sample.world.lights()[light.light];
    DirectLight found;
    found.f = bsdf.eval(incident.wi, TransportMode::radiance);
    if (is_black(found.f.f_cos * incident.weight / light.probability)) {
        return found;
    }
    ++sample.rays.shadow;
    found.transmission = source.is_infinite()
                             ? sample.world.transmission_to_infinity(end, incident.wi, segment)
                             : sample.world.transmission(end, incident.end, segment);
    if (found.transmission) {
        found.value = found.f.f_cos * source.incident_weight(incident) / light.probability *
                      found.transmission->transmittance;
        found.bsdf_pdf =
            source.is_delta() ? 0.0f : found.f.pdf_fwd.value * found.transmission->p_unscattered;
    }
    return found;
}

/// Applies Russian roulette to a throughput: the survival probability is that relative to `full`,
/// at least `least`. Survivors are reweighted. Densities exclude it, so that all strategies are
/// treated alike.
[[nodiscard]] inline bool survives(Rgb& beta, float full, float least, Sampler& sampler)
{
    const float survival = std::max(max_component(beta) / full, least);
    if (survival >= 1.0f) {
        return true;
    }
    if (sampler.next_1d() >= survival) {
        return false;
    }
    beta /= survival;
    return true;
}

}  // namespace bdpt
