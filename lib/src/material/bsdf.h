#pragma once

#include "material/bsdf_model.h"
#include "material/models/models.h"
#include "math/frame.h"

#include <glm/geometric.hpp>

#include <optional>
#include <variant>

namespace bdpt {

/// A scattering model at a surface point seen from one direction, in world space; all directions
/// point away from the surface. The only class that handles both geometric and shading normals.
/// Values that depend on `wo` alone are computed once, for all connections of a path vertex. A
/// trivially copyable value that lives inside a vertex.
class Bsdf {
    /// Works like std::visit, but without a call for the most common model.
    template <typename Visitor>
    [[nodiscard]] auto visit(const Visitor& visitor) const
    {
        if (const auto* common = std::get_if<Lambertian>(&model_)) [[likely]] {
            return visitor(*common);
        }
        return std::visit(visitor, model_);
    }

public:
    Bsdf() = default;
    /// `ng` and `shading.z` are unit vectors on the front side of the surface (for a solid body:
    /// its outside) and in one hemisphere. `wo` is unit, towards the previous vertex of the walk.
    template <ScatteringModel Model>
    Bsdf(Vec3 ng, const Frame& shading, Vec3 wo, const Model& model) noexcept
        : Bsdf(ng, shading, Seen{shading.to_local(wo), dot(wo, ng)},
               placed(model, shading.to_local(wo)))
    {}
    /// Constructs a BSDF with a normal map: `facet.z` is its normal and `ns` that of the surface
    /// without it, on the side of `ng`; both are unit and less than a right angle apart.
    template <ScatteringModel Model>
    Bsdf(Vec3 ng, Vec3 ns, const Frame& facet, Vec3 wo, const Model& model) noexcept
        : Bsdf(ng, facet, Seen{facet.to_local(wo), dot(wo, ng)},
               mapped(model, facet.to_local(ns), facet.to_local(wo)))
    {}

    /// Evaluates the BSDF; `mode` is that of the walk that arrived from wo.
    [[nodiscard]] BsdfEval eval(Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    /// Makes a surface visible to the lens, from where `wo` comes, where its shading normal faces
    /// away: as at the silhouettes of smooth meshes of few triangles, where nothing would scatter.
    /// Scatters as if seen from just above the horizon of that normal (docs/mis.md, 5). Light paths
    /// do not sample such directions: densities of `wo` are zero.
    void see_from_lens() noexcept
    {
        if (ratio_o_ == 0.0f) {
            raise_wo();
        }
    }
    /// Evaluates the BSDF of a light path towards the lens, likewise.
    [[nodiscard]] BsdfEval eval_to_lens(Vec3 to_lens) const noexcept;
    /// Tests whether it has a lobe that is not delta: strategies can connect here.
    [[nodiscard]] bool connectible() const noexcept
    {
        return visit([](const auto& model) { return model.has_smooth_lobe(); });
    }
    /// Tests whether `sample` ignores `u_lobe`.
    [[nodiscard]] bool has_one_lobe() const noexcept
    {
        return std::holds_alternative<Lambertian>(model_);
    }
    /// Returns the geometric normal, unit, on the side of wo, if all scattered light stays on that
    /// side.
    [[nodiscard]] std::optional<Vec3> opaque_normal() const noexcept
    {
        return visit([this](const auto& model) -> std::optional<Vec3> {
            if (model.transmits()) {
                return std::nullopt;
            }
            return height(model, local_wo_) < 0.0f ? -ng_ : ng_;
        });
    }
    /// Returns the unit shading normal on the front side of the surface; that of the normal map, if
    /// there is one.
    [[nodiscard]] Vec3 shading_normal() const noexcept { return shading_.z; }
    /// Returns the base colour, in [0, 1].
    [[nodiscard]] Rgb base_color() const noexcept
    {
        return visit([](const auto& model) { return model.base_color(); });
    }

private:
    struct Seen {
        Vec3 local_wo;
        float cosine;  ///< wo.ng
    };
    template <ScatteringModel Model>
    Bsdf(Vec3 ng, const Frame& shading, const Seen& from, const Model& model) noexcept
        : shading_(shading),
          ng_(ng),
          local_wo_(from.local_wo),
          model_(std::in_place_type<Model>, model)
    {
        const Cosines cosines{from.cosine, height(model, from.local_wo)};
        ratio_o_ = !cosines.agree() ? 0.0f : shading.z == ng ? flat : cosines.ratio();
    }

    void raise_wo() noexcept;
    /// Evaluates the model for a local direction with these cosines, which agree.
    template <typename Model>
    [[nodiscard]] BsdfEval eval_model(const Model& model, Vec3 local_wi, const Cosines& cosines,
                                      TransportMode mode) const noexcept;

    static constexpr float flat = -1.0f;    ///< `ratio_o_` where both ratios are exactly one
    static constexpr float raised = -2.0f;  ///< `ratio_o_` where `local_wo_` has been raised

    Frame shading_;
    Vec3 ng_{0.0f, 0.0f, 1.0f};
    Vec3 local_wo_{0.0f};
    /// wo.ng / wo.ns, positive; `flat` if the normals are equal; 0 if the signs differ, so that
    /// nothing scatters; `raised` if the lens sees it nevertheless.
    float ratio_o_ = 0.0f;
    AnyModel model_;
};

}  // namespace bdpt
