#pragma once

#include <bdpt/export.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <optional>
#include <span>
#include <vector>

namespace bdpt {

// A photographer who wants a white thing to come out white, and a black one black, does not measure
// the light that comes from them but the light that falls on them. So does this meter: it puts
// white cards where things stand.

/// How light is metered.
struct LightMeterOptions {
    float aspect = 1.0f;  ///< of the view: width over height, above 0
    int threads = 0;      ///< as `SystemOptions::threads`; they change nothing
};

/// The luminance [nit] that white diffuse cards would have which lie on what the camera sees, some
/// thousand at most, evenly over the view: E / pi, where the irradiance E comes from lights and by
/// way of all other surfaces as they are. Each is a noisy estimate, by few paths. None where the
/// camera sees no surface. The same for the same arguments. Throws `Error` as render() does.
[[nodiscard]] BDPT_EXPORT std::vector<double> white_cards(const Scene& scene,
                                                          const CameraDesc& camera,
                                                          const LightMeterOptions& options = {});

/// The level of the brighter `cards` [nit]: the mean of those between the median and the highest
/// twentieth. Nooks that light hardly enters do not count, nor do a few cards next to a lamp. 0
/// without cards.
[[nodiscard]] BDPT_EXPORT double light_level(std::span<const double> cards);

/// The exposure [EV] that gives a card of `light_level` the value 1, from which tone curves make
/// white; none: there is no light.
[[nodiscard]] BDPT_EXPORT std::optional<float> light_exposure(double light_level);

}  // namespace bdpt
