#include "material/medium.h"

#include "math/elementary.h"

#include <glm/geometric.hpp>

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

float HenyeyGreenstein::phase(float from_peak) const noexcept
{
    const float g = std::abs(anisotropy_);
    const float d = (1.0f - g) * (1.0f - g) + 2.0f * g * from_peak;
    return 0.25f * inv_pi * (1.0f - g * g) / (d * std::sqrt(d));
}

BsdfEval HenyeyGreenstein::eval(Vec3 wo, Vec3 wi, TransportMode /*mode*/) const noexcept
{
    // The peak is at -wo, or at wo. One minus the cosine to it would lose all digits.
    const Vec3 offset = anisotropy_ < 0.0f ? wi - wo : wi + wo;
    const float density = phase(0.5f * dot(offset, offset));
    return {.f_cos = scattering_ * density, .pdf_fwd = {density}, .pdf_rev = {density}};
}

std::optional<BsdfSample> HenyeyGreenstein::sample(Vec3 /*wo*/, float /*u_lobe*/, Vec2 u,
                                                   TransportMode /*mode*/) const noexcept
{
    const float g = std::abs(anisotropy_);
    const float divisor = 1.0f + g - 2.0f * g * u.x;
    const float q = (1.0f - g * g) / divisor;
    // Inverts the distribution, expressed as one minus the cosine to the peak.
    const float from_peak = std::min((1.0f - g) * u.x * (q + 1.0f - g) / divisor, 2.0f);
    const float sine = std::sqrt(from_peak * (2.0f - from_peak));
    const float z = anisotropy_ < 0.0f ? 1.0f - from_peak : from_peak - 1.0f;
    const auto [s, c] = sin_cos(2.0f * pi * u.y);
    const float density = phase(from_peak);
    return BsdfSample{.wi = {sine * c, sine * s, z},
                      .weight = scattering_,
                      .pdf_fwd = {density},
                      .pdf_rev = {density}};
}

}  // namespace bdpt
