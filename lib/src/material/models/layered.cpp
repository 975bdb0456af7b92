#include "material/models/layered.h"

#include "math/rgb.h"

#include <algorithm>

namespace bdpt {
namespace {

/// Flips a direction so that layers see their own side of the surface from above.
[[nodiscard]] Vec3 from_above(Vec3 w, bool above)
{
    return above ? w : -w;
}

[[nodiscard]] LayerBase make_base(const LayeredParameters& parameters)
{
    return {parameters, *parameters.constants->base,
            AnisotropicRoughness(parameters.roughness, parameters.anisotropy.value()),
            ThinFilm{.factor = parameters.film.value(),
                     .ior = parameters.constants->film_ior,
                     .thickness = parameters.film_thickness},
            TranslucentBase(
                parameters.diffuse_transmission.value(), parameters.transmission_color.value(),
                RoughDiffuse(parameters.diffuse_roughness.value(), parameters.coat.value()))};
}

/// Returns the approximate albedo of the base; above 0.
[[nodiscard]] float estimate_weight(const LayeredParameters& parameters)
{
    const float transmitted = parameters.diffuse_transmission.value() *
                              max_component(parameters.transmission_color.value());
    const float brightest = std::max(max_component(parameters.base_color), transmitted);
    return 0.05f + 0.95f * std::clamp(brightest, 0.0f, 1.0f);
}

/// Returns the fraction of light that passes a layer to the base and back.
[[nodiscard]] float passed(float there, float back)
{
    return std::min(there, back);
}

}  // namespace

LayeredBsdf::LayeredBsdf(const LayeredParameters& parameters)
    : base_(make_base(parameters)),
      coat_(parameters.coat.value(), parameters.coat_roughness.value(),
            parameters.coat_normal.value(), parameters.constants->tables->coat.get()),
      sheen_(parameters.sheen.value(), parameters.sheen_roughness.value(),
             parameters.constants->tables->sheen.get()),
      again_(interreflection(coat_, parameters.constants->tables->coat_loss.get())),
      base_weight_(estimate_weight(parameters)),
      solid_(parameters.body == Body::solid)
{}

bool LayeredBsdf::has_smooth_lobe() const noexcept
{
    return base_.has_smooth_lobe() || coat_.has_smooth_lobe() || sheen_.exists();
}

LayeredBsdf::Side LayeredBsdf::side(Vec3 w) const noexcept
{
    Side side{.base = base_.side(w.z)};
    if (!is_covered(w)) {
        return side;
    }
    const float coat = coat_.reflected(from_above(w, w.z > 0.0f));
    const float sheen = sheen_.reflected(std::abs(w.z));
    side.below_coat = 1.0f - coat;
    side.below_sheen = 1.0f - sheen;
    const float sheen_weight = side.below_coat * sheen;
    const float base_weight = side.below_coat * side.below_sheen * base_weight_;
    float again = 0.0f;
    if (again_.exists()) {
        side.lost = lost(again_, w.z, side.base);
        again = again_.weight() * side.lost;
    }
    const float inverse = 1.0f / (coat + sheen_weight + again + base_weight);
    side.coat_choice = coat * inverse;
    side.sheen_choice = sheen_weight * inverse;
    side.again_choice = again * inverse;
    side.base_choice = base_weight * inverse;
    return side;
}

BsdfEval LayeredBsdf::eval_lobes(const Side& from, Vec3 wo, Vec3 wi,
                                 TransportMode mode) const noexcept
{
    const Side to = side(wi);
    const float below_coat = passed(from.below_coat, to.below_coat);
    BsdfEval sum = chosen(base_.eval(from.base, wo, wi, mode), from.base_choice, to.base_choice);
    const float below_sheen = passed(from.below_sheen, to.below_sheen);
    sum.f_cos *= below_coat * below_sheen;
    const bool above = wo.z > 0.0f;
    if (above != (wi.z > 0.0f) || !is_covered(wo)) {
        return sum;
    }
    const Vec3 o = from_above(wo, above);
    const Vec3 i = from_above(wi, above);
    if (coat_.has_smooth_lobe()) {
        add(sum, chosen(coat_.eval(o, i, mode), from.coat_choice, to.coat_choice));
    }
    if (sheen_.exists()) {
        BsdfEval sheen = chosen(sheen_.eval(o, i, mode), from.sheen_choice, to.sheen_choice);
        sheen.f_cos *= below_coat;
        add(sum, sheen);
    }
    if (again_.exists()) {
        BsdfEval again = chosen(again_.lobe(from.lost, to.lost).eval(o, i, mode), from.again_choice,
                                to.again_choice);
        again.f_cos *= below_sheen;
        add(sum, again);
    }
    return sum;
}

BsdfEval LayeredBsdf::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    return grazes(wo) || grazes(wi) ? BsdfEval{} : eval_lobes(side(wo), wo, wi, mode);
}

