#include "material/bsdf.h"

#include <glm/geometric.hpp>

#include <type_traits>

namespace bdpt {

static_assert(std::is_trivially_copyable_v<Bsdf>);

Bsdf::Bsdf(Vec3 ng, const Frame& shading, Vec3 wo, const GltfBsdf& model) noexcept
    : shading_(shading),
      ng_(ng),
      local_wo_(shading.to_local(wo)),
      ratio_o_(cosine_ratio(dot(wo, ng), local_wo_.z)),
      extra_(model.side(local_wo_.z)),
      model_(model)
{}

// Shading normals change importance, but not radiance, by the quotient of the ratios of both
// directions [Veach 1997, sec. 5.3]; it is exactly 1 where the normals are equal.

BsdfEval Bsdf::eval(Vec3 wi, TransportMode mode) const noexcept
{
    if (!(ratio_o_ > 0.0f)) [[unlikely]] {
        return eval_rare(wi, mode);
    }
    const Vec3 local_wi = shading_.to_local(wi);
    const float ratio_i = cosine_ratio(dot(wi, ng_), local_wi.z);
    if (ratio_i == 0.0f) {
        return {};
    }
    BsdfEval value = model_.plain.eval(extra_.from, local_wo_, local_wi, mode);
    if (mode == TransportMode::importance) {
        value.f_cos *= ratio_i / ratio_o_;
    }
    return value;
}

std::optional<BsdfSample> Bsdf::sample(float u_lobe, Vec2 u, TransportMode mode) const noexcept
{
    if (!(ratio_o_ > 0.0f)) [[unlikely]] {
        return sample_rare(u_lobe, u, mode);
    }
    std::optional<BsdfSample> sampled =
        model_.plain.sample(extra_.from, local_wo_, u_lobe, u, mode);
    if (!sampled) {
        return std::nullopt;
    }
    const float local_cos = sampled->wi.z;
    sampled->wi = shading_.to_world(sampled->wi);
    const float ratio_i = cosine_ratio(dot(sampled->wi, ng_), local_cos);
    if (ratio_i == 0.0f) {
        return std::nullopt;
    }
    if (mode == TransportMode::importance) {
        sampled->weight *= ratio_i / ratio_o_;
    }
    return sampled;
}

}  // namespace bdpt
