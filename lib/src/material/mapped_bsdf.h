#pragma once

#include "material/bsdf_model.h"
#include "material/tilted_facet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace bdpt {

/// A scattering model or a lobe on the facet of a normal map. `Model` has `eval` and `sample`; its
/// directions, and those here, are local to the facet.
///
/// Visibility is modelled in physical roles, eye and light, so that walks from both ends agree: the
/// eye sees the facet directly, or by way of the upright facet; light that would come through the
/// surface comes from `TiltedFacet::raised` instead, and is tinted by the surface, which has
/// scattered it before. So no energy is created, and a white surface loses none: in uniform light
/// it looks the same at any tilt. If facet and surface have the same normal this is the model
/// itself.
///
/// f_cos has the cosine to the macroscopic normal in place of that to the facet.
template <typename Model>
class MappedBsdf {
public:
    /// `color`, in [0, 1], is that of the surface. The model must outlive this.
    MappedBsdf(const TiltedFacet& facet, const Model& model, Rgb color) noexcept
        : facet_(facet), model_(model), color_(color)
    {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    /// `u_lobe` and `u` are uniform in [0, 1).
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
    {
        if (facet_.height(wo) == 0.0f) {
            return std::nullopt;
        }
        return mode == TransportMode::radiance ? sample_light(wo, u_lobe, u)
                                               : sample_eye(wo, u_lobe, u);
    }

private:
    /// One of two ways to or from the facet.
    struct Way {
        Vec3 w{0.0f};  ///< direction at the facet
        float share =
            0.0f;  ///< for the eye: fraction of its view; for light: the solid angle at the facet
        float choice = 0.0f;  ///< probability for samples whose walk comes from the light
    };
    /// Returns the direct way first; a share of 0 means that there is no such way.
    using Ways = std::array<Way, 2>;

    [[nodiscard]] Ways eye_ways(Vec3 eye) const noexcept;
    [[nodiscard]] Ways light_ways(Vec3 light) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample_light(Vec3 eye, float u_lobe,
                                                         Vec2 u) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample_eye(Vec3 light, float u_lobe,
                                                       Vec2 u) const noexcept;

    TiltedFacet facet_;
    const Model& model_;
    Rgb color_;
};

/// Result of a random decision with probability `p`, and the remaining random number, again
/// uniform.
struct Choice {
    bool taken;
    float u;  ///< [0, 1)
};
[[nodiscard]] inline Choice choose(float u, float p)
{
    constexpr float below_one = 1.0f - 0x1p-24f;
    return u < p ? Choice{true, std::min(u / p, below_one)}
                 : Choice{false, std::min((u - p) / (1.0f - p), below_one)};
}

template <typename Model>
typename MappedBsdf<Model>::Ways MappedBsdf<Model>::eye_ways(Vec3 eye) const noexcept
{
    const float share = facet_.mirrored_share(eye);
    const Vec3 other = facet_.mirrored(eye);
    const float choice = facet_.mirror_choice();
    // A sample could stand for two directions at the facet, of which only one may be visible.
    const float plain_choice = facet_.mirrored_share(other) > 0.0f ? 1.0f - choice : 1.0f;
    return {Way{eye, 1.0f - share, share < 1.0f ? plain_choice : 0.0f},
            Way{other, share, share > 0.0f ? choice : 0.0f}};
}

template <typename Model>
typename MappedBsdf<Model>::Ways MappedBsdf<Model>::light_ways(Vec3 light) const noexcept
{
    Ways ways{};
    const float side = facet_.height(light) > 0.0f ? 1.0f : -1.0f;
    if (side * light.z > 0.0f) {
        ways[0] = {light, 1.0f, std::abs(light.z)};
    }
    const Vec3 lowered = facet_.lowered(light);
    if (side * lowered.z > 0.0f) {
        const float share = facet_.lowering(light);
        ways[1] = {lowered, share, share * std::abs(lowered.z)};
    }
    const float sum = ways[0].choice + ways[1].choice;
    if (sum > 0.0f) {
        ways[0].choice /= sum;
        ways[1].choice /= sum;
    }
    return ways;
}

template <typename Model>
BsdfEval MappedBsdf<Model>::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    const bool from_eye = mode == TransportMode::radiance;
    const Vec3 eye = from_eye ? wo : wi;
    const Vec3 light = from_eye ? wi : wo;
    if (facet_.height(eye) == 0.0f || facet_.height(light) == 0.0f) {
        return {};
    }
    Rgb f_cos(0.0f);
    SolidAnglePdf of_light;
    SolidAnglePdf of_eye;
    const Ways eyes = eye_ways(eye);
    const Ways lights = light_ways(light);
    for (const Way& from : eyes) {
        for (const Way& to : lights) {
            if (from.share == 0.0f || to.share == 0.0f) {
                continue;
            }
            const BsdfEval at_facet = model_.eval(from.w, to.w, TransportMode::radiance);
            const float share = from.share * to.share;
            f_cos += share * (&to == &lights[1] ? color_ : Rgb(1.0f)) * at_facet.f_cos;
            of_light.value += share * at_facet.pdf_fwd.value;
            of_eye.value += from.choice * to.choice * at_facet.pdf_rev.value;
        }
    }
    if (from_eye) {
        return {f_cos, of_light, of_eye};
    }
    return {f_cos * std::abs(facet_.height(eye) / facet_.height(light)), of_eye, of_light};
}

