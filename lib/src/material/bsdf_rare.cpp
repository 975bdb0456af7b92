#include "material/bsdf.h"
#include "material/coated_facet.h"
#include "material/layered_bsdf.h"
#include "material/mapped_bsdf.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace bdpt {

Bsdf::Bsdf(Vec3 ng, const Frame& shading, Vec3 wo, const LayeredParameters& layers) noexcept
    : shading_(shading),
      ng_(ng),
      local_wo_(shading.to_local(wo)),
      ratio_o_(-cosine_ratio(dot(wo, ng), local_wo_.z)),
      extra_(Rarity{.layered = true})
{
    if (ratio_o_ < 0.0f) {
        model_ = Model(layers);
    } else {
        model_ = Model(GltfBsdf(clamp(layers.base.base_color, 0.0f, 1.0f)));
    }
}

Bsdf::Bsdf(Vec3 ng, Vec3 ns, const Frame& facet, Vec3 wo, const GltfBsdf& model) noexcept
    : shading_(facet),
      ng_(ng),
      local_wo_(facet.to_local(wo)),
      extra_(Rarity{.mapped = true, .ns = Direction16(facet.to_local(ns))}),
      model_(model)
{
    ratio_o_ = -cosine_ratio(dot(wo, ng), height(local_wo_));
}

Bsdf::Bsdf(Vec3 ng, Vec3 ns, const Frame& facet, Vec3 wo, const LayeredParameters& layers) noexcept
    : Bsdf(ng, ns, facet, wo, GltfBsdf(clamp(layers.base.base_color, 0.0f, 1.0f)))
{
    if (ratio_o_ < 0.0f) {
        extra_.rarity.layered = true;
        model_ = Model(layers);
    }
}

TiltedFacet Bsdf::facet() const noexcept
{
    return TiltedFacet(extra_.rarity.ns.value());
}

/// The cosine to the normal of the surface without its map.
float Bsdf::height(Vec3 local) const noexcept
{
    return extra_.rarity.mapped ? dot(local, extra_.rarity.ns.value()) : local.z;
}

BsdfEval Bsdf::eval_model(Vec3 local_wi, TransportMode mode) const noexcept
{
    const auto [layered, mapped, ns] = extra_.rarity;
    if (!mapped) {
        return LayeredBsdf(model_.layers).eval(local_wo_, local_wi, mode);
    }
    if (layered) {
        return CoatedFacet(facet(), model_.layers).eval(local_wo_, local_wi, mode);
    }
    return MappedBsdf(facet(), model_.plain, model_.plain.base_color())
        .eval(local_wo_, local_wi, mode);
}

std::optional<BsdfSample> Bsdf::sample_model(float u_lobe, Vec2 u,
                                             TransportMode mode) const noexcept
{
    const auto [layered, mapped, ns] = extra_.rarity;
    if (!mapped) {
        return LayeredBsdf(model_.layers).sample(local_wo_, u_lobe, u, mode);
    }
    if (layered) {
        return CoatedFacet(facet(), model_.layers).sample(local_wo_, u_lobe, u, mode);
    }
    return MappedBsdf(facet(), model_.plain, model_.plain.base_color())
        .sample(local_wo_, u_lobe, u, mode);
}

BsdfEval Bsdf::eval_rare(Vec3 wi, TransportMode mode) const noexcept
{
    if (!is_rare()) {
        return {};
    }
    const Vec3 local_wi = shading_.to_local(wi);
    const float ratio_i = cosine_ratio(dot(wi, ng_), height(local_wi));
    if (ratio_i == 0.0f) {
        return {};
    }
    BsdfEval value = eval_model(local_wi, mode);
    if (mode == TransportMode::importance) {
        value.f_cos *= ratio_i / -ratio_o_;
    }
    return value;
}

std::optional<BsdfSample> Bsdf::sample_rare(float u_lobe, Vec2 u, TransportMode mode) const noexcept
{
    if (!is_rare()) {
        return std::nullopt;
    }
    std::optional<BsdfSample> sampled = sample_model(u_lobe, u, mode);
    if (!sampled) {
        return std::nullopt;
    }
    const float local_cos = height(sampled->wi);
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
