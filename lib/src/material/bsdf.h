#pragma once

#include "material/bsdf_model.h"
#include "material/gltf_bsdf.h"
#include "math/frame.h"

#include <optional>

namespace bdpt {

/// A scattering model placed at a surface point: world-space directions in, world-space directions
/// out; both point away from the surface. The one place that knows of geometric versus shading
/// normals. A small trivially copyable value that lives inside a path vertex.
class Bsdf {
public:
    Bsdf() = default;
    /// `ng` and `shading.z` are unit vectors on the front side of the surface (for a solid body:
    /// its outside) and in one hemisphere.
    Bsdf(Vec3 ng, const Frame& shading, const GltfBsdf& model);

    /// `wo` points towards the previous vertex of the walk whose mode is given.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    /// Has a lobe that is not delta: strategies can join here.
    [[nodiscard]] bool connectible() const noexcept { return model_.has_smooth_lobe(); }
    /// Unit, on the front side of the surface.
    [[nodiscard]] Vec3 shading_normal() const noexcept { return shading_.z; }
    /// In [0, 1].
    [[nodiscard]] Rgb base_color() const noexcept { return model_.base_color(); }

private:
    Frame shading_;
    Vec3 ng_{0.0f, 0.0f, 1.0f};
    GltfBsdf model_;
};

}  // namespace bdpt
