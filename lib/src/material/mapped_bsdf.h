#pragma once

#include "material/bsdf_model.h"
#include "material/tilted_facet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace bdpt {

/// What a model computes of one direction alone, once for all pairs with it; empty for models
/// without such values.
template <typename Model>
struct SideOf {
    struct Type {};
    [[nodiscard]] static Type of(const Model&, Vec3) noexcept { return {}; }
    [[nodiscard]] static BsdfEval eval(const Model& model, Type, Type, Vec3 wo, Vec3 wi,
                                       TransportMode mode) noexcept
    {
        return model.eval(wo, wi, mode);
    }
    [[nodiscard]] static std::optional<BsdfSample> direct(const Model& model, Type, Vec3 wo,
                                                          float u_lobe, Vec2 u,
                                                          TransportMode mode) noexcept
    {
        return model.sample(wo, u_lobe, u, mode);
    }
};
template <typename Model>
requires requires
{
    typename Model::Side;
}
struct SideOf<Model> {
    using Type = typename Model::Side;
    [[nodiscard]] static Type of(const Model& model, Vec3 w) noexcept { return model.side(w); }
    [[nodiscard]] static BsdfEval eval(const Model& model, const Type& from, const Type& to,
                                       Vec3 wo, Vec3 wi, TransportMode mode) noexcept
    {
        return model.eval(from, to, wo, wi, mode);
    }
    [[nodiscard]] static std::optional<BsdfSample> direct(const Model& model, const Type& from,
                                                          Vec3 wo, float u_lobe, Vec2 u,
                                                          TransportMode mode) noexcept
    {
        return model.direct(from, wo, u_lobe, u, mode);
    }
};

