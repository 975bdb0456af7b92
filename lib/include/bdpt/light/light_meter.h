#pragma once

/// @file
/// Measures the light that falls on what a camera sees, to choose the exposure.
///
/// @code{.cpp}
/// void write_exposed(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     const bdpt::Image image = bdpt::render(scene, camera, {}).image();
///     const double level = bdpt::light_level(bdpt::white_cards(scene, camera));
///     const float exposure = bdpt::light_exposure(level).value_or(0.0f);
///     bdpt::io::write_png("exposed.png", bdpt::io::tone_map(image, exposure), {});
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <optional>
#include <span>
#include <vector>

namespace bdpt {

// To render white objects white and black objects black, photographers measure incident light
// rather than reflected light. So does this meter: it places white cards on the visible surfaces.

/// Options of the light meter.
struct LightMeterOptions {
    float aspect = 1.0f;  ///< aspect ratio of the view: width over height, above 0
    /// Paths of each card, in [1, 1024]: noise falls with the root of the number.
    int paths = 32;
    int threads = 0;  ///< as `SystemOptions::threads`; does not affect the result
};

/// Returns the luminance [nit] of white diffuse cards on the surfaces that the camera sees, a few
/// thousand at most, evenly distributed over the view: E / pi, where the irradiance E includes
/// direct light and light from all other surfaces. Each value is a noisy estimate from few paths.
/// Empty if the camera sees no surface. Deterministic. Throws `Error` like render(), and (usage) if
/// the number of paths is out of range.
[[nodiscard]] BDPT_EXPORT std::vector<double> white_cards(const Scene& scene,
                                                          const CameraDesc& camera,
                                                          const LightMeterOptions& options = {});

/// Returns the level of the brighter `cards` [nit]: the mean of those between the median and the
/// 95th percentile. Dark nooks do not count, nor do a few cards next to a light. 0 without cards.
[[nodiscard]] BDPT_EXPORT double light_level(std::span<const double> cards);

/// Returns the exposure [EV] that maps a card of `light_level` to 1, which tone curves map to
/// white; nullopt if there is no light.
[[nodiscard]] BDPT_EXPORT std::optional<float> light_exposure(double light_level);

}  // namespace bdpt
