#pragma once

#include "geometry/placed_mesh.h"
#include "material/material.h"
#include "math/distributions.h"

#include <memory>

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

}  // namespace bdpt
