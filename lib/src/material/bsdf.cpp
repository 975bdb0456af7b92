#include "material/bsdf.h"

#include <glm/geometric.hpp>

#include <type_traits>

namespace bdpt {

static_assert(std::is_trivially_copyable_v<Bsdf> && sizeof(Bsdf) <= 160);

// Shading normals scale importance, but not radiance, by the adjoint factor: the ratio of the
// cosine ratios of both directions [Veach 1997, sec. 5.3]; it is exactly 1 if the normals are
// equal.

BsdfEval Bsdf::eval(Vec3 wi, TransportMode mode) const noexcept
{
    if (ratio_o_ == 0.0f) {
        return {};
    }
    const Vec3 local_wi = shading_.to_local(wi);
    return visit([&](const auto& model) -> BsdfEval {
        const Cosines cosines{dot(wi, ng_), height(model, local_wi)};
        if (!cosines.agree()) {
            return {};
        }
        BsdfEval value = model.eval(local_wo_, local_wi, mode);
        if (mode == TransportMode::importance && !is_flat()) {
            const float ratio_i = cosines.ratio();
            value.f_cos *= ratio_i / ratio_o_;
        }
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
            } else if (mode == TransportMode::importance && !is_flat()) {
                const float ratio_i = cosines.ratio();
                sampled->weight *= ratio_i / ratio_o_;
            }
        }
        return sampled;
    });
}

}  // namespace bdpt
