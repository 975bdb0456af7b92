#include "material/gltf_bsdf.h"

#include "material/gltf_bsdf_setup.h"
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

template <typename Features>
bool BasicGltfBsdf<Features>::is_rough() const noexcept
{
    if constexpr (rich) {
        return alpha_.x >= smooth_alpha;
    } else {
        return alpha_ >= smooth_alpha;
    }
}

template <typename Features>
float BasicGltfBsdf<Features>::boundary_reflected(SpecularAlbedo::Split split) const noexcept
{
    const float bare = max_component(f0_) * split.f0 + f90_ * split.f90;
    if constexpr (rich) {
        const float filmed = rich_.film_f0 * split.f0 + split.f90;
        return glm::mix(bare, std::max(bare, filmed), rich_.film.factor);
    } else {
        return bare;
    }
}

/// Of a surface with grooves: that of an even one which is as rough as it is along or across them,
/// whichever reflects more. Under a film: its greatest reflectance, by the course of Fresnel's
/// equations or its own.
template <typename Features>
float BasicGltfBsdf<Features>::directional_reflected(float cosine) const noexcept
{
    float reflected = boundary_reflected(albedo_->directional(cosine, roughness_));
    if constexpr (rich) {
        if (alpha_.x != alpha_.y) {
            const auto along = albedo_->directional(cosine, rich_.roughness_x);
            reflected = std::max(reflected, boundary_reflected(along));
        }
        if (rich_.film.factor > 0.0f) {
            const float filmed = rich_.film.greatest(cosine, f0_);
            reflected += rich_.film.factor * std::max(0.0f, filmed - reflected);
        }
    }
    return reflected;
}

template <typename Features>
float BasicGltfBsdf<Features>::average_reflected() const noexcept
{
    const float reflected = boundary_reflected(albedo_->average(roughness_));
    if constexpr (rich) {
        return std::max(reflected, boundary_reflected(albedo_->average(rich_.roughness_x)));
    } else {
        return reflected;
    }
}

template <typename Features>
typename BasicGltfBsdf<Features>::Side BasicGltfBsdf<Features>::side(float z) const noexcept
{
    if (diffuse_weight_ == 0.0f || inside(z)) {
        return {has_specular_ ? 1.0f : 0.0f, 0.0f};
    }
    if (!has_specular_) {
        return {0.0f, 1.0f};
    }
    const float reflected = directional_reflected(std::abs(z));
    const float rest = std::max(0.0f, 1.0f - reflected);
    const float specular =
        (1.0f - metallic_) * reflected + transmission_weight_ * rest + metal_weight_;
    const float diffuse = diffuse_weight_ * rest;
    const float sum = specular + diffuse;
    return {sum > 0.0f ? specular / sum : 0.0f, rest};
}

/// The cosine at a microfacet on the side of the lower index, from that on the side of `z`.
template <typename Features>
float BasicGltfBsdf<Features>::cos_outer_of(float cos_microfacet, float z) const noexcept
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
template <typename Features>
typename BasicGltfBsdf<Features>::Shares BasicGltfBsdf<Features>::shares(
    float cos_outer) const noexcept
{
    const float dielectric = 1.0f - metallic_;
    Rgb reflectance{1.0f};
    Rgb reflected{dielectric};
    if (cos_outer != total_reflection) {
        reflectance = f0_ + (f90_ - f0_) * albedo_->fresnel_course(cos_outer);
        if constexpr (rich) {
            reflectance = under_film(reflectance, f0_, cos_outer);
        }
        reflected = dielectric * reflectance;
    }
    if (metallic_ > 0.0f) {
        Rgb metal = base_color_ + (1.0f - base_color_) * schlick_weight(cos_outer);
        if constexpr (rich) {
            metal = under_film(metal, base_color_, std::max(cos_outer, 0.0f));
        }
        reflected += metallic_ * metal;
    }
    if (transmission_ == 0.0f) {
        return {reflected, Rgb{0.0f}, 1.0f};
    }
    const Rgb transmitted = transmission_ * base_color_ * (1.0f - reflectance);
    const float reflected_max = max_component(reflected);
    const float sum = reflected_max + max_component(transmitted);
    return {reflected, transmitted, sum > 0.0f ? reflected_max / sum : 1.0f};
}

template <typename Features>
BsdfEval BasicGltfBsdf<Features>::eval_microfacets(Vec3 wo, Vec3 wi,
                                                   TransportMode mode) const noexcept
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

template <typename Features>
BsdfEval BasicGltfBsdf<Features>::eval(const Side& from, Vec3 wo, Vec3 wi,
                                       TransportMode mode) const noexcept
{
    return grazes(wo) || grazes(wi) ? BsdfEval{} : eval_lobes(from, wo, wi, mode);
}

