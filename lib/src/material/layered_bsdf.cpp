#include "material/layered_bsdf.h"

#include "math/rgb.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace bdpt {
namespace {

static_assert(std::is_trivially_copyable_v<LayeredParameters>);
static_assert(sizeof(LayeredParameters) <= sizeof(GltfBsdf));

/// Layers see their own side of the surface from above.
[[nodiscard]] Vec3 from_above(Vec3 w, bool above)
{
    return above ? w : -w;
}

}  // namespace

LayeredBsdf::LayeredBsdf(const LayeredParameters& parameters)
    : base_(parameters.base, *parameters.constants->base),
      coat_(parameters.coat.value(), parameters.coat_roughness.value(),
            parameters.coat_normal.value(), parameters.constants->tables->coat),
      base_weight_(0.05f + 0.95f * max_component(base_.base_color())),
      solid_(parameters.base.body == Body::solid)
{}

bool LayeredBsdf::has_smooth_lobe() const noexcept
{
    return base_.has_smooth_lobe() || coat_.has_smooth_lobe();
}

LayeredBsdf::Side LayeredBsdf::side(Vec3 w) const noexcept
{
    Side side{.base = base_.side(w.z)};
    if (!is_covered(w)) {
        return side;
    }
    const float coat = coat_.reflected(from_above(w, w.z > 0.0f));
    side.below_coat = 1.0f - coat;
    const float base = side.below_coat * base_weight_;
    side.coat_choice = coat / (coat + base);
    side.base_choice = 1.0f - side.coat_choice;
    return side;
}

BsdfEval LayeredBsdf::eval_lobes(const Side& from, Vec3 wo, Vec3 wi,
                                 TransportMode mode) const noexcept
{
    const Side to = side(wi);
    BsdfEval sum = base_.eval(from.base, wo, wi, mode);
    sum.f_cos *= std::min(from.below_coat, to.below_coat);
    sum.pdf_fwd.value *= from.base_choice;
    sum.pdf_rev.value *= to.base_choice;
    const bool above = wo.z > 0.0f;
    if (above != (wi.z > 0.0f) || !is_covered(wo)) {
        return sum;
    }
    if (coat_.has_smooth_lobe()) {
        const BsdfEval coat = coat_.eval(from_above(wo, above), from_above(wi, above), mode);
        sum.f_cos += coat.f_cos;
        sum.pdf_fwd.value += from.coat_choice * coat.pdf_fwd.value;
        sum.pdf_rev.value += to.coat_choice * coat.pdf_rev.value;
    }
    return sum;
}

BsdfEval LayeredBsdf::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    return grazes(wo) || grazes(wi) ? BsdfEval{} : eval_lobes(side(wo), wo, wi, mode);
}

std::optional<BsdfSample> LayeredBsdf::sample_base(const Side& from, Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
{
    std::optional<BsdfSample> sampled = base_.sample(from.base, wo, u_lobe, u, mode);
    if (!sampled || !sampled->delta) {
        return sampled;
    }
    const Side to = side(sampled->wi);
    sampled->weight *= std::min(from.below_coat, to.below_coat) / from.base_choice;
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
    const bool above = wo.z > 0.0f;
    Vec3 wi;
    if (u_lobe < from.coat_choice) {
        if (!coat_.has_smooth_lobe()) {
            std::optional<BsdfSample> mirrored = coat_.mirror(from_above(wo, above), mode);
            if (!mirrored) {
                return std::nullopt;
            }
            mirrored->wi = from_above(mirrored->wi, above);
            mirrored->weight /= from.coat_choice;
            mirrored->pdf_fwd.value *= from.coat_choice;
            mirrored->pdf_rev.value *= side(mirrored->wi).coat_choice;
            return mirrored;
        }
        const std::optional<Vec3> reflected = coat_.sample(from_above(wo, above), u);
        if (!reflected) {
            return std::nullopt;
        }
        wi = from_above(*reflected, above);
    } else {
        const float u_base = (u_lobe - from.coat_choice) / from.base_choice;
        const auto sampled = sample_base(from, wo, std::min(u_base, below_one), u, mode);
        if (!sampled || sampled->delta) {
            return sampled;
        }
        wi = sampled->wi;
    }
    if (grazes(wi)) {
        return std::nullopt;
    }
    const BsdfEval value = eval_lobes(from, wo, wi, mode);
    if (!(value.pdf_fwd.value >= std::numeric_limits<float>::min())) {
        return std::nullopt;
    }
    return BsdfSample{wi, value.f_cos * (1.0f / value.pdf_fwd.value), value.pdf_fwd, value.pdf_rev,
                      false};
}

}  // namespace bdpt
