#pragma once

#include "material/bsdf_model.h"
#include "material/gltf_bsdf.h"
#include "material/layers.h"
#include "math/frame.h"

#include <optional>

namespace bdpt {

/// A scattering model placed at a surface point and seen from one direction: world-space directions
/// in, world-space directions out; all point away from the surface. The one place that knows of
/// geometric versus shading normals. What follows from `wo` alone is worked out once, for all the
/// joins of a path vertex. A trivially copyable value that lives inside a vertex.
class Bsdf {
public:
    Bsdf() = default;
    /// `ng` and `shading.z` are unit vectors on the front side of the surface (for a solid body:
    /// its outside) and in one hemisphere. `wo` is unit, towards the previous vertex of the walk.
    Bsdf(Vec3 ng, const Frame& shading, Vec3 wo, const GltfBsdf& model) noexcept;
    Bsdf(Vec3 ng, const Frame& shading, Vec3 wo, const LayeredParameters& layers) noexcept;

    /// `mode` is that of the walk which came from wo.
    [[nodiscard]] BsdfEval eval(Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    /// Has a lobe that is not delta: strategies can join here.
    [[nodiscard]] bool connectible() const noexcept
    {
        return has_layers() ? layers_connectible() : model_.plain.has_smooth_lobe();
    }
    /// The geometric normal, unit, on the side of wo: if all light that is scattered stays there.
    [[nodiscard]] std::optional<Vec3> opaque_normal() const noexcept
    {
        const bool transmits = has_layers() ? layers_transmit() : model_.plain.transmits();
        return transmits ? std::nullopt : std::optional(local_wo_.z < 0.0f ? -ng_ : ng_);
    }
    /// Unit, on the front side of the surface.
    [[nodiscard]] Vec3 shading_normal() const noexcept { return shading_.z; }
    /// In [0, 1].
    [[nodiscard]] Rgb base_color() const noexcept
    {
        return has_layers() ? layers_base_color() : model_.plain.base_color();
    }

private:
    /// Layers are rare: what would make all vertices larger is worked out at each call instead.
    union Model {
        constexpr Model() : plain() {}
        constexpr explicit Model(const GltfBsdf& bsdf) : plain(bsdf) {}
        constexpr explicit Model(const LayeredParameters& parameters) : layers(parameters) {}

        GltfBsdf plain;
        LayeredParameters layers;
    };

    [[nodiscard]] bool has_layers() const noexcept { return ratio_o_ < 0.0f; }
    // Apart from the rest, and never within it, which is to stay short: bsdf_layers.cpp.
    [[nodiscard, gnu::noinline]] BsdfEval eval_layers(Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard, gnu::noinline]] std::optional<BsdfSample> sample_layers(
        float u_lobe, Vec2 u, TransportMode mode) const noexcept;
    [[nodiscard]] bool layers_connectible() const noexcept;
    [[nodiscard]] bool layers_transmit() const noexcept
    {
        const LayeredParameters& layers = model_.layers;
        return layers.base.transmission > 0.0f || layers.diffuse_transmission.value() > 0.0f;
    }
    [[nodiscard]] Rgb layers_base_color() const noexcept;

    Frame shading_;
    Vec3 ng_{0.0f, 0.0f, 1.0f};
    Vec3 local_wo_{0.0f};
    /// wo.ng / wo.ns; 0 where they differ in sign: nothing scatters. Its sign tells which model it
    /// is, so that one comparison is enough for both: below 0 for layers.
    float ratio_o_ = 0.0f;
    GltfBsdf::Side from_;  ///< of a plain model
    Model model_;
};

}  // namespace bdpt
