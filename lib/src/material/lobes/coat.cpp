#include "material/lobes/coat.h"

#include "material/lobes/fresnel.h"
#include "material/lobes/ggx.h"
#include "material/lobes/roughness.h"
#include "material/mapped_bsdf.h"
#include "math/elementary.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace bdpt {

EvenCoat::EvenCoat(float weight, float roughness, const SpecularAlbedo* albedo, float anisotropy)
    : weight_(albedo != nullptr ? weight : 0.0f),
      alpha_(AnisotropicRoughness(roughness, anisotropy).alpha()),
      row_(SpecularAlbedo::at_roughness(
          anisotropy > 0.0f ? std::sqrt(std::sqrt(0.5f * dot(alpha_, alpha_))) : roughness)),
      albedo_(albedo)
{}

bool EvenCoat::is_delta() const noexcept
{
    return !(alpha_.x >= smooth_alpha);
}

float EvenCoat::reflected(Vec3 w) const noexcept
{
    SpecularAlbedo::Roughness row = row_;
    if (alpha_.x != alpha_.y) {
        const Vec2 along = alpha_ * Vec2(w);
        const float alpha2 = dot(along, along) + 0.5f * w.z * w.z * dot(alpha_, alpha_);
        row = SpecularAlbedo::at_roughness(std::sqrt(std::sqrt(alpha2)));
    }
    const SpecularAlbedo::Split split = albedo_->directional(std::clamp(w.z, 0.0f, 1.0f), row);
    return weight_ * std::min(1.0f, albedo_->normal_reflectance() * split.f0 + split.f90);
}

float EvenCoat::average() const noexcept
{
    const SpecularAlbedo::Split average = albedo_->average(row_);
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

/// Returns a frame whose x axis is along `along`, as far as that is perpendicular to the normal.
[[nodiscard]] static Frame frame_along(Vec3 normal, Vec3 along)
{
    const Vec3 level = along - dot(along, normal) * normal;
    const float length2 = dot(level, level);
    if (!(length2 > 1e-12f)) {
        return Frame::from_normal(normal);
    }
    const Vec3 x = level / std::sqrt(length2);
    return {x, cross(normal, x), normal};
}

Coat::Coat(float weight, float roughness, Vec3 normal, const SpecularAlbedo* albedo,
           const CoatLook& look)
    : frame_(look.anisotropy > 0.0f ? frame_along(normal, look.along) : Frame::from_normal(normal)),
      even_(weight, roughness, albedo, look.anisotropy),
      facet_(frame_.to_local({0.0f, 0.0f, 1.0f})),
      tilted_(normal != Vec3{0.0f, 0.0f, 1.0f}),
      filters_(even_.exists() && (look.color != Rgb(1.0f) || look.darkening > 0.0f)),
      darkening_(look.darkening)
{
    constexpr float darkest = 1e-6f;
    if (filters_) {
        for (int c = 0; c < 3; ++c) {
            log_color_[c] = log_exact(std::max(look.color[c], darkest));
        }
    }
}

void Coat::set_base(const CoveredBase& base) noexcept
{
    if (!filters_) {
        return;
    }
    // Diffuse light is reflected inside as by the average of Fresnel's equations from the denser
    // side, light of a mirror as it was on its way in.
    const SpecularAlbedo& albedo = even_.albedo();
    const SpecularAlbedo::Split smooth = albedo.average({});
    const float r0 = albedo.normal_reflectance();
    const float outside = r0 * smooth.f0 + smooth.f90;
    const float diffuse = 1.0f - (1.0f - outside) / (albedo.ior() * albedo.ior());
    const float roughness = base.roughness.value();
    const float spread =
        base.diffuse > 0.0f ? 1.0f + base.metallic * (roughness - 1.0f) : roughness;
    const float inside = r0 + spread * (diffuse - r0);
    const Rgb left = (1.0f - inside) / (1.0f - inside * glm::clamp(base.color, 0.0f, 1.0f));
    darkened_ = Rgb(1.0f) + darkening_ * (left - 1.0f);
}

float Coat::path(Vec3 w) const noexcept
{
    constexpr float longest = 1e3f;  // at grazing incidence on a coat of index 1
    const float ior = even_.albedo().ior();
    const float cosine = std::clamp(frame_.to_local(w).z, 0.0f, 1.0f);
    const float cos2 = 1.0f - (1.0f - cosine * cosine) / (ior * ior);
    return std::min(longest, 0.5f / std::sqrt(std::max(cos2, 1e-12f)));
}

Rgb Coat::filter(float paths, bool twice) const noexcept
{
    const Rgb passed{exp_exact(log_color_.r * paths), exp_exact(log_color_.g * paths),
                     exp_exact(log_color_.b * paths)};
    return Rgb(1.0f) + even_.weight() * (passed * (twice ? darkened_ : Rgb(1.0f)) - Rgb(1.0f));
}

Rgb Coat::color_over(Rgb base) const noexcept
{
    const float reflected = even_.average();
    Rgb below = (1.0f - reflected) * base;
    if (filters_) {
        // The cosine-weighted average of `path`, down and up again.
        const float ior2 = even_.albedo().ior() * even_.albedo().ior();
        below *= filter(2.0f * ior2 * (1.0f - std::sqrt(1.0f - 1.0f / ior2)), true);
    }
    return Rgb(reflected) + below;
}

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
    const auto [reflected, thinned] = above.at_boundary(
        cosine, even_.weight() * even_.albedo().normal_reflectance(), even_.weight(),
        even_.albedo().average({}).f90, even_.row(), 1.0f - even_.average());
    return reflected + passed * std::min(1.0f, thinned) * lost;
}

float Coat::reflected(Vec3 w) const noexcept
{
    if (!even_.exists()) {
        return 0.0f;
    }
    const Vec3 local = frame_.to_local(w);
    if (!tilted_) {
        return even_.reflected(local);
    }
    const float mirrored = facet_.mirrored_share(local);
    const float direct = mirrored < 1.0f ? (1.0f - mirrored) * even_.reflected(local) : 0.0f;
    return mirrored > 0.0f ? direct + mirrored * even_.reflected(facet_.mirrored(local)) : direct;
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