template <typename Features>
BsdfEval BasicGltfBsdf<Features>::eval_lobes(const Side& from, Vec3 wo, Vec3 wi,
                                             TransportMode mode) const noexcept
{
    const bool same_side = (wo.z > 0.0f) == (wi.z > 0.0f);
    const bool reaches_base = same_side && diffuse_weight_ > 0.0f;
    const float cos_o = std::abs(wo.z);
    const float cos_i = std::abs(wi.z);
    if (!rich && !has_specular_) {
        return reaches_base ? BsdfEval{diffuse_ * cos_i, cosine_hemisphere_pdf(cos_i),
                                       cosine_hemisphere_pdf(cos_o)}
                            : BsdfEval{};
    }
    BsdfEval sum;
    const Side to = side(wi.z);
    if (has_specular_ && is_rough()) {
        sum = eval_microfacets(wo, wi, mode);
        sum.pdf_fwd.value *= from.specular_choice;
        sum.pdf_rev.value *= to.specular_choice;
    }
    if (reaches_base) {
        float choice = 1.0f;
        if constexpr (rich) {
            choice = 1.0f - rich_.transmitted_choice;
        }
        sum.f_cos += diffuse_ * (from.base_transmitted * to.base_transmitted * cos_i);
        sum.pdf_fwd.value +=
            choice * (1.0f - from.specular_choice) * cosine_hemisphere_pdf(cos_i).value;
        sum.pdf_rev.value +=
            choice * (1.0f - to.specular_choice) * cosine_hemisphere_pdf(cos_o).value;
    }
    if constexpr (rich) {
        if (!same_side && rich_.transmitted_choice > 0.0f) {
            add_transmitted(sum, from, to, cos_o, cos_i);
        }
    }
    return sum;
}

template <typename Features>
std::optional<Vec3> BasicGltfBsdf<Features>::sample_microfacets(Vec3 wo, float u_share,
                                                                Vec2 u) const noexcept
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

template <typename Features>
std::optional<BsdfSample> BasicGltfBsdf<Features>::sample_smooth(Vec3 wo, float u_share,
                                                                 float specular_choice,
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

template <typename Features>
std::optional<BsdfSample> BasicGltfBsdf<Features>::sample(const Side& from, Vec3 wo, float u_lobe,
                                                          Vec2 u, TransportMode mode) const noexcept
{
    if (grazes(wo)) {
        return std::nullopt;
    }
    const float specular_choice = from.specular_choice;
    std::optional<Vec3> wi;
    if (u_lobe < specular_choice) {
        const float u_share = u_lobe / specular_choice;
        if (!is_rough()) {
            return sample_smooth(wo, u_share, specular_choice, mode);
        }
        wi = sample_microfacets(wo, u_share, u);
    } else {
        const Vec3 above = square_to_cosine_hemisphere(u);
        bool upwards = wo.z > 0.0f;
        if constexpr (rich) {
            const float u_side = (u_lobe - specular_choice) / (1.0f - specular_choice);
            upwards = upwards != (u_side < rich_.transmitted_choice);
        }
        wi = upwards ? above : mirrored(above);
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

template <typename Features>
Rgb BasicGltfBsdf<Features>::under_film(Rgb bare, [[maybe_unused]] Rgb f0,
                                        [[maybe_unused]] float cosine) const noexcept
{
    if constexpr (rich) {
        const float factor = rich_.film.factor;
        return factor == 0.0f ? bare : bare + factor * (rich_.film.reflectance(cosine, f0) - bare);
    } else {
        return bare;
    }
}

template <typename Features>
void BasicGltfBsdf<Features>::add_transmitted([[maybe_unused]] BsdfEval& sum,
                                              [[maybe_unused]] const Side& from,
                                              [[maybe_unused]] const Side& to,
                                              [[maybe_unused]] float cos_o,
                                              [[maybe_unused]] float cos_i) const noexcept
{
    if constexpr (rich) {
        const float choice = rich_.transmitted_choice;
        sum.f_cos +=
            rich_.diffuse_transmitted * (from.base_transmitted * to.base_transmitted * cos_i);
        sum.pdf_fwd.value +=
            choice * (1.0f - from.specular_choice) * cosine_hemisphere_pdf(cos_i).value;
        sum.pdf_rev.value +=
            choice * (1.0f - to.specular_choice) * cosine_hemisphere_pdf(cos_o).value;
    }
}

template class BasicGltfBsdf<PlainFeatures>;
template class BasicGltfBsdf<RichFeatures>;

}  // namespace bdpt
