#pragma once

#include "geometry/placed_mesh.h"
#include "geometry/spherical_triangle.h"
#include "light/light_model.h"
#include "light/light_samples.h"
#include "light/light_tree.h"
#include "material/material.h"
#include "math/distributions.h"

#include <memory>
#include <optional>

namespace bdpt {

/// Returns the texture coordinates and vertex colour at a point of a triangle.
[[nodiscard]] inline TexturePoint texture_point(const PlacedMesh& mesh, std::uint32_t triangle,
                                                Vec2 barycentrics)
{
    return {.uv = mesh.uv(triangle, barycentrics), .color = mesh.color(triangle, barycentrics)};
}

/// Amount and distribution of the emission of one triangle.
struct TriangleEmission {
    Rgb mean{0.0f};  ///< expected radiance, averaged over the triangle [nit]
    /// Distribution by luminance over the unit square that `square_to_triangle` maps; null:
    /// uniform.
    std::shared_ptr<const Distribution2D> spread;
};

/// Reads the emission and its textures on a regular grid, fine enough for their texels but of at
/// most `max_samples` per side. A small uniform part covers emission that the grid may have missed,
/// so that no emitting point has a density of zero.
[[nodiscard]] TriangleEmission measure_emission(const PlacedMesh& mesh, const Material& material,
                                                std::uint32_t triangle, int max_samples);

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
