#pragma once

#include "geometry/placed_mesh.h"
#include "material/material.h"
#include "math/distribution_2d.h"

#include <memory>

namespace bdpt {

/// Where textures and vertex colours are looked up at a point of a triangle.
[[nodiscard]] inline TexturePoint texture_point(const PlacedMesh& mesh, std::uint32_t triangle,
                                                Vec2 barycentrics)
{
    return {.uv = mesh.uv(triangle, barycentrics), .color = mesh.color(triangle, barycentrics)};
}

/// What one emissive triangle emits and where on it.
struct TriangleEmission {
    Rgb mean{0.0f};  ///< expected radiance, averaged over the triangle [nit]
    /// By luminance over the unit square that `square_to_triangle` maps; null: evenly.
    std::shared_ptr<const Distribution2D> spread;
};

/// Reads the emission and its textures on a regular grid, fine enough for their texels but of at
/// most `max_samples` a side. What the grid may have missed keeps a small share, so that no point
/// that emits has a density of zero.
[[nodiscard]] TriangleEmission measure_emission(const PlacedMesh& mesh, const Material& material,
                                                std::uint32_t triangle, int max_samples);

}  // namespace bdpt
