#pragma once

#include "light/intensity_profile.h"
#include "light/learned/entries.h"
#include "light/light_model.h"
#include "light/light_samples.h"
#include "light/light_tree.h"
#include "light/point_emission.h"

#include <bdpt/scene_desc.h>

#include <optional>
#include <span>

namespace bdpt {

/// A point or spot light of KHR_lights_punctual: delta in position, so no ray ever hits it. A point
/// light is a spot whose cone is the whole sphere.
class PunctualLight : public DeltaLight {
public:
    static constexpr bool is_infinite = false;

    /// The motion of `desc` must outlive this.
    explicit PunctualLight(const PointLightDesc& desc);
    explicit PunctualLight(const SpotLightDesc& desc);

    /// Samples directions uniformly in the cone.
    [[nodiscard]] EmissionSample sample_emission(Vec2 u_position, Vec2 u_direction,
                                                 float time) const;
    [[nodiscard]] std::optional<IncidentSample> sample_incident(const LightSampleContext& receiver,
                                                                Vec2 u,
                                                                EnvironmentSampling sampling,
                                                                float time) const;
    [[nodiscard]] SolidAnglePdf pdf_direction(Vec3 /*ng*/, Vec3 direction, float time) const
    {
        return cone(time).pdf(direction);
    }
    /// Returns the luminous flux [lm].
    [[nodiscard]] Rgb power() const { return intensity_ * cone_.integral(); }
    [[nodiscard]] LightBounds bounds() const;

private:
    [[nodiscard]] Vec3 position(float time) const;
    [[nodiscard]] SpotCone cone(float time) const;

    Vec3 position_;
    Rgb intensity_;  // [cd]
    SpotCone cone_;
    Vec3 axis_{0.0f, 0.0f, 1.0f};
    std::span<const Vec3> motion_;
    std::span<const Vec3> turn_;
};

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

/// Parallel light from infinity: delta in direction.
class DirectionalLight : public DeltaLight, public InfiniteLight {
public:
    /// The motion of `desc` must outlive this.
    DirectionalLight(const DirectionalLightDesc& desc, const BoundingSphere& bounds);

    [[nodiscard]] EmissionSample sample_emission(Vec2 u_position, Vec2 /*u_direction*/,
                                                 float time) const
    {
        return sample_emission(u_position, time, EntryWindow(bounds_));
    }
    /// Starts light where it enters, as learned.
    [[nodiscard]] EmissionSample sample_emission(Vec2 u_position, float time,
                                                 const EntryWindow& window) const;
    [[nodiscard]] IncidentSample sample_incident(const LightSampleContext& receiver, Vec2 u,
                                                 EnvironmentSampling sampling, float time) const;
    /// Returns the luminous flux through the scene's disk [lm].
    [[nodiscard]] Rgb power() const;

private:
    [[nodiscard]] Vec3 direction(float time) const;

    Vec3 direction_;
    Rgb illuminance_;
    BoundingSphere bounds_;
    Vec3 axis_;  ///< as described, of any length
    std::span<const Vec3> turn_;
};

}  // namespace bdpt
