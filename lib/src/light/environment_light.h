#pragma once

#include "light/bounding_sphere.h"
#include "light/light_model.h"
#include "light/light_samples.h"
#include "math/distribution_2d.h"

#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <optional>
#include <vector>

namespace bdpt {

/// Light from all directions at infinity, from an equirectangular image that is looked up with
/// bilinear interpolation. Light paths start in proportion to luminance; next-event estimation has
/// the choice of `EnvironmentSampling`.
class EnvironmentLight : public InfiniteLight {
public:
    static constexpr bool is_delta = false;

    /// The image is copied; negative values have been refused before.
    EnvironmentLight(const EnvironmentLightDesc& desc, const BoundingSphere& bounds);

    /// `to_light`: unit, from the scene towards infinity.
    [[nodiscard]] Rgb radiance(Vec3 to_light) const;
    /// Of the direction that a light path comes from.
    [[nodiscard]] AreaPdf pdf_position(const LightPoint& x0) const;
    /// Of the direction that `sample_incident` takes; compensated, it can be zero where light is.
    [[nodiscard]] SolidAnglePdf pdf_incident(Vec3 to_light, EnvironmentSampling sampling) const;
    [[nodiscard]] AreaPdf pdf_incident(Vec3 receiver, const LightPoint& x0,
                                       EnvironmentSampling sampling) const;

    [[nodiscard]] std::optional<EmissionSample> sample_emission(Vec2 u_position, Vec2 u_direction,
                                                                float time) const;
    [[nodiscard]] std::optional<IncidentSample> sample_incident(Vec3 receiver, Vec2 u,
                                                                EnvironmentSampling sampling,
                                                                float time) const;
    /// Luminous flux into the scene's bounding sphere [lm].
    [[nodiscard]] Rgb power() const;

private:
    struct Direction {
        Vec3 to_light;
        Rgb radiance;
        SolidAnglePdf pdf;
    };
    [[nodiscard]] const Distribution2D& distribution(EnvironmentSampling sampling) const;
    [[nodiscard]] std::optional<Direction> sample_direction(Vec2 u,
                                                            EnvironmentSampling sampling) const;
    [[nodiscard]] Vec2 uv_of(Vec3 to_light) const;
    [[nodiscard]] Rgb lookup(Vec2 uv) const;
    [[nodiscard]] const Rgb& texel(int x, int y) const;
    [[nodiscard]] int row_of(float v) const;
    [[nodiscard]] SolidAnglePdf to_solid_angle(float pdf_square, int row) const;

    Image image_;
    Mat3 world_from_environment_;
    BoundingSphere bounds_;
    std::vector<float> row_cosines_;
    Distribution2D plain_;
    Distribution2D compensated_;
};

}  // namespace bdpt
