#pragma once

#include "light/light_models.h"
#include "light/light_sample_context.h"
#include "light/light_samples.h"
#include "light/tree/light_bounds.h"

#include <optional>
#include <utility>

namespace bdpt {

/// Any light: it does what its kind does. Kinds are listed in light/light_models.h.
class Light {
public:
    using Model = AnyLightModel;

    explicit Light(Model model);
    Light(const LightDesc& desc, const LightContext& context);

    [[nodiscard]] std::optional<EmissionSample> sample_emission(Vec2 u_position, Vec2 u_direction,
                                                                float time) const;
    /// `sampling` counts for environments.
    [[nodiscard]] std::optional<IncidentSample> sample_incident(const LightSampleContext& receiver,
                                                                Vec2 u,
                                                                EnvironmentSampling sampling,
                                                                float time) const;

    /// The whole `weight` of what `sample_incident` has sampled, wherever its light is kept.
    [[nodiscard]] Rgb incident_weight(const IncidentSample& incident) const
    {
        const auto* environment = std::get_if<EnvironmentLight>(&model_);
        return environment != nullptr ? environment->incident_weight(incident) : incident.weight;
    }

    /// Of x_0 as the start of a light path: on the surface, or for an infinite light of the
    /// direction; 1 for a delta light.
    [[nodiscard]] AreaPdf pdf_position(const LightPoint& x0) const;
    /// Of x_0 by `sample_incident` from `receiver`, in the same measure.
    [[nodiscard]] AreaPdf pdf_incident(
        const LightSampleContext& receiver, const LightPoint& x0,
        EnvironmentSampling sampling = EnvironmentSampling::plain) const;
    /// Of the direction of a light path that leaves a finite light at a point with the normal `ng`,
    /// zero if none. `SphereLight` says which factor of the joint density this is.
    [[nodiscard]] SolidAnglePdf pdf_direction(Vec3 ng, Vec3 direction, float time) const;

    /// No ray hits it by chance: s = 0 is impossible.
    [[nodiscard]] bool is_delta() const { return is_delta_; }
    [[nodiscard]] bool is_infinite() const { return is_infinite_; }
    /// Luminous flux [lm] into the scene; the mean while the shutter is open, about.
    [[nodiscard]] Rgb power() const;
    /// Where it is and shines while the shutter is open; nothing for an infinite light.
    [[nodiscard]] std::optional<LightBounds> bounds() const;

    [[nodiscard]] const Model& model() const { return model_; }
    /// Around it; not set for triangles, whose material knows.
    [[nodiscard]] SideMedia media() const { return media_; }

private:
    Model model_;
    bool is_delta_;
    bool is_infinite_;
    SideMedia media_{};
};

}  // namespace bdpt