// Densities of delta lobes omit a Dirac factor, so only their ratio matters: that of the
// probabilities times the solid angle of light over that of the eye; `share` is its ratio to that
// at the facet.

template <typename Model>
std::optional<BsdfSample> MappedBsdf<Model>::sample_light(Vec3 eye, float u_lobe,
                                                          Vec2 u) const noexcept
{
    const Choice mirror = choose(u_lobe, facet_.mirrored_share(eye));
    const Vec3 from = mirror.taken ? facet_.mirrored(eye) : eye;
    std::optional<BsdfSample> sampled = model_.sample(from, mirror.u, u, TransportMode::radiance);
    if (!sampled) {
        return std::nullopt;
    }
    const bool is_raised = !facet_.faces(sampled->wi);
    const Vec3 light = is_raised ? facet_.raised(sampled->wi) : sampled->wi;
    if (facet_.height(light) == 0.0f) {
        return std::nullopt;
    }
    if (!sampled->delta) {
        return smooth_sample(light, eval(eye, light, TransportMode::radiance));
    }
    const Way from_eye = eye_ways(eye)[mirror.taken ? 1 : 0];
    const Way to_light = light_ways(light)[is_raised ? 1 : 0];
    sampled->wi = light;
    sampled->weight *= is_raised ? color_ : Rgb(1.0f);
    sampled->pdf_fwd.value *= from_eye.share * to_light.share;
    sampled->pdf_rev.value *= from_eye.choice * to_light.choice;
    return sampled;
}

template <typename Model>
std::optional<BsdfSample> MappedBsdf<Model>::sample_eye(Vec3 light, float u_lobe,
                                                        Vec2 u) const noexcept
{
    const Ways lights = light_ways(light);
    if (lights[0].share + lights[1].share == 0.0f) {
        return std::nullopt;  // behind the facet
    }
    const Choice lower = choose(u_lobe, lights[1].choice);
    const Way& from = lights[lower.taken ? 1 : 0];
    const Choice mirror = choose(lower.u, facet_.mirror_choice());
    std::optional<BsdfSample> sampled =
        model_.sample(from.w, mirror.u, u, TransportMode::importance);
    if (!sampled || !facet_.faces(sampled->wi)) {
        return std::nullopt;  // no eye direction sees the facet
    }
    const Vec3 other = facet_.mirrored(sampled->wi);
    const bool is_mirrored = mirror.taken && facet_.mirrored_share(other) > 0.0f;
    const Vec3 eye = is_mirrored ? other : sampled->wi;
    if (!sampled->delta) {
        return smooth_sample(eye, eval(light, eye, TransportMode::importance));
    }
    const Way way = eye_ways(eye)[is_mirrored ? 1 : 0];
    const float cosines = facet_.height(eye) * from.w.z / (facet_.height(light) * way.w.z);
    sampled->weight *= way.share * from.share / (way.choice * from.choice) * std::abs(cosines);
    sampled->weight *= lower.taken ? color_ : Rgb(1.0f);
    sampled->wi = eye;
    sampled->pdf_fwd.value *= from.choice * way.choice;
    sampled->pdf_rev.value *= from.share * way.share;
    return sampled;
}

}  // namespace bdpt