/// Samples the coat: the complete sample of a delta lobe, else only the direction matters.
std::optional<BsdfSample> LayeredBsdf::sample_coat(const Side& from, Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
{
    const bool above = wo.z > 0.0f;
    std::optional<BsdfSample> sampled = coat_.sample(from_above(wo, above), u_lobe, u, mode);
    if (!sampled) {
        return std::nullopt;
    }
    sampled->wi = from_above(sampled->wi, above);
    if (sampled->delta) {
        choose_delta_coat(*sampled, from.coat_choice, side(sampled->wi).coat_choice);
    }
    return sampled;
}

/// Samples the base, likewise.
std::optional<BsdfSample> LayeredBsdf::sample_base(const Side& from, Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
{
    std::optional<BsdfSample> sampled = base_.sample(from.base, wo, u_lobe, u, mode);
    if (!sampled || !sampled->delta) {
        return sampled;
    }
    const Side to = side(sampled->wi);
    sampled->weight *= passed(from.below_coat, to.below_coat) *
                       passed(from.below_sheen, to.below_sheen) / from.base_choice;
    sampled->pdf_fwd.value *= from.base_choice;
    sampled->pdf_rev.value *= to.base_choice;
    return sampled;
}

std::optional<BsdfSample> LayeredBsdf::sample(Vec3 wo, float u_lobe, Vec2 u,
                                              TransportMode mode) const noexcept
{
    if (grazes(wo)) {
        return std::nullopt;
    }
    constexpr float below_one = 1.0f - 0x1p-24f;
    const Side from = side(wo);
    const float above_again = from.coat_choice + from.sheen_choice;
    const float above_base = above_again + from.again_choice;
    std::optional<BsdfSample> sampled;
    if (u_lobe < from.coat_choice) {
        sampled = sample_coat(from, wo, u_lobe / from.coat_choice, u, mode);
    } else if (u_lobe >= above_again && u_lobe < above_base) {
        sampled = again_.lobe(0.0f, 0.0f).sample(wo, 0.0f, u, mode);
    } else if (u_lobe < above_again) {
        const bool above = wo.z > 0.0f;
        sampled = sheen_.sample(from_above(wo, above), u_lobe, u, mode);
        sampled->wi = from_above(sampled->wi, above);
    } else if (from.base_choice > 0.0f) {
        const float u_base = std::min((u_lobe - above_base) / from.base_choice, below_one);
        sampled = sample_base(from, wo, u_base, u, mode);
    }
    if (!sampled || sampled->delta || grazes(sampled->wi)) {
        return sampled && sampled->delta ? sampled : std::nullopt;
    }
    return smooth_sample(sampled->wi, eval_lobes(from, wo, sampled->wi, mode));
}

BsdfEval Layered::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    return LayeredBsdf(parameters_).eval(wo, wi, mode);
}

std::optional<BsdfSample> Layered::sample(Vec3 wo, float u_lobe, Vec2 u,
                                          TransportMode mode) const noexcept
{
    return LayeredBsdf(parameters_).sample(wo, u_lobe, u, mode);
}

bool Layered::has_smooth_lobe() const noexcept
{
    return LayeredBsdf(parameters_).has_smooth_lobe();
}

}  // namespace bdpt
