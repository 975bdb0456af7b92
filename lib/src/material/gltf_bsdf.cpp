#include "material/gltf_bsdf.h"

#include "math/elementary.h"
#include "math/rgb.h"
#include "math/warp.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace bdpt {
namespace {

static_assert(std::is_trivially_copyable_v<GltfBsdf> && sizeof(GltfBsdf) <= 96);

/// Marks light that is reflected in full where a cosine on the outer side would stand.
constexpr float total_reflection = -1.0f;

/// Rough refraction into an index this close to the outer one has no half vector.
constexpr float least_refraction = 1.001f;

[[nodiscard]] Vec3 mirrored(Vec3 w)
{
    return {w.x, w.y, -w.z};
}

/// The refraction of `wo` at a microfacet that does not reflect in full; `eta` is the index on wo's
/// side over that on the other.
[[nodiscard]] Vec3 refracted(Vec3 wo, Vec3 h, float cos_microfacet, float eta)
{
    const float scaled = eta * cos_microfacet;
    const float cos2_far = (1.0f - eta) * (1.0f + eta) + scaled * scaled;
    return normalize((scaled - std::sqrt(std::max(0.0f, cos2_far))) * h - eta * wo);
}

}  // namespace

GltfBsdf::GltfBsdf(const GltfParameters& parameters, const SpecularAlbedo& albedo)
    : base_color_(clamp(parameters.base_color, 0.0f, 1.0f)),
      f90_(std::clamp(parameters.specular, 0.0f, 1.0f)),
      metallic_(std::clamp(parameters.metallic, 0.0f, 1.0f)),
      ior_(albedo.ior()),
      roughness_(SpecularAlbedo::at_roughness(parameters.roughness)),
      solid_(parameters.body == Body::solid),
      albedo_(&albedo)
{
    const float dielectric = 1.0f - metallic_;
    const float transmission = std::clamp(parameters.transmission, 0.0f, 1.0f);
    const float base_max = max_component(base_color_);
    transmission_ = dielectric * transmission;
    f0_ = clamp(albedo.normal_reflectance() * parameters.specular_color, 0.0f, 1.0f) * f90_;
    const float roughness = std::clamp(parameters.roughness, 0.0f, 1.0f);
    alpha_ = roughness * roughness;
    if (solid_ && alpha_ >= smooth_alpha && ior_ < least_refraction) {
        // Equal indices: a dielectric boundary cannot be seen, however rough; where it is mixed
        // with metal, a refraction too weak to be noticed keeps the metal's roughness.
        alpha_ = metallic_ == 0.0f ? 0.0f : alpha_;
        ior_ = metallic_ == 0.0f ? ior_ : least_refraction;
    }
    const SpecularAlbedo::Split average = albedo.average(roughness_);
    constexpr float least_loss = 1e-6f;  // a base below a perfect mirror gets no light at all
    const float reaches_base = 1.0f - (max_component(f0_) * average.f0 + f90_ * average.f90);
    const float diffuse = dielectric * (1.0f - transmission);
    diffuse_ = base_color_ * (diffuse * inv_pi / std::max(reaches_base, least_loss));
    diffuse_weight_ = diffuse * base_max;
    transmission_weight_ = transmission_ * base_max;
    // 1/21 is the cosine-weighted average of Schlick's (1 - cos)^5.
    metal_weight_ = metallic_ * (base_max + (1.0f - base_max) / 21.0f);
    has_specular_ = f90_ > 0.0f || metallic_ > 0.0f || transmission_ > 0.0f || solid_;
}

GltfBsdf::Side GltfBsdf::side(float z) const noexcept
{
    if (diffuse_weight_ == 0.0f || inside(z)) {
        return {has_specular_ ? 1.0f : 0.0f, 0.0f};
    }
    if (!has_specular_) {
        return {0.0f, 1.0f};
    }
    const SpecularAlbedo::Split split = albedo_->directional(std::abs(z), roughness_);
    const float reflected = max_component(f0_) * split.f0 + f90_ * split.f90;
    const float rest = std::max(0.0f, 1.0f - reflected);
    const float specular =
        (1.0f - metallic_) * reflected + transmission_weight_ * rest + metal_weight_;
    const float diffuse = diffuse_weight_ * rest;
    const float sum = specular + diffuse;
    return {sum > 0.0f ? specular / sum : 0.0f, rest};
}

