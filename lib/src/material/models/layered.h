#pragma once

#include "material/layers.h"
#include "material/lobes/coat.h"
#include "material/lobes/sheen.h"
#include "material/models/metallic_roughness.h"
#include "material/models/scattering_model.h"

#include <glm/common.hpp>

#include <cmath>
#include <optional>

namespace bdpt {

/// Layers over the glTF material model: KHR_materials_{clearcoat, sheen}, and a base with
/// KHR_materials_{anisotropy, diffuse_roughness, diffuse_transmission, iridescence}. Directions as in all models; +x
/// is the rougher direction. Layers cover the outside of solid bodies, and both sides of all other
/// surfaces.
///
/// Everything below a layer is multiplied by min(T(wo), T(wi)), where T is the fraction that the
/// layer does not reflect: so no energy is created, and the model is reciprocal. That is the rule
/// that KHR_materials_sheen gives for its layer. The energy that a base below a coat loses by it is
/// restored as diffuse light (`CoatInterreflection`).
class LayeredBsdf {
public:
    explicit LayeredBsdf(const LayeredParameters& parameters);

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    /// `u_lobe` and `u` are uniform in [0, 1).
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    /// Tests whether it has a lobe that is not delta.
    [[nodiscard]] bool has_smooth_lobe() const noexcept;
    /// Returns the approximate albedo of the base, > 0.
    [[nodiscard]] float base_weight() const noexcept { return base_weight_; }
    /// Returns the light that a coat on top reflects back.
    [[nodiscard]] CoatInterreflection interreflection(const Coat& coat,
                                                      const CoatLoss* loss) const noexcept
    {
        return coat.interreflection(base_.coated(), loss);
    }
    /// Returns the fraction of light from a direction with this z, on a covered side, that is lost
    /// without it.
    [[nodiscard]] float lost(const CoatInterreflection& again, float z) const noexcept
    {
        return lost(again, z, base_.side(z));
    }

private:
    /// Values that depend on one direction alone.
    struct Side {
        LayerBase::Side base;
        // Probabilities of the lobes.
        float coat_choice = 0.0f;
        float sheen_choice = 0.0f;
        float base_choice = 1.0f;
        float again_choice = 0.0f;
        float lost = 0.0f;  ///< fraction of light between coat and base
        // Fraction of light that remains below each layer.
        float below_coat = 1.0f;
        float below_sheen = 1.0f;
    };

    [[nodiscard]] Side side(Vec3 w) const noexcept;
    [[nodiscard]] float lost(const CoatInterreflection& again, float z,
                             const LayerBase::Side& base) const noexcept
    {
        return again.lost(std::abs(z), {base.base_transmitted, base_.metal_unreflected(z)});
    }
    [[nodiscard]] bool is_covered(Vec3 w) const noexcept { return !solid_ || w.z > 0.0f; }
    [[nodiscard]] BsdfEval eval_lobes(const Side& from, Vec3 wo, Vec3 wi,
                                      TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample_coat(const Side& from, Vec3 wo, float u_lobe,
                                                        Vec2 u, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample_base(const Side& from, Vec3 wo, float u_lobe,
                                                        Vec2 u, TransportMode mode) const noexcept;

    LayerBase base_;
    Coat coat_;
    Sheen sheen_;
    CoatInterreflection again_;
    float base_weight_;
    bool solid_;
};

/// A surface with layers, stored as its parameters: `LayeredBsdf` is constructed at each call, so
/// that layers, which are rare, do not enlarge all path vertices.
class Layered {
public:
    explicit Layered(const LayeredParameters& parameters) : parameters_(parameters) {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    [[nodiscard]] bool has_smooth_lobe() const noexcept;
    [[nodiscard]] bool transmits() const noexcept
    {
        return parameters_.transmission > 0.0f || parameters_.diffuse_transmission.value() > 0.0f;
    }
    [[nodiscard]] Rgb base_color() const noexcept
    {
        return glm::clamp(parameters_.base_color, 0.0f, 1.0f);
    }
    [[nodiscard]] const LayeredParameters& parameters() const noexcept { return parameters_; }

private:
    LayeredParameters parameters_;
};

static_assert(ScatteringModel<Layered>);

}  // namespace bdpt
