#pragma once

#include "material/bsdf_model.h"
#include "material/gltf_bsdf.h"
#include "material/layers.h"
#include "material/small_numbers.h"
#include "material/tilted_facet.h"
#include "math/frame.h"

#include <glm/geometric.hpp>

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
    /// With a normal map: `facet.z` is its normal and `ns` that of the surface without it, on the
    /// side of `ng`; both are unit and less than a right angle apart.
    Bsdf(Vec3 ng, Vec3 ns, const Frame& facet, Vec3 wo, const GltfBsdf& model) noexcept;
    Bsdf(Vec3 ng, Vec3 ns, const Frame& facet, Vec3 wo, const LayeredParameters& layers) noexcept;

    /// `mode` is that of the walk which came from wo.
    [[nodiscard]] BsdfEval eval(Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    /// Has a lobe that is not delta: strategies can join here.
    [[nodiscard]] bool connectible() const noexcept
    {
        return has_layers() ? layers_connectible() : model_.plain.has_smooth_lobe();
    }
    /// Samples without `u_lobe`.
    [[nodiscard]] bool has_one_lobe() const noexcept
    {
        return !is_rare() && extra_.from.specular_choice == 0.0f;
    }
    /// The geometric normal, unit, on the side of wo: if all light that is scattered stays there.
    [[nodiscard]] std::optional<Vec3> opaque_normal() const noexcept
    {
        const bool transmits = has_layers() ? layers_transmit() : model_.plain.transmits();
        const float side = is_rare() ? dot(shading_.to_world(local_wo_), ng_) : local_wo_.z;
        return transmits ? std::nullopt : std::optional(side < 0.0f ? -ng_ : ng_);
    }
    /// Unit, on the front side of the surface; that of the normal map, if there is one.
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

    /// What is rare: layers, normal maps, or both.
    struct Rarity {
        bool layered = false;
        bool mapped = false;
        Direction16 ns{};  ///< of mapped surfaces, in the frame of the facet
    };
    union Extra {
        constexpr Extra() : from() {}
        constexpr explicit Extra(const GltfBsdf::Side& side) : from(side) {}
        constexpr explicit Extra(const Rarity& what) : rarity(what) {}

        GltfBsdf::Side from;  ///< the side of wo, of a plain model
        Rarity rarity;        ///< of all others
    };

    [[nodiscard]] bool is_rare() const noexcept { return ratio_o_ < 0.0f; }
    [[nodiscard]] bool has_layers() const noexcept { return is_rare() && extra_.rarity.layered; }
    // Apart from the rest, and never within it, which is to stay short: bsdf_rare.cpp.
    [[nodiscard, gnu::noinline]] BsdfEval eval_rare(Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard, gnu::noinline]] std::optional<BsdfSample> sample_rare(
        float u_lobe, Vec2 u, TransportMode mode) const noexcept;
    [[nodiscard]] BsdfEval eval_model(Vec3 local_wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample_model(float u_lobe, Vec2 u,
                                                         TransportMode mode) const noexcept;
    [[nodiscard]] TiltedFacet facet() const noexcept;
    [[nodiscard]] float height(Vec3 local) const noexcept;
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
    /// is, so that one comparison is enough for both: below 0 for what is rare.
    float ratio_o_ = 0.0f;
    Extra extra_;
    Model model_;
};

}  // namespace bdpt
