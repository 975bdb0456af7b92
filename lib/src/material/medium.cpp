#include "material/medium.h"

#include "math/elementary.h"

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

/// Returns the coefficient for which the attenuation colour remains after the attenuation distance.
[[nodiscard]] Rgb compute_extinction(const MaterialDesc& desc)
{
    constexpr float min_color = 1e-20f;      // keeps the coefficient of black finite
    constexpr float max_extinction = 1e30f;  // [1/m]
    if (!has_inside(desc) || std::isinf(desc.attenuation_distance)) {
        return Rgb{0.0f};
    }
    Rgb extinction{0.0f};
    for (int channel = 0; channel < 3; ++channel) {
        const float color = std::clamp(desc.attenuation_color[channel], min_color, 1.0f);
        const float depth = std::max(0.0f, -log_exact(color));
        extinction[channel] =
            depth == 0.0f ? 0.0f : std::min(depth / desc.attenuation_distance, max_extinction);
    }
    return extinction;
}

}  // namespace

float Medium::mean_scatterings(float mean_chord) const
{
    constexpr float most = 30.0f;
    float sum = 0.0f;
    for (int channel = 0; channel < 3; ++channel) {
        const float absorption = extinction[channel] - scattering[channel];
        const float turning = (1.0f - anisotropy) * scattering[channel];
        const float until_absorbed = absorption > 0.0f ? 1.0f + turning / absorption : most;
        // Walks that enter spend the mean chord inside, however often they scatter.
        const float until_outside = 1.0f + turning * mean_chord;
        sum += std::min({most, until_absorbed, until_outside});
    }
    return sum / 3.0f;
}

bool has_inside(const MaterialDesc& desc)
{
    return desc.thickness > 0.0f && !desc.unlit &&
           (desc.transmission > 0.0f || desc.diffuse_transmission.factor > 0.0f);
}

Rgb single_scatter_albedo(Rgb multiscatter_color, float anisotropy)
{
    Rgb result{0.0f};
    for (int channel = 0; channel < 3; ++channel) {
        const float c = multiscatter_color[channel];
        const float root = std::sqrt(9.59217f + 41.6808f * c + 17.7126f * c * c);
        const float s = 4.09712f + 4.20863f * c - root;
        // The fit has an error of 1e-6 at both ends.
        const float albedo = std::clamp(1.0f - s * s, 0.0f, 1.0f) / (1.0f - anisotropy * s * s);
        result[channel] = c == 0.0f ? 0.0f : std::min(albedo, 1.0f);
    }
    return result;
}

Medium medium_within(const MaterialDesc& desc)
{
    const Rgb extinction = compute_extinction(desc);
    return {.extinction = extinction,
            .scattering = extinction * single_scatter_albedo(desc.volume_scatter.color,
                                                             desc.volume_scatter.anisotropy),
            .anisotropy = desc.volume_scatter.anisotropy};
}

Medium make_medium(const MediumDesc& desc)
{
    return {.extinction = desc.extinction,
            .scattering = desc.extinction * desc.albedo,
            .anisotropy = desc.anisotropy};
}

}  // namespace bdpt
