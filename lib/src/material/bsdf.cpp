#include "material/bsdf.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <type_traits>

namespace bdpt {
namespace {

static_assert(std::is_trivially_copyable_v<Bsdf>);

/// One direction against both normals.
struct Cosines {
    float geometric;
    float shading;

    /// Light neither leaks through the surface nor comes from below it.
    [[nodiscard]] bool agree() const { return geometric * shading > 0.0f; }
};

/// What shading normals do to importance but not to radiance [Veach 1997, sec. 5.3]; exactly 1
/// where the normals are equal.
[[nodiscard]] float adjoint_factor(const Cosines& wo, const Cosines& wi)
{
    return std::abs((wo.shading * wi.geometric) / (wo.geometric * wi.shading));
}

}  // namespace

Bsdf::Bsdf(Vec3 ng, const Frame& shading, const GltfBsdf& model)
    : shading_(shading), ng_(ng), model_(model)
{}

BsdfEval Bsdf::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    const Vec3 local_wo = shading_.to_local(wo);
    const Vec3 local_wi = shading_.to_local(wi);
    const Cosines cos_o{dot(wo, ng_), local_wo.z};
    const Cosines cos_i{dot(wi, ng_), local_wi.z};
    if (!cos_o.agree() || !cos_i.agree()) {
        return {};
    }
    BsdfEval value = model_.eval(local_wo, local_wi, mode);
    if (mode == TransportMode::importance) {
        value.f_cos *= adjoint_factor(cos_o, cos_i);
    }
    return value;
}

std::optional<BsdfSample> Bsdf::sample(Vec3 wo, float u_lobe, Vec2 u,
                                       TransportMode mode) const noexcept
{
    const Vec3 local_wo = shading_.to_local(wo);
    const Cosines cos_o{dot(wo, ng_), local_wo.z};
    if (!cos_o.agree()) {
        return std::nullopt;
    }
    std::optional<BsdfSample> sampled = model_.sample(local_wo, u_lobe, u, mode);
    if (!sampled) {
        return std::nullopt;
    }
    const float local_cos = sampled->wi.z;
    sampled->wi = shading_.to_world(sampled->wi);
    const Cosines cos_i{dot(sampled->wi, ng_), local_cos};
    if (!cos_i.agree()) {
        return std::nullopt;
    }
    if (mode == TransportMode::importance) {
        sampled->weight *= adjoint_factor(cos_o, cos_i);
    }
    return sampled;
}

}  // namespace bdpt
