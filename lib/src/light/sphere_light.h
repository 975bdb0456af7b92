#pragma once

#include "geometry/sphere.h"
#include "light/light_model.h"
#include "light/light_samples.h"
#include "light/light_tree.h"
#include "light/point_emission.h"

#include <bdpt/scene_desc.h>

#include <optional>
#include <span>

namespace bdpt {

/// A point or spot light with a radius: a black sphere that emits from its outside. Its radiance is
/// intensity / (pi r^2), so that from afar it is the point light; that of a spot falls off with the
/// *direction* of the light, equally at all points of the sphere.
class SphereLight {
public:
    static constexpr bool is_delta = false;
    static constexpr bool is_infinite = false;

    /// `number` is the index of the sphere in the scene's geometry. The motion of `desc` must
    /// outlive this.
    SphereLight(const PointLightDesc& desc, std::uint32_t number);
    SphereLight(const SpotLightDesc& desc, std::uint32_t number);

    /// Returns the point with the unit normal `ng`.
    [[nodiscard]] SegmentEnd surface(Vec3 ng, float time) const;
    /// Returns the radiance in a unit direction away from the sphere [nit].
    [[nodiscard]] Rgb radiance(Vec3 direction, float time) const;

    /// Samples directions uniformly in the spot's cone, and points uniformly on the projected disk
    /// of the sphere in that direction: for a point light that is area times cosine.
    [[nodiscard]] std::optional<EmissionSample> sample_emission(Vec2 u_position, Vec2 u_direction,
                                                                float time) const;
    /// Samples directions uniformly in the cone that the sphere subtends; nullopt from its inside.
    [[nodiscard]] std::optional<IncidentSample> sample_incident(const LightSampleContext& receiver,
                                                                Vec2 u,
                                                                EnvironmentSampling sampling,
                                                                float time) const;

    /// Returns the uniform density over the area. For a spot that is not the marginal density of
    /// the position; but its product with `pdf_direction` is the joint density, and nothing else is
    /// used.
    [[nodiscard]] AreaPdf pdf_position(const LightPoint& x0 = {}) const;
    [[nodiscard]] AreaPdf pdf_incident(
        const LightSampleContext& receiver, const LightPoint& x0,
        EnvironmentSampling sampling = EnvironmentSampling::plain) const;
    [[nodiscard]] SolidAnglePdf pdf_direction(Vec3 ng, Vec3 direction, float time) const;
    /// Returns the luminous flux [lm].
    [[nodiscard]] Rgb power() const { return intensity_ * cone_.integral(); }
    [[nodiscard]] LightBounds bounds() const;

private:
    [[nodiscard]] SpotCone cone(float time) const;

    Sphere sphere_;
    std::uint32_t number_;
    Rgb intensity_;  // [cd]
    SpotCone cone_;
    Vec3 axis_{0.0f, 0.0f, 1.0f};
    std::span<const Vec3> turn_;
};

}  // namespace bdpt
