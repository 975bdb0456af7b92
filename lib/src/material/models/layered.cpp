#include "material/models/layered.h"

#include "material/models/layered_bsdf.h"

namespace bdpt {

BsdfEval Layered::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    return LayeredBsdf(parameters_).eval(wo, wi, mode);
}

std::optional<BsdfSample> Layered::sample(Vec3 wo, float u_lobe, Vec2 u,
                                          TransportMode mode) const noexcept
{
    return LayeredBsdf(parameters_).sample(wo, u_lobe, u, mode);
}

bool Layered::has_smooth_lobe() const noexcept
{
    return LayeredBsdf(parameters_).has_smooth_lobe();
}

}  // namespace bdpt
