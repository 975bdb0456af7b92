#include "material/bsdf.h"
#include "material/layered_bsdf.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace bdpt {

Bsdf::Bsdf(Vec3 ng, const Frame& shading, Vec3 wo, const LayeredParameters& layers) noexcept
    : shading_(shading),
      ng_(ng),
      local_wo_(shading.to_local(wo)),
      ratio_o_(-cosine_ratio(dot(wo, ng), local_wo_.z))
{
    if (ratio_o_ < 0.0f) {
        model_ = Model(layers);
    } else {
        model_ = Model(GltfBsdf(clamp(layers.base.base_color, 0.0f, 1.0f)));
    }
}

BsdfEval Bsdf::eval_layers(Vec3 wi, TransportMode mode) const noexcept
{
    const Vec3 local_wi = shading_.to_local(wi);
    const float ratio_i = cosine_ratio(dot(wi, ng_), local_wi.z);
    if (!has_layers() || ratio_i == 0.0f) {
        return {};
    }
    BsdfEval value = LayeredBsdf(model_.layers).eval(local_wo_, local_wi, mode);
    if (mode == TransportMode::importance) {
        value.f_cos *= ratio_i / -ratio_o_;
    }
    return value;
}

std::optional<BsdfSample> Bsdf::sample_layers(float u_lobe, Vec2 u,
                                              TransportMode mode) const noexcept
{
    if (!has_layers()) {
        return std::nullopt;
    }
    std::optional<BsdfSample> sampled =
        LayeredBsdf(model_.layers).sample(local_wo_, u_lobe, u, mode);
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
        sampled->weight *= ratio_i / -ratio_o_;
    }
    return sampled;
}

bool Bsdf::layers_connectible() const noexcept
{
    return LayeredBsdf(model_.layers).has_smooth_lobe();
}

Rgb Bsdf::layers_base_color() const noexcept
{
    return clamp(model_.layers.base.base_color, 0.0f, 1.0f);
}

}  // namespace bdpt
