#include "material/models/henyey_greenstein.h"

#include "math/elementary.h"

#include <algorithm>
#include <cmath>

namespace bdpt {

float HenyeyGreenstein::phase(float cosine) const noexcept
{
    const float g = anisotropy_;
    // >= (1 - |g|)^2 but for rounding.
    const float d =
        std::max(1.0f + g * g + 2.0f * g * cosine, (1.0f - std::abs(g)) * (1.0f - std::abs(g)));
    return 0.25f * inv_pi * (1.0f - g * g) / (d * std::sqrt(d));
}

BsdfEval HenyeyGreenstein::eval(Vec3 wo, Vec3 wi, TransportMode /*mode*/) const noexcept
{
    const float density = phase(wo.x * wi.x + wo.y * wi.y + wo.z * wi.z);
    return {.f_cos = scattering_ * density, .pdf_fwd = {density}, .pdf_rev = {density}};
}

std::optional<BsdfSample> HenyeyGreenstein::sample(Vec3 /*wo*/, float /*u_lobe*/, Vec2 u,
                                                   TransportMode /*mode*/) const noexcept
{
    const float g = anisotropy_;
    float along = 1.0f - 2.0f * u.x;  // the cosine to where the light was going
    if (std::abs(g) > 1e-3f) {
        const float q = (1.0f - g * g) / (1.0f + g - 2.0f * g * u.x);
        along = std::clamp((1.0f + g * g - q * q) / (2.0f * g), -1.0f, 1.0f);
    }
    const float sine = std::sqrt(std::max(0.0f, 1.0f - along * along));
    const auto [s, c] = sin_cos(2.0f * pi * u.y);
    const float density = phase(-along);
    return BsdfSample{.wi = {sine * c, sine * s, -along},
                      .weight = scattering_,
                      .pdf_fwd = {density},
                      .pdf_rev = {density}};
}

}  // namespace bdpt