/// The cosine at a microfacet on the side of the lower index, from that on the side of `z`.
float GltfBsdf::cos_outer_of(float cos_microfacet, float z) const noexcept
{
    if (!inside(z)) {
        return cos_microfacet;
    }
    const float scaled = ior_ * cos_microfacet;
    const float cos2 = scaled * scaled - (ior_ - 1.0f) * (ior_ + 1.0f);
    return cos2 > 0.0f ? std::sqrt(cos2) : total_reflection;
}

/// Metal follows the cosine on the outer side too, so that light sees the same microfacet whichever
/// way it comes.
GltfBsdf::Shares GltfBsdf::shares(float cos_outer) const noexcept
{
    const float dielectric = 1.0f - metallic_;
    Rgb reflectance{1.0f};
    Rgb reflected{dielectric};
    if (cos_outer != total_reflection) {
        reflectance = f0_ + (f90_ - f0_) * albedo_->fresnel_course(cos_outer);
        reflected = dielectric * reflectance;
    }
    if (metallic_ > 0.0f) {
        reflected += metallic_ * (base_color_ + (1.0f - base_color_) * schlick_weight(cos_outer));
    }
    if (transmission_ == 0.0f) {
        return {reflected, Rgb{0.0f}, 1.0f};
    }
    const Rgb transmitted = transmission_ * base_color_ * (1.0f - reflectance);
    const float reflected_max = max_component(reflected);
    const float sum = reflected_max + max_component(transmitted);
    return {reflected, transmitted, sum > 0.0f ? reflected_max / sum : 1.0f};
}

BsdfEval GltfBsdf::eval_microfacets(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    // Seen from above, on the side of wo.
    const Vec3 o{wo.x, wo.y, std::abs(wo.z)};
    const Vec3 i{wi.x, wi.y, wo.z > 0.0f ? wi.z : -wi.z};
    if (i.z > 0.0f) {
        const ggx::Lobe lobe = ggx::reflect(o, i, alpha_);
        const Shares share = shares(cos_outer_of(lobe.cos_outer, wo.z));
        return {share.reflected * lobe.f_cos, SolidAnglePdf{share.reflect_choice * lobe.pdf_fwd},
                SolidAnglePdf{share.reflect_choice * lobe.pdf_rev}};
    }
    if (transmission_ == 0.0f) {
        return {};
    }
    const float n_o = index_at(wo.z);
    const float n_i = index_at(wi.z);
    const ggx::Lobe lobe =
        solid_ ? ggx::refract(o, i, n_o, n_i, alpha_) : ggx::reflect(o, mirrored(i), alpha_);
    const Shares share = shares(lobe.cos_outer);
    const float choice = 1.0f - share.reflect_choice;
    const float compression = mode == TransportMode::radiance ? n_o * n_o / (n_i * n_i) : 1.0f;
    return {share.transmitted * (lobe.f_cos * compression), SolidAnglePdf{choice * lobe.pdf_fwd},
            SolidAnglePdf{choice * lobe.pdf_rev}};
}

BsdfEval GltfBsdf::eval(const Side& from, Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    return grazes(wo) || grazes(wi) ? BsdfEval{} : eval_lobes(from, wo, wi, mode);
}

BsdfEval GltfBsdf::eval_lobes(const Side& from, Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    BsdfEval sum;
    const Side to = side(wi.z);
    if (has_specular_ && alpha_ >= smooth_alpha) {
        sum = eval_microfacets(wo, wi, mode);
        sum.pdf_fwd.value *= from.specular_choice;
        sum.pdf_rev.value *= to.specular_choice;
    }
    const bool same_side = (wo.z > 0.0f) == (wi.z > 0.0f);
    if (same_side && diffuse_weight_ > 0.0f) {
        const float cos_o = std::abs(wo.z);
        const float cos_i = std::abs(wi.z);
        sum.f_cos += diffuse_ * (from.base_transmitted * to.base_transmitted * cos_i);
        sum.pdf_fwd.value += (1.0f - from.specular_choice) * cosine_hemisphere_pdf(cos_i).value;
        sum.pdf_rev.value += (1.0f - to.specular_choice) * cosine_hemisphere_pdf(cos_o).value;
    }
    return sum;
}

