#pragma once

#include "material/lobes/lobe.h"
#include "material/lobes/returned_light.h"
#include "material/mapped_bsdf.h"
#include "math/frame.h"
#include "math/warp.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bdpt {

/// The frame of a layer that is also that of what it covers.
struct SameFrame {
    [[nodiscard]] Vec3 to_local(Vec3 w) const { return w; }
    [[nodiscard]] Vec3 to_world(Vec3 w) const { return w; }
};

/// A layer over something else, `Below`, which may have layers itself: layers cover the outside of
/// solid bodies, and both sides of all other surfaces. Directions are local to what is below; the
/// layer has a frame in it.
///
/// Everything below is multiplied by min(T(wo), T(wi)), where T is the fraction that the layer does
/// not reflect: so no energy is created, and the model is reciprocal. That is the rule that
/// KHR_materials_sheen gives for its layer. The energy that is lost by it is restored as diffuse
/// light (`ReturnedLight`).
///
/// `Layer` is a lobe with `exists`, `has_smooth_lobe`, `is_delta`, `weight`, the covered fraction,
/// `row`, its roughness, `reflected`, the fraction of light that does not pass it, and
/// - `color_over`: the albedo of the layer over a surface of this colour,
/// - `returned`: the fraction of lost light that leaves a surface of this colour in the end,
/// - `set_base`: sets what is below, before the first `filter`,
/// - `filters`: has a colour, by which light that passes it is multiplied: `filter` of the sum of
///   `path` of both directions,
/// - `lost_below`: what the layer and something that loses `lost` lose below another layer.
template <typename Layer, typename Below, typename LayerFrame>
class LayerOver {
public:
    /// Values that depend on one direction alone.
    struct Side {
        typename Below::Side below;
        Vec3 w{0.0f};  ///< in the frame of the layer, seen from its side
        bool above = true;
        bool covered = false;
        float passed = 1.0f;  ///< fraction of light that remains below the layer
        float path = 0.0f;    ///< through the layer, if it filters
        float lost = 0.0f;    ///< fraction of light between the layer and what is below
        float weight = 0.0f;  ///< approximate albedo
        // Probabilities of the lobes.
        float layer_choice = 0.0f;
        float again_choice = 0.0f;

        [[nodiscard]] float below_choice() const { return 1.0f - layer_choice - again_choice; }
    };

    /// `loss` is that of the layer, if it exists, and must outlive this.
    LayerOver(const Layer& layer, const Below& below, const LayerLoss* loss, bool solid,
              const LayerFrame& frame = {})
        : layer_(layer), below_(below), frame_(frame), solid_(solid)
    {
        if (layer_.exists()) {
            const CoveredBase base = below_.covered_base();
            layer_.set_base(base);
            again_ = {base, layer_.weight(), layer_.row(), *loss};
            again_.restore(layer_.returned(base.color), below_.average_lost(again_));
        }
    }

    [[nodiscard]] Side side(Vec3 w) const noexcept
    {
        Side side{.below = below_.side(w)};
        if (!layer_.exists()) {
            return side;
        }
        side.w = frame_.to_local(w);
        side.above = side.w.z > 0.0f;
        side.covered = side.above || !solid_;
        const float z = side.w.z;
        if (!side.above) {
            side.w = -side.w;
        }
        side.weight = below_.weight(side.below);
        if (!side.covered) {
            return side;
        }
        const float reflected = layer_.reflected(side.w);
        side.passed = 1.0f - reflected;
        if (layer_.filters()) {
            side.path = layer_.path(side.w);
        }
        float again = 0.0f;
        if (again_.exists()) {
            side.lost = below_.lost(again_, z, side.below);
            again = again_.weight() * side.lost;
        }
        side.weight = reflected + again + side.passed * side.weight;
        side.layer_choice = reflected / side.weight;
        side.again_choice = again / side.weight;
        return side;
    }

    [[nodiscard]] BsdfEval eval(const Side& from, const Side& to, Vec3 wo, Vec3 wi,
                                TransportMode mode) const noexcept
    {
        BsdfEval sum = below_.eval(from.below, to.below, wo, wi, mode);
        if (!layer_.exists()) {
            return sum;
        }
        sum = chosen(sum, from.below_choice(), to.below_choice());
        sum.f_cos *= std::min(from.passed, to.passed);
        if (!from.covered || from.above != to.above) {
            if (layer_.filters()) {
                sum.f_cos *= filter(from, to);
            }
            return sum;
        }
        if (again_.exists()) {
            add(sum, chosen(again_.lobe(from.lost, to.lost).eval(from.w, to.w, mode),
                            from.again_choice, to.again_choice));
        }
        if (layer_.filters()) {
            sum.f_cos *= filter(from, to);
        }
        if (layer_.has_smooth_lobe()) {
            add(sum, chosen(layer_.eval(from.w, to.w, mode), from.layer_choice, to.layer_choice));
        }
        return sum;
    }

