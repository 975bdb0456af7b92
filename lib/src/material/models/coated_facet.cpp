#include "material/models/coated_facet.h"

#include "material/mapped_bsdf.h"
#include "math/warp.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace bdpt {
namespace {

[[nodiscard]] LayeredParameters without_coat(LayeredParameters parameters)
{
    parameters.coat = Unit16(0.0f);
    return parameters;
}

}  // namespace

CoatedFacet::CoatedFacet(const TiltedFacet& facet, const LayeredParameters& parameters)
    : facet_(facet),
      surface_(Frame::from_normal(facet.macro_normal())),
      below_(without_coat(parameters)),
      coat_(parameters.coat.value(), parameters.coat_roughness.value(),
            local_coat_normal(parameters.coat_normal.value()),
            parameters.constants->tables->coat.get()),
      again_(below_.interreflection(coat_, parameters.constants->tables->coat_loss.get())),
      color_(clamp(parameters.base_color, 0.0f, 1.0f)),
      solid_(parameters.body == Body::solid)
{}

/// Returns exactly +z if the coat follows the surface.
Vec3 CoatedFacet::local_coat_normal(Vec3 normal) const
{
    return normal == facet_.macro_normal() ? Vec3{0.0f, 0.0f, 1.0f}
                                           : normalize(surface_.to_local(normal));
}

CoatedFacet::Side CoatedFacet::side(Vec3 w) const noexcept
{
    Side side{.w = surface_.to_local(w)};
    side.above = side.w.z > 0.0f;
    side.covered = side.above || !solid_;
    if (!side.above) {
        side.w = -side.w;
    }
    if (side.covered) {
        const float reflected = coat_.reflected(side.w);
        side.below_coat = 1.0f - reflected;
        float again = 0.0f;
        if (again_.exists()) {
            side.lost = below_.lost(again_, side.w.z);
            again = again_.weight() * side.lost;
        }
        const float inverse = 1.0f / (reflected + again + side.below_coat * below_.base_weight());
        side.coat_choice = reflected * inverse;
        side.again_choice = again * inverse;
    }
    return side;
}

BsdfEval CoatedFacet::eval_lobes(const Side& from, Vec3 wo, Vec3 wi,
                                 TransportMode mode) const noexcept
{
    const Side to = side(wi);
    BsdfEval sum = chosen(MappedBsdf(facet_, below_, color_).eval(wo, wi, mode),
                          from.below_choice(), to.below_choice());
    sum.f_cos *= std::min(from.below_coat, to.below_coat);
    if (!from.covered || from.above != to.above) {
        return sum;
    }
    if (coat_.has_smooth_lobe()) {
        add(sum, chosen(coat_.eval(from.w, to.w, mode), from.coat_choice, to.coat_choice));
    }
    if (again_.exists()) {
        add(sum, chosen(again_.lobe(from.lost, to.lost).eval(from.w, to.w, mode), from.again_choice,
                        to.again_choice));
    }
    return sum;
}

BsdfEval CoatedFacet::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    const Side from = side(wo);
    return grazes(from.w) || grazes(surface_.to_local(wi)) ? BsdfEval{}
                                                           : eval_lobes(from, wo, wi, mode);
}

/// Samples the coat: the complete sample of a delta lobe, else only the direction matters.
std::optional<BsdfSample> CoatedFacet::sample_coat(const Side& from, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
{
    std::optional<BsdfSample> sampled = coat_.sample(from.w, u_lobe, u, mode);
    if (!sampled) {
        return std::nullopt;
    }
    sampled->wi = from_surface(sampled->wi, from.above);
    if (sampled->delta) {
        choose_delta_coat(*sampled, from.coat_choice, side(sampled->wi).coat_choice);
    }
    return sampled;
}

/// Samples the layers below the coat, likewise.
std::optional<BsdfSample> CoatedFacet::sample_below(const Side& from, Vec3 wo, float u_lobe, Vec2 u,
                                                    TransportMode mode) const noexcept
{
    std::optional<BsdfSample> sampled =
        MappedBsdf(facet_, below_, color_).sample(wo, u_lobe, u, mode);
    if (!sampled || !sampled->delta) {
        return sampled;
    }
    const Side to = side(sampled->wi);
    const float choice = from.below_choice();
    sampled->weight *= std::min(from.below_coat, to.below_coat) / choice;
    sampled->pdf_fwd.value *= choice;
    sampled->pdf_rev.value *= to.below_choice();
    return sampled;
}

std::optional<BsdfSample> CoatedFacet::sample(Vec3 wo, float u_lobe, Vec2 u,
                                              TransportMode mode) const noexcept
{
    const Side from = side(wo);
    if (grazes(from.w)) {
        return std::nullopt;
    }
    const Choice coat = choose(u_lobe, from.coat_choice);
    const Choice again = choose(coat.u, from.again_choice / (1.0f - from.coat_choice));
    const std::optional<BsdfSample> sampled =
        coat.taken ? sample_coat(from, coat.u, u, mode)
        : again.taken
            ? std::optional(towards(from_surface(square_to_cosine_hemisphere(u), from.above)))
            : sample_below(from, wo, again.u, u, mode);
    if (!sampled || sampled->delta || grazes(surface_.to_local(sampled->wi))) {
        return sampled && sampled->delta ? sampled : std::nullopt;
    }
    return smooth_sample(sampled->wi, eval_lobes(from, wo, sampled->wi, mode));
}

}  // namespace bdpt
