#pragma once

#include "geometry/placed_mesh.h"
#include "light/light_bounds.h"
#include "light/light_samples.h"
#include "light/triangle_emission.h"
#include "material/material.h"

#include <optional>

namespace bdpt {

/// One emissive triangle: a Lambertian emitter on its front or on both sides. Points are sampled by
/// the texture's luminance, both for light paths and for next-event estimation.
class TriangleLight {
public:
    /// `most_samples`: as for `measure_emission`.
    TriangleLight(const PlacedMesh& mesh, const Material& material, std::uint32_t triangle,
                  int most_samples);

    [[nodiscard]] std::optional<EmissionSample> sample_emission(Vec2 u_position,
                                                                Vec2 u_direction) const;
    [[nodiscard]] std::optional<IncidentSample> sample_incident(Vec3 receiver, Vec2 u) const;

    /// Density of a light path's direction; `cosine` is that to the front normal.
    [[nodiscard]] SolidAnglePdf pdf_direction(float cosine) const;
    [[nodiscard]] AreaPdf pdf_position(Vec2 barycentrics) const;
    /// Emitted luminous flux [lm].
    [[nodiscard]] Rgb power() const;
    [[nodiscard]] LightBounds bounds() const;

private:
    struct Point {
        SegmentEnd end;
        Vec2 barycentrics;
        AreaPdf pdf;
        Rgb radiance;
    };
    [[nodiscard]] Point point(Vec2 u) const;

    const PlacedMesh* mesh_;
    const Material* material_;
    std::uint32_t triangle_;
    float area_;
    Vec3 ng_;  ///< unit; zero without an area
    TriangleEmission emission_;
};

}  // namespace bdpt
