#pragma once

#include "light/intensity_profile.h"
#include "light/light_model.h"
#include "light/light_samples.h"
#include "light/tree/light_bounds.h"

#include <bdpt/scene_desc.h>

#include <optional>
#include <span>

namespace bdpt {

/// A point light with an intensity profile [EXT_lights_ies]: delta in position, like
/// `PunctualLight`.
class ProfileLight : public DeltaLight {
public:
    static constexpr bool is_infinite = false;

    /// `profile` is that of the description; it and the motion must outlive the light.
    ProfileLight(const ProfileLightDesc& desc, const IntensityProfile& profile);

    /// Samples directions in proportion to their intensity; nullopt for a black profile.
    [[nodiscard]] std::optional<EmissionSample> sample_emission(Vec2 u_position, Vec2 u_direction,
                                                                float time) const;
    [[nodiscard]] std::optional<IncidentSample> sample_incident(const LightSampleContext& receiver,
                                                                Vec2 u,
                                                                EnvironmentSampling sampling,
                                                                float time) const;
    [[nodiscard]] SolidAnglePdf pdf_direction(Vec3 ng, Vec3 direction, float time) const;
    /// Returns the luminous flux [lm].
    [[nodiscard]] Rgb power() const { return scale_ * profile_->flux(); }
    /// Returns bounds of a light that may emit in all directions.
    [[nodiscard]] LightBounds bounds() const;

private:
    [[nodiscard]] Vec3 to_local(Vec3 direction) const;

    const IntensityProfile* profile_;
    Vec3 position_;
    std::span<const Vec3> motion_;
    Mat3 world_from_light_;
    Rgb scale_;
};

}  // namespace bdpt