/// A scattering model or a lobe on the facet of a normal map. `Model` has `eval` and `sample`, or
/// `side`, `eval` for sides, and `direct`; its directions, and those here, are local to the facet.
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

    /// What the model computes of the two ways from the eye to the facet.
    using Sides = std::array<typename SideOf<Model>::Type, 2>;
    [[nodiscard]] Sides eye_sides(Vec3 eye) const noexcept { return sides(eye_ways(eye)); }

    // `seen` is `eye_sides` of wo, if it is known; else null. Walks from the light do not use it.

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode,
                                const Sides* seen = nullptr) const noexcept;
    /// `u_lobe` and `u` are uniform in [0, 1).
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode,
                                                   const Sides* seen = nullptr) const noexcept
    {
        if (facet_.height(wo) == 0.0f) {
            return std::nullopt;
        }
        return mode == TransportMode::radiance ? sample_light(wo, u_lobe, u, seen)
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
    /// The direct way is first; a share of 0 means that there is no such way.
    using Ways = std::array<Way, 2>;
    using Side = SideOf<Model>;

    [[nodiscard]] Ways eye_ways(Vec3 eye) const noexcept;
    [[nodiscard]] Ways light_ways(Vec3 light) const noexcept;
    [[nodiscard]] Sides sides(const Ways& ways) const noexcept
    {
        Sides result{};
        for (std::size_t i = 0; i < ways.size(); ++i) {
            if (ways[i].share != 0.0f) {
                result[i] = Side::of(model_, ways[i].w);
            }
        }
        return result;
    }
    /// Evaluates the sum over all pairs of ways, for walks from the eye.
    [[nodiscard]] BsdfEval eval(const Ways& eyes, const Sides& eye_sides, const Ways& lights,
                                const Sides& light_sides) const noexcept;
    /// Returns it for a walk from the light.
    [[nodiscard]] BsdfEval from_light(const BsdfEval& value, Vec3 eye, Vec3 light) const noexcept
    {
        return {value.f_cos * std::abs(facet_.height(eye) / facet_.height(light)), value.pdf_rev,
                value.pdf_fwd};
    }
    [[nodiscard]] std::optional<BsdfSample> sample_light(Vec3 eye, float u_lobe, Vec2 u,
                                                         const Sides* seen) const noexcept;
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
BsdfEval MappedBsdf<Model>::eval(const Ways& eyes, const Sides& eye_sides, const Ways& lights,
                                 const Sides& light_sides) const noexcept
{
    BsdfEval sum;
    for (std::size_t e = 0; e < eyes.size(); ++e) {
        for (std::size_t l = 0; l < lights.size(); ++l) {
            const Way& from = eyes[e];
            const Way& to = lights[l];
            if (from.share == 0.0f || to.share == 0.0f || grazes(from.w) || grazes(to.w)) {
                continue;
            }
            const BsdfEval at_facet = Side::eval(model_, eye_sides[e], light_sides[l], from.w, to.w,
                                                 TransportMode::radiance);
            const float share = from.share * to.share;
            sum.f_cos += share * (l == 1 ? color_ : Rgb(1.0f)) * at_facet.f_cos;
            sum.pdf_fwd.value += share * at_facet.pdf_fwd.value;
            sum.pdf_rev.value += from.choice * to.choice * at_facet.pdf_rev.value;
        }
    }
    return sum;
}

template <typename Model>
BsdfEval MappedBsdf<Model>::eval(Vec3 wo, Vec3 wi, TransportMode mode,
                                 const Sides* seen) const noexcept
{
    const bool from_eye = mode == TransportMode::radiance;
    const Vec3 eye = from_eye ? wo : wi;
    const Vec3 light = from_eye ? wi : wo;
    if (facet_.height(eye) == 0.0f || facet_.height(light) == 0.0f) {
        return {};
    }
    const Ways eyes = eye_ways(eye);
    const Ways lights = light_ways(light);
    if (from_eye && seen != nullptr) {
        return eval(eyes, *seen, lights, sides(lights));
    }
    const BsdfEval value = eval(eyes, sides(eyes), lights, sides(lights));
    return from_eye ? value : from_light(value, eye, light);
}

// Densities of delta lobes omit a Dirac factor, so only their ratio matters: that of the
// probabilities times the solid angle of light over that of the eye; `share` is its ratio to that
// at the facet.

template <typename Model>
std::optional<BsdfSample> MappedBsdf<Model>::sample_light(Vec3 eye, float u_lobe, Vec2 u,
                                                          const Sides* seen) const noexcept
{
    const Ways eyes = eye_ways(eye);
    const Sides eye_sides = seen != nullptr ? *seen : sides(eyes);
    const Choice mirror = choose(u_lobe, eyes[1].share);
    const std::size_t taken = mirror.taken ? 1 : 0;
    const Way& from = eyes[taken];
    if (grazes(from.w)) {
        return std::nullopt;
    }
    std::optional<BsdfSample> sampled =
        Side::direct(model_, eye_sides[taken], from.w, mirror.u, u, TransportMode::radiance);
    if (!sampled) {
        return std::nullopt;
    }
    const bool is_raised = !facet_.faces(sampled->wi);
    const Vec3 light = is_raised ? facet_.raised(sampled->wi) : sampled->wi;
    if (facet_.height(light) == 0.0f) {
        return std::nullopt;
    }
    const Ways lights = light_ways(light);
    if (!sampled->delta) {
        return smooth_sample(light, eval(eyes, eye_sides, lights, sides(lights)));
    }
    const Way& to_light = lights[is_raised ? 1 : 0];
    sampled->wi = light;
    sampled->weight *= is_raised ? color_ : Rgb(1.0f);
    sampled->pdf_fwd.value *= from.share * to_light.share;
    sampled->pdf_rev.value *= from.choice * to_light.choice;
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
    const Sides light_sides = sides(lights);
    const Choice lower = choose(u_lobe, lights[1].choice);
    const std::size_t taken = lower.taken ? 1 : 0;
    const Way& from = lights[taken];
    if (grazes(from.w)) {
        return std::nullopt;
    }
    const Choice mirror = choose(lower.u, facet_.mirror_choice());
    std::optional<BsdfSample> sampled =
        Side::direct(model_, light_sides[taken], from.w, mirror.u, u, TransportMode::importance);
    if (!sampled || !facet_.faces(sampled->wi)) {
        return std::nullopt;  // no eye direction sees the facet
    }
    const Vec3 other = facet_.mirrored(sampled->wi);
    const bool is_mirrored = mirror.taken && facet_.mirrored_share(other) > 0.0f;
    const Vec3 eye = is_mirrored ? other : sampled->wi;
    const Ways eyes = eye_ways(eye);
    if (!sampled->delta) {
        if (facet_.height(eye) == 0.0f) {
            return std::nullopt;
        }
        return smooth_sample(eye,
                             from_light(eval(eyes, sides(eyes), lights, light_sides), eye, light));
    }
    const Way& way = eyes[is_mirrored ? 1 : 0];
    const float cosines = facet_.height(eye) * from.w.z / (facet_.height(light) * way.w.z);
    sampled->weight *= way.share * from.share / (way.choice * from.choice) * std::abs(cosines);
    sampled->weight *= lower.taken ? color_ : Rgb(1.0f);
    sampled->wi = eye;
    sampled->pdf_fwd.value *= from.choice * way.choice;
    sampled->pdf_rev.value *= from.share * way.share;
    return sampled;
}

}  // namespace bdpt