    /// Samples a direction: the complete sample of a delta lobe, else only the direction matters.
    [[nodiscard]] std::optional<BsdfSample> direct(const Side& from, Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
    {
        if (!layer_.exists()) {
            return below_.direct(from.below, wo, u_lobe, u, mode);
        }
        const Choice layer = choose(u_lobe, from.layer_choice);
        if (layer.taken) {
            std::optional<BsdfSample> sampled = layer_.sample(from.w, layer.u, u, mode);
            if (sampled) {
                sampled->wi = from_layer(sampled->wi, from.above);
                if (sampled->delta) {
                    choose_delta(*sampled, from.layer_choice, side(sampled->wi).layer_choice);
                }
            }
            return sampled;
        }
        const Choice again = choose(layer.u, from.again_choice / (1.0f - from.layer_choice));
        if (again.taken) {
            return towards(from_layer(square_to_cosine_hemisphere(u), from.above));
        }
        std::optional<BsdfSample> sampled = below_.direct(from.below, wo, again.u, u, mode);
        if (sampled && sampled->delta) {
            const Side to = side(sampled->wi);
            choose_delta(*sampled, from.below_choice(), to.below_choice());
            sampled->weight *= std::min(from.passed, to.passed);
            if (layer_.filters()) {
                sampled->weight *= filter(from, to);
            }
        }
        return sampled;
    }

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
    {
        return grazes_layer(wo) || grazes_layer(wi) ? BsdfEval{}
                                                    : eval(side(wo), side(wi), wo, wi, mode);
    }
    /// `u_lobe` and `u` are uniform in [0, 1).
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
    {
        if (grazes_layer(wo)) {
            return std::nullopt;
        }
        const Side from = side(wo);
        std::optional<BsdfSample> sampled = direct(from, wo, u_lobe, u, mode);
        if (!sampled || sampled->delta) {
            return sampled;
        }
        const Vec3 wi = sampled->wi;
        if (grazes_layer(wi)) {
            return std::nullopt;
        }
        return smooth_sample(wi, eval(from, side(wi), wo, wi, mode));
    }
    /// Tests whether it has a lobe that is not delta.
    [[nodiscard]] bool has_smooth_lobe() const noexcept
    {
        return below_.has_smooth_lobe() || layer_.has_smooth_lobe();
    }

    // What another layer above needs.

    /// Returns the approximate albedo, > 0.
    [[nodiscard]] float weight(const Side& side) const noexcept
    {
        return layer_.exists() ? side.weight : below_.weight(side.below);
    }
    [[nodiscard]] CoveredBase covered_base() const noexcept
    {
        CoveredBase base = below_.covered_base();
        if (layer_.exists()) {
            base.color = layer_.color_over(base.color);
            base.layer = layer_.weight();
        }
        return base;
    }
    /// Returns the fraction of light from a direction with this z that is lost below a layer that
    /// returns `again`.
    [[nodiscard]] float lost(const ReturnedLight& again, float z, const Side& side) const noexcept
    {
        const float lost = below_.lost(again, z, side.below);
        return side.covered && layer_.exists()
                   ? layer_.lost_below(again, std::abs(z), side.passed, lost)
                   : lost;
    }
    /// Returns the cosine-weighted average of `lost`.
    [[nodiscard]] float average_lost(const ReturnedLight& again) const noexcept
    {
        if (!layer_.exists()) {
            return below_.average_lost(again);
        }
        constexpr int heights = 16;
        float sum = 0.0f;
        float weights = 0.0f;
        for (int i = 0; i < heights; ++i) {
            const float root = (static_cast<float>(i) + 0.5f) / heights;
            const float z = root * root;
            const float weight = z * root;  // cos d cos = 2 root^3 d root
            sum +=
                weight * lost(again, z, side(from_layer({std::sqrt(1.0f - z * z), 0.0f, z}, true)));
            weights += weight;
        }
        return sum / weights;
    }

private:
    [[nodiscard]] bool grazes_layer(Vec3 w) const { return grazes(frame_.to_local(w)); }
    [[nodiscard]] Rgb filter(const Side& from, const Side& to) const
    {
        return from.covered || to.covered
                   ? layer_.filter(from.path + to.path, from.covered && to.covered)
                   : Rgb(1.0f);
    }
    [[nodiscard]] Vec3 from_layer(Vec3 w, bool above) const
    {
        return frame_.to_world(above ? w : -w);
    }
    /// Applies the probabilities of choosing a delta lobe from either side.
    static void choose_delta(BsdfSample& sample, float from_choice, float to_choice)
    {
        sample.weight /= from_choice;
        sample.pdf_fwd.value *= from_choice;
        sample.pdf_rev.value *= to_choice;
    }

    Layer layer_;
    Below below_;
    ReturnedLight again_;
    [[no_unique_address]] LayerFrame frame_;
    bool solid_;
};

}  // namespace bdpt
