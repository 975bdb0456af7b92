#include "material/models/henyey_greenstein.h"

#include "math/elementary.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt {

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
