#pragma once

#include "geometry/placed_mesh.h"
#include "geometry/spherical_triangle.h"
#include "light/light_model.h"
#include "light/light_samples.h"
#include "light/tree/light_bounds.h"
#include "light/triangle_emission.h"
#include "material/material.h"

#include <optional>

namespace bdpt {

/// One emissive triangle: a Lambertian emitter on its front or on both sides. Points are sampled by
/// the texture's luminance, both for light paths and for next-event estimation; the latter samples
/// by solid angle if the radiance is constant and the triangle looks large.
class TriangleLight {
public:
    static constexpr bool is_delta = false;
    static constexpr bool is_infinite = false;

    /// `emission` is the result of `measure_emission`.
    TriangleLight(const PlacedMesh& mesh, const Material& material, std::uint32_t triangle,
                  TriangleEmission emission);

    [[nodiscard]] std::optional<EmissionSample> sample_emission(Vec2 u_position, Vec2 u_direction,
                                                                float time) const;
    [[nodiscard]] std::optional<IncidentSample> sample_incident(const LightSampleContext& receiver,
                                                                Vec2 u,
                                                                EnvironmentSampling sampling,
                                                                float time) const;

    [[nodiscard]] AreaPdf pdf_position(const LightPoint& x0) const;
    [[nodiscard]] AreaPdf pdf_incident(
        const LightSampleContext& receiver, const LightPoint& x0,
        EnvironmentSampling sampling = EnvironmentSampling::plain) const;
    [[nodiscard]] SolidAnglePdf pdf_direction(Vec3 ng, Vec3 direction, float time) const;
    /// Returns the emitted luminous flux [lm]; the mean at and between the steps of a motion.
    [[nodiscard]] Rgb power() const;
    [[nodiscard]] LightBounds bounds() const;

    /// The mesh that it is a triangle of, in one place.
    [[nodiscard]] const PlacedMesh& surface() const { return *mesh_; }

private:
    struct Point {
        SegmentEnd end;
        Vec2 barycentrics;
        AreaPdf pdf;
        float inverse_pdf;
        Rgb radiance;
    };
    struct Facing {
        float area;
        float inverse_area;
        Vec3 ng;  ///< unit length; not finite without area
    };
    /// Returns the density of a direction; `cosine` is that to the front normal.
    [[nodiscard]] SolidAnglePdf pdf_direction(float cosine) const;
    [[nodiscard]] static Facing compute_facing(Vec3 area_normal);
    [[nodiscard]] Facing facing(float time) const;
    [[nodiscard]] float mean_area() const;
    [[nodiscard]] AreaPdf pdf_position(Vec2 barycentrics, const Facing& at) const;
    /// Returns the density relative to the uniform one.
    [[nodiscard]] float spread(Vec2 barycentrics) const;
    /// Samples a point by area; `facing` is that at the time, and has an area.
    [[nodiscard]] Point point(Vec2 u, const Facing& facing, float time) const;
    /// Returns the point with these barycentric coordinates, sampled with this density relative to
    /// the uniform one.
    [[nodiscard]] Point point_at(Vec2 barycentrics, float spread, const Facing& facing,
                                 float time) const;
    /// Returns the triangle as seen from p if it looks large there; nullopt: sampled by area.
    [[nodiscard]] std::optional<SphericalTriangle> seen_from(Vec3 p, const Facing& facing,
                                                             float time) const;

    const PlacedMesh* mesh_;
    const Material* material_;
    std::uint32_t triangle_;
    Facing first_;  ///< at shutter open
    float mean_area_;
    TriangleEmission emission_;
    std::optional<Rgb> even_radiance_;  ///< set if constant over the triangle
};

}  // namespace bdpt
