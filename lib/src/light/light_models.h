#pragma once

#include "light/delta_lights.h"
#include "light/environment_light.h"
#include "light/intensity_profile.h"
#include "light/light_model.h"
#include "light/light_samples.h"
#include "light/sphere_light.h"
#include "light/triangle_light.h"

#include <bdpt/scene_desc.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

namespace bdpt {

/// One light of any kind. To add a kind, add it here and to `make_model`.
template <LightModel... Kinds>
using AnyOf = std::variant<Kinds...>;
using AnyLightModel = AnyOf<TriangleLight, SphereLight, PunctualLight, DirectionalLight,
                            EnvironmentLight, ProfileLight>;

/// Data that a scene's lights may refer to; outlives them.
struct LightContext {
    std::span<const IntensityProfile> profiles;
    BoundingSphere bounds;
    std::uint32_t sphere = 0;           ///< index of the light if it is a sphere
    MediumId medium = MediumId::clear;  ///< medium around the light
};

// Converts a description, which must outlive the light.

template <typename PointOrSpot>
requires std::constructible_from<PunctualLight, const PointOrSpot&>
[[nodiscard]] AnyLightModel make_model(const PointOrSpot& desc, const LightContext& context)
{
    if (desc.radius > 0.0f) {
        return SphereLight(desc, context.sphere);
    }
    return PunctualLight(desc);
}

[[nodiscard]] inline AnyLightModel make_model(const DirectionalLightDesc& desc,
                                              const LightContext& context)
{
    return DirectionalLight(desc, context.bounds);
}

[[nodiscard]] inline AnyLightModel make_model(const EnvironmentLightDesc& desc,
                                              const LightContext& context)
{
    return EnvironmentLight(desc, context.bounds);
}

[[nodiscard]] inline AnyLightModel make_model(const ProfileLightDesc& desc,
                                              const LightContext& context)
{
    return ProfileLight(desc, context.profiles[static_cast<std::size_t>(desc.profile)]);
}

}  // namespace bdpt
