#pragma once

#include "light/light_samples.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <optional>

namespace bdpt {

/// Returns the light of a point light at a receiver: its intensity, `intensity` times
/// `falloff(direction)` of the direction away from it, over the squared distance. nullopt if that
/// is 0.
template <typename Falloff>
[[nodiscard]] std::optional<IncidentSample> incident_from_point(Vec3 position, Vec3 receiver,
                                                                Rgb intensity,
                                                                const Falloff& falloff)
{
    const Vec3 to_light = position - receiver;
    const float distance_squared = dot(to_light, to_light);
    if (!(distance_squared > 0.0f)) {
        return std::nullopt;
    }
    const float distance = std::sqrt(distance_squared);
    const Vec3 wi = to_light / distance;
    const float attenuation = falloff(-wi);
    if (attenuation == 0.0f) {
        return std::nullopt;
    }
    return IncidentSample{.end = {.p = position},
                          .wi = wi,
                          .distance = distance,
                          .weight = intensity * (attenuation / distance_squared),
                          .pdf = {1.0f},
                          .pdf_solid_angle = {1.0f}};
}

}  // namespace bdpt
