#pragma once

#include "material/specular_albedo.h"

#include <bdpt/types.h>

namespace bdpt {

/// Properties of the base that the coat above needs.
struct CoatedBase {
    float metallic = 0.0f;
    // Reflectance of the dielectric part at normal and at grazing incidence.
    float f0 = 0.0f;
    float f90 = 0.0f;
    /// Fraction of light for which there is a Lambertian base, over the average transmission of the
    /// boundary.
    float diffuse = 0.0f;
    /// Average of the light that white microfacets do not reflect at once.
    float unreflected = 0.0f;
    SpecularAlbedo::Roughness roughness{};
    /// Average of Fresnel's equations normalised from F0 to F90.
    float fresnel_rise = 0.0f;
    Rgb color{0.0f};  ///< approximate albedo
};

}  // namespace bdpt
