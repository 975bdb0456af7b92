#pragma once

#include <bdpt/types.h>

namespace bdpt {

/// A thin film on a surface, whose reflectance is coloured by interference [Belcour and Barla 2017,
/// "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", in the
/// form of KHR_materials_iridescence].
struct ThinFilm {
    float factor = 0.0f;     ///< [0, 1]; 0: no film
    float ior = 1.3f;        ///< >= 1
    float thickness = 0.0f;  ///< [nm]

    /// Of film and surface together, in [0, 1], from the cosine outside. `f0` is the reflectance of
    /// the bare surface at normal incidence.
    [[nodiscard]] Rgb reflectance(float cosine, Rgb f0) const noexcept;
    /// No channel of `reflectance` is greater at this cosine, whatever the thickness; in [0, 1].
    [[nodiscard]] float greatest(float cosine, Rgb f0) const noexcept;
};

}  // namespace bdpt
