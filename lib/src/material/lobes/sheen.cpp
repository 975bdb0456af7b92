#include "material/lobes/sheen.h"

#include "math/rgb.h"
#include "math/warp.h"

namespace bdpt {

Sheen::Sheen(Rgb color, float roughness, const SheenAlbedo* albedo)
    : color_(color),
      roughness_(roughness),
      weight_(albedo != nullptr ? max_component(color) : 0.0f),
      albedo_(albedo)
{}

float Sheen::reflected(float cosine) const noexcept
{
    return weight_ == 0.0f ? 0.0f : weight_ * albedo_->directional(cosine, roughness_);
}

BsdfEval Sheen::eval(Vec3 wo, Vec3 wi, TransportMode) const noexcept
{
    const SolidAnglePdf pdf = cone_pdf(1.0f);
    return {color_ * (albedo_->value(wo, wi, roughness_) * wi.z), pdf, pdf};
}

std::optional<BsdfSample> Sheen::sample(Vec3, float, Vec2 u, TransportMode) const noexcept
{
    return towards(square_to_cone(u, 1.0f));
}

}  // namespace bdpt