std::optional<Vec3> GltfBsdf::sample_microfacets(Vec3 wo, float u_share, Vec2 u) const noexcept
{
    const Vec3 o{wo.x, wo.y, std::abs(wo.z)};
    const Vec3 h = ggx::sample_visible_normal(o, alpha_, u);
    const float cos_microfacet = std::min(1.0f, dot(o, h));
    const float cos_outer = cos_outer_of(cos_microfacet, wo.z);
    const float reflect_choice = transmission_ == 0.0f ? 1.0f : shares(cos_outer).reflect_choice;
    const bool reflects = u_share < reflect_choice;
    Vec3 i = 2.0f * cos_microfacet * h - o;
    if (!reflects) {
        i = solid_ ? refracted(o, h, cos_microfacet, index_at(wo.z) / index_at(-wo.z))
                   : mirrored(i);
    }
    if (reflects != (i.z > 0.0f) || i.z == 0.0f) {
        return std::nullopt;  // masked: the light would have to scatter again
    }
    return wo.z > 0.0f ? i : mirrored(i);
}

std::optional<BsdfSample> GltfBsdf::sample_smooth(Vec3 wo, float u_share, float specular_choice,
                                                  TransportMode mode) const noexcept
{
    const float cos_o = std::abs(wo.z);
    const Shares share = shares(cos_outer_of(cos_o, wo.z));
    const float n_o = index_at(wo.z);
    if (u_share < share.reflect_choice) {
        const float choice = specular_choice * share.reflect_choice;
        const SolidAnglePdf pdf{choice * cos_o * n_o * n_o};
        return BsdfSample{Vec3{-wo.x, -wo.y, wo.z}, share.reflected / choice, pdf, pdf, true};
    }
    const float choice = 1.0f - share.reflect_choice;
    const float n_i = index_at(-wo.z);
    const Vec3 normal{0.0f, 0.0f, std::copysign(1.0f, wo.z)};
    const Vec3 wi = solid_ ? refracted(wo, normal, cos_o, n_o / n_i) : -wo;
    const float compression = mode == TransportMode::radiance ? n_o * n_o / (n_i * n_i) : 1.0f;
    return BsdfSample{wi, share.transmitted * (compression / (specular_choice * choice)),
                      SolidAnglePdf{specular_choice * choice * std::abs(wi.z) * n_i * n_i},
                      SolidAnglePdf{side(wi.z).specular_choice * choice * cos_o * n_o * n_o}, true};
}

std::optional<BsdfSample> GltfBsdf::sample(const Side& from, Vec3 wo, float u_lobe, Vec2 u,
                                           TransportMode mode) const noexcept
{
    if (grazes(wo)) {
        return std::nullopt;
    }
    const float specular_choice = from.specular_choice;
    std::optional<Vec3> wi;
    if (u_lobe < specular_choice) {
        const float u_share = u_lobe / specular_choice;
        if (alpha_ < smooth_alpha) {
            return sample_smooth(wo, u_share, specular_choice, mode);
        }
        wi = sample_microfacets(wo, u_share, u);
    } else {
        const Vec3 above = square_to_cosine_hemisphere(u);
        wi = wo.z > 0.0f ? above : mirrored(above);
    }
    if (!wi || grazes(*wi)) {
        return std::nullopt;
    }
    const BsdfEval value = eval_lobes(from, wo, *wi, mode);
    if (!(value.pdf_fwd.value >= std::numeric_limits<float>::min())) {
        return std::nullopt;
    }
    return BsdfSample{*wi, value.f_cos * (1.0f / value.pdf_fwd.value), value.pdf_fwd, value.pdf_rev,
                      false};
}

}  // namespace bdpt
