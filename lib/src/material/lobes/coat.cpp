#include "material/lobes/coat.h"

#include "material/lobes/fresnel.h"
#include "material/lobes/ggx.h"
#include "material/lobes/roughness.h"
#include "material/mapped_bsdf.h"

#include <glm/geometric.hpp>

namespace bdpt {

EvenCoat::EvenCoat(float weight, float roughness, const SpecularAlbedo* albedo)
    : weight_(albedo != nullptr ? weight : 0.0f),
      alpha_(roughness * roughness),
      roughness_(SpecularAlbedo::at_roughness(roughness)),
      albedo_(albedo)
{}

bool EvenCoat::is_delta() const noexcept
{
    return !(alpha_ >= smooth_alpha);
}

float EvenCoat::reflected(float cosine) const noexcept
{
    const SpecularAlbedo::Split split =
        albedo_->directional(std::clamp(cosine, 0.0f, 1.0f), roughness_);
    return weight_ * std::min(1.0f, albedo_->normal_reflectance() * split.f0 + split.f90);
}

float EvenCoat::average() const noexcept
{
    const SpecularAlbedo::Split average = albedo_->average(roughness_);
    return weight_ * (albedo_->normal_reflectance() * average.f0 + average.f90);
}

BsdfEval EvenCoat::eval(Vec3 wo, Vec3 wi, TransportMode) const noexcept
{
    if (is_delta() || wo.z <= 0.0f || wi.z <= 0.0f) {
        return {};
    }
    const ggx::Lobe lobe = ggx::reflect(wo, wi, alpha_);
    const float f_cos = weight_ * fresnel_dielectric(lobe.cos_outer, albedo_->ior()) * lobe.f_cos;
    return {Rgb{f_cos}, SolidAnglePdf{lobe.pdf_fwd}, SolidAnglePdf{lobe.pdf_rev}};
}

std::optional<BsdfSample> EvenCoat::sample(Vec3 wo, float, Vec2 u, TransportMode) const noexcept
{
    if (wo.z <= 0.0f) {
        return std::nullopt;
    }
    if (is_delta()) {
        const float weight = weight_ * fresnel_dielectric(std::min(1.0f, wo.z), albedo_->ior());
        return BsdfSample{Vec3{-wo.x, -wo.y, wo.z}, Rgb{weight}, SolidAnglePdf{wo.z},
                          SolidAnglePdf{wo.z}, true};
    }
    const Vec3 wi = ggx::visible_microfacet(wo, alpha_, u).reflected();
    if (wi.z <= 0.0f) {
        return std::nullopt;  // masked
    }
    return towards(wi);
}

Coat::Coat(float weight, float roughness, Vec3 normal, const SpecularAlbedo* albedo)
    : frame_(Frame::from_normal(normal)),
      even_(weight, roughness, albedo),
      facet_(frame_.to_local({0.0f, 0.0f, 1.0f})),
      tilted_(normal != Vec3{0.0f, 0.0f, 1.0f})
{}

Rgb Coat::returned(Rgb base) const noexcept
{
    constexpr float less_per_sine = 1.3f;  // so that no direction reflects more than arrives
    const float again = even_.average();
    const float sine = std::sqrt(frame_.z.x * frame_.z.x + frame_.z.y * frame_.z.y);
    const float kept = tilted_ ? std::max(0.0f, 1.0f - less_per_sine * sine) : 1.0f;
    return base * base * (kept * (1.0f - again) / (Rgb(1.0f) - base * again));
}

float Coat::lost_below(const ReturnedLight& above, float cosine, float passed,
                       float lost) const noexcept
{
    const auto [reflected, thinned] =
        above.at_boundary(cosine, even_.weight() * even_.normal_reflectance(), even_.weight(),
                          even_.row(), 1.0f - even_.average());
    return reflected + passed * std::min(1.0f, thinned) * lost;
}

float Coat::reflected(Vec3 w) const noexcept
{
    if (!even_.exists()) {
        return 0.0f;
    }
    const Vec3 local = frame_.to_local(w);
    if (!tilted_) {
        return even_.reflected(local.z);
    }
    const float mirrored = facet_.mirrored_share(local);
    const float direct = mirrored < 1.0f ? (1.0f - mirrored) * even_.reflected(local.z) : 0.0f;
    return mirrored > 0.0f ? direct + mirrored * even_.reflected(facet_.mirrored(local).z) : direct;
}

BsdfEval Coat::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    const Vec3 o = frame_.to_local(wo);
    const Vec3 i = frame_.to_local(wi);
    return tilted_ ? MappedBsdf(facet_, even_, Rgb(1.0f)).eval(o, i, mode) : even_.eval(o, i, mode);
}

std::optional<BsdfSample> Coat::sample(Vec3 wo, float u_lobe, Vec2 u,
                                       TransportMode mode) const noexcept
{
    const Vec3 o = frame_.to_local(wo);
    std::optional<BsdfSample> sampled =
        tilted_ ? MappedBsdf(facet_, even_, Rgb(1.0f)).sample(o, u_lobe, u, mode)
                : even_.sample(o, u_lobe, u, mode);
    if (!sampled) {
        return std::nullopt;
    }
    sampled->wi = frame_.to_world(sampled->wi);
    return sampled->wi.z > 0.0f ? sampled : std::nullopt;
}

}  // namespace bdpt
