#include "material/coat.h"

#include "material/fresnel.h"
#include "material/ggx.h"
#include "material/gltf_bsdf.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace bdpt {

Coat::Coat(float weight, float roughness, Vec3 normal, const SpecularAlbedo* albedo)
    : frame_(Frame::from_normal(normal)),
      weight_(albedo != nullptr ? weight : 0.0f),
      alpha_(roughness * roughness),
      roughness_(SpecularAlbedo::at_roughness(roughness)),
      albedo_(albedo)
{}

bool Coat::has_smooth_lobe() const noexcept
{
    return weight_ > 0.0f && alpha_ >= GltfBsdf::smooth_alpha;
}

float Coat::reflected(Vec3 w) const noexcept
{
    if (weight_ == 0.0f) {
        return 0.0f;
    }
    const float cosine = std::clamp(dot(w, frame_.z), 0.0f, 1.0f);
    const SpecularAlbedo::Split split = albedo_->directional(cosine, roughness_);
    return weight_ * std::min(1.0f, albedo_->normal_reflectance() * split.f0 + split.f90);
}

/// `Bsdf` knows the normal of the base alone; where the coat has another one, the factor that
/// importance picks up at shading normals [Veach 1997, sec. 5.3] is made right here.
float Coat::adjoint(Vec3 wo, Vec3 wi, float cos_o, float cos_i, TransportMode mode) const noexcept
{
    return mode == TransportMode::importance ? cos_o * wi.z / (cos_i * wo.z) : 1.0f;
}

BsdfEval Coat::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    const Vec3 o = frame_.to_local(wo);
    const Vec3 i = frame_.to_local(wi);
    if (o.z <= 0.0f || i.z <= 0.0f) {
        return {};
    }
    const ggx::Lobe lobe = ggx::reflect(o, i, alpha_);
    const float f_cos = weight_ * fresnel_dielectric(lobe.cos_outer, albedo_->ior()) * lobe.f_cos *
                        adjoint(wo, wi, o.z, i.z, mode);
    return {Rgb{f_cos}, SolidAnglePdf{lobe.pdf_fwd}, SolidAnglePdf{lobe.pdf_rev}};
}

std::optional<Vec3> Coat::sample(Vec3 wo, Vec2 u) const noexcept
{
    const Vec3 o = frame_.to_local(wo);
    if (o.z <= 0.0f) {
        return std::nullopt;
    }
    const Vec3 h = ggx::sample_visible_normal(o, alpha_, u);
    const Vec3 i = 2.0f * std::min(1.0f, dot(o, h)) * h - o;
    if (i.z <= 0.0f) {
        return std::nullopt;  // masked
    }
    return frame_.to_world(i);
}

std::optional<BsdfSample> Coat::mirror(Vec3 wo, TransportMode mode) const noexcept
{
    const float cosine = std::min(1.0f, dot(wo, frame_.z));
    const Vec3 wi = 2.0f * cosine * frame_.z - wo;
    if (cosine <= 0.0f || wi.z <= 0.0f) {
        return std::nullopt;
    }
    const float weight = weight_ * fresnel_dielectric(cosine, albedo_->ior()) *
                         adjoint(wo, wi, cosine, cosine, mode);
    return BsdfSample{wi, Rgb{weight}, SolidAnglePdf{cosine}, SolidAnglePdf{cosine}, true};
}

}  // namespace bdpt
