#include "path/direct_light.h"

#include <algorithm>

namespace bdpt {

DirectLight direct_light(const SampleContext& sample, const SegmentEnd& end, const Bsdf& bsdf,
                         const LightSet::NextEvent& light, SegmentKey segment)
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

bool survives(Rgb& beta, float full, float least, Sampler& sampler)
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
