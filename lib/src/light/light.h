#pragma once

#include "light/light_models.h"
#include "light/light_samples.h"
#include "light/light_tree.h"

#include <optional>

namespace bdpt {

/// Any light; forwards to its kind. Kinds are listed in light/light_models.h.
class Light {
public:
    using Model = AnyLightModel;

    explicit Light(Model model);
    Light(const LightDesc& desc, const LightContext& context);

    [[nodiscard]] std::optional<EmissionSample> sample_emission(Vec2 u_position, Vec2 u_direction,
                                                                float time) const;
    /// Samples a point on the light for a receiver. `sampling` affects environments.
    [[nodiscard]] std::optional<IncidentSample> sample_incident(const LightSampleContext& receiver,
                                                                Vec2 u,
                                                                EnvironmentSampling sampling,
                                                                float time) const;

    /// Returns the full `weight` of a sample of `sample_incident`, including the radiance that
    /// environments look up later.
    [[nodiscard]] Rgb incident_weight(const IncidentSample& incident) const
    {
        const auto* environment = std::get_if<EnvironmentLight>(&model_);
        return environment != nullptr ? environment->incident_weight(incident) : incident.weight;
    }

    /// Returns the density of x_0 as start of a light path: area density on the surface, density of
    /// the direction for an infinite light, 1 for a delta light.
    [[nodiscard]] AreaPdf pdf_position(const LightPoint& x0) const;
    /// Returns the density of x_0 by `sample_incident` from `receiver`, in the same measure.
    [[nodiscard]] AreaPdf pdf_incident(
        const LightSampleContext& receiver, const LightPoint& x0,
        EnvironmentSampling sampling = EnvironmentSampling::plain) const;
    /// Returns the density of the direction of a light path that leaves a finite light at a point
    /// with the normal `ng`, zero if not on a surface. `SphereLight` documents its factorization of
    /// the joint density.
    [[nodiscard]] SolidAnglePdf pdf_direction(Vec3 ng, Vec3 direction, float time) const;

    /// Tests whether no ray hits it by chance: s = 0 is impossible.
    [[nodiscard]] bool is_delta() const { return is_delta_; }
    [[nodiscard]] bool is_infinite() const { return is_infinite_; }
    /// Returns the luminous flux into the scene [lm]; approximately the mean while the shutter is
    /// open.
    [[nodiscard]] Rgb power() const;
    /// Returns the bounds of positions and directions while the shutter is open; nullopt for an
    /// infinite light.
    [[nodiscard]] std::optional<LightBounds> bounds() const;

    [[nodiscard]] const Model& model() const { return model_; }
    /// Returns the media around it; not set for triangles, whose material has them.
    [[nodiscard]] SideMedia media() const { return media_; }

private:
    Model model_;
    bool is_delta_;
    bool is_infinite_;
    SideMedia media_{};
};

}  // namespace bdpt
