#include "material/bsdf.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <type_traits>

namespace bdpt {

static_assert(std::is_trivially_copyable_v<Bsdf> && sizeof(Bsdf) <= 208);

// Shading normals scale importance, but not radiance, by the adjoint factor: the ratio of the
// cosine ratios of both directions [Veach 1997, sec. 5.3]; it is exactly 1 if the normals are
// equal.

namespace {

/// Raises `w` above the horizon of the normal `n`, to the side of `n` that `side` tells.
Vec3 raise(Vec3 w, Vec3 n, float side)
{
    constexpr float least_cosine = 0.01f;
    return glm::normalize(w + (std::copysign(least_cosine, side) - dot(w, n)) * n);
}

}  // namespace

void Bsdf::raise_wo() noexcept
{
    const float side = dot(shading_.to_world(local_wo_), ng_);
    if (side == 0.0f) {
        return;
    }
    local_wo_ = raise(local_wo_, visit([](const auto& model) { return normal_of(model); }), side);
    std::visit(
        [this](auto& model) {
            if constexpr (requires { model.move_to(local_wo_); }) {
                model.move_to(local_wo_);
            }
        },
        model_);
    ratio_o_ = raised;
}

template <typename Model>
BsdfEval Bsdf::eval_model(const Model& model, Vec3 local_wi, const Cosines& cosines,
                          TransportMode mode) const noexcept
{
    BsdfEval value = model.eval(local_wo_, local_wi, mode);
    if (mode == TransportMode::importance && ratio_o_ > 0.0f) {
        value.f_cos *= cosines.ratio() / ratio_o_;
    }
    if (ratio_o_ == raised) {
        value.pdf_rev = {};
    }
    return value;
}

BsdfEval Bsdf::eval(Vec3 wi, TransportMode mode) const noexcept
{
    if (ratio_o_ == 0.0f) {
        return {};
    }
    const Vec3 local_wi = shading_.to_local(wi);
    return visit([&](const auto& model) -> BsdfEval {
        const Cosines cosines{dot(wi, ng_), height(model, local_wi)};
        return cosines.agree() ? eval_model(model, local_wi, cosines, mode) : BsdfEval{};
    });
}

BsdfEval Bsdf::eval_to_lens(Vec3 to_lens) const noexcept
{
    if (ratio_o_ == 0.0f) {
        return {};
    }
    const Vec3 local = shading_.to_local(to_lens);
    return visit([&](const auto& model) -> BsdfEval {
        const Cosines cosines{dot(to_lens, ng_), height(model, local)};
        if (cosines.agree()) {
            return eval_model(model, local, cosines, TransportMode::importance);
        }
        if (cosines.geometric == 0.0f) {
            return {};
        }
        const Vec3 above = raise(local, normal_of(model), cosines.geometric);
        BsdfEval value = eval_model(model, above, {cosines.geometric, height(model, above)},
                                    TransportMode::importance);
        value.pdf_fwd = {};
        return value;
    });
}

std::optional<BsdfSample> Bsdf::sample(float u_lobe, Vec2 u, TransportMode mode) const noexcept
{
    if (ratio_o_ == 0.0f) {
        return std::nullopt;
    }
    return visit([&](const auto& model) -> std::optional<BsdfSample> {
        std::optional<BsdfSample> sampled = model.sample(local_wo_, u_lobe, u, mode);
        if (sampled) {
            const float local_cos = height(model, sampled->wi);
            sampled->wi = shading_.to_world(sampled->wi);
            const Cosines cosines{dot(sampled->wi, ng_), local_cos};
            if (!cosines.agree()) {
                sampled.reset();
            } else if (mode == TransportMode::importance && ratio_o_ > 0.0f) {
                sampled->weight *= cosines.ratio() / ratio_o_;
            } else if (ratio_o_ == raised) {
                sampled->pdf_rev = {};
            }
        }
        return sampled;
    });
}

}  // namespace bdpt
