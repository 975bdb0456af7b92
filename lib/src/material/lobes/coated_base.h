#pragma once

#include "material/specular_albedo.h"

#include <bdpt/types.h>

namespace bdpt {

/// What lies below a coat, as far as the coat needs to know.
struct CoatedBase {
    float metallic = 0.0f;
    // Reflectance of the dielectric part at normal and at grazing incidence.
    float f0 = 0.0f;
    float f90 = 0.0f;
    /// Share of light for which there is a Lambertian base, over the average of what the boundary
    /// lets through.
    float diffuse = 0.0f;
    /// The average of what white microfacets do not reflect at once.
    float unreflected = 0.0f;
    SpecularAlbedo::Roughness roughness{};
    /// The average course of Fresnel's equations from F0 to F90.
    float fresnel_rise = 0.0f;
    Rgb color{0.0f};  ///< roughly its albedo
};

}  // namespace bdpt
