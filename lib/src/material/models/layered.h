#pragma once

#include "material/layers.h"
#include "material/lobes/coat.h"
#include "material/lobes/fuzz.h"
#include "material/models/layer_over.h"
#include "material/models/metallic_roughness.h"
#include "material/models/scattering_model.h"
#include "material/tilted_facet.h"

#include <glm/common.hpp>

#include <optional>

namespace bdpt {

/// What is below all layers: the glTF material model with KHR_materials_{anisotropy,
/// diffuse_roughness, diffuse_transmission, iridescence}. Directions as in all models; +x is the
/// rougher direction.
class LowestLayer {
public:
    using Side = LayerBase::Side;

    explicit LowestLayer(const LayeredParameters& parameters);

    [[nodiscard]] Side side(Vec3 w) const noexcept { return base_.side(w.z); }
    [[nodiscard]] float weight(const Side&) const noexcept { return weight_; }
    [[nodiscard]] BsdfEval eval(const Side& from, const Side& to, Vec3 wo, Vec3 wi,
                                TransportMode mode) const noexcept
    {
        return base_.eval(from, to, wo, wi, mode);
    }
    [[nodiscard]] std::optional<BsdfSample> direct(const Side& from, Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
    {
        return base_.direct(from, wo, u_lobe, u, mode);
    }
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return base_.has_smooth_lobe(); }
    [[nodiscard]] CoveredBase covered_base() const noexcept { return base_.covered(); }
    [[nodiscard]] float lost(const ReturnedLight& again, float z, const Side& side) const noexcept
    {
        return again.lost(std::abs(z), {side.base_transmitted, base_.metal_unreflected(z)});
    }
    [[nodiscard]] float average_lost(const ReturnedLight& again) const noexcept
    {
        return again.average_lost();
    }

private:
    LayerBase base_;
    float weight_;  ///< approximate albedo, > 0
};

using FuzzyBase = LayerOver<Fuzz, LowestLayer, SameFrame>;

/// A surface of several layers: fibres, a coat, fibres below it, and the base.
class LayeredBsdf : public LayerOver<Fuzz, LayerOver<Coat, FuzzyBase, SameFrame>, SameFrame> {
public:
    explicit LayeredBsdf(const LayeredParameters& parameters);
};

/// Fibres and base on the facet of a normal map (`MappedBsdf`), below a coat.
class LowestFacet {
public:
    struct Side {};

    LowestFacet(const TiltedFacet& facet, const LayeredParameters& parameters);

    [[nodiscard]] Side side(Vec3) const noexcept { return {}; }
    [[nodiscard]] float weight(const Side&) const noexcept { return weight_; }
    [[nodiscard]] BsdfEval eval(const Side&, const Side&, Vec3 wo, Vec3 wi,
                                TransportMode mode) const noexcept
    {
        return MappedBsdf(facet_, base_, color_).eval(wo, wi, mode);
    }
    [[nodiscard]] std::optional<BsdfSample> direct(const Side&, Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
    {
        return MappedBsdf(facet_, base_, color_).sample(wo, u_lobe, u, mode);
    }
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return base_.has_smooth_lobe(); }
    [[nodiscard]] CoveredBase covered_base() const noexcept { return base_.covered_base(); }
    /// As if there were no normal map.
    [[nodiscard]] float lost(const ReturnedLight& again, float z, const Side&) const noexcept;
    [[nodiscard]] float average_lost(const ReturnedLight& again) const noexcept
    {
        return base_.average_lost(again);
    }

private:
    TiltedFacet facet_;
    FuzzyBase base_;
    Rgb color_;
    float weight_;
};

/// Layers over the facet of a normal map. A coat follows the surface, ignoring the map of the base,
/// or has a map of its own, and fibres on the coat follow the surface; the other layers follow the
/// facet. Directions are local to the facet.
class LayeredFacet : public LayerOver<Fuzz, LayerOver<Coat, LowestFacet, Frame>, Frame> {
public:
    LayeredFacet(const TiltedFacet& facet, const LayeredParameters& parameters);

private:
    LayeredFacet(const TiltedFacet& facet, const Frame& surface,
                 const LayeredParameters& parameters);
};

/// A surface with layers, stored as its parameters, so that layers, which are rare, do not enlarge
/// all path vertices: each thread keeps the `LayeredBsdf`s that it made last.
class Layered {
public:
    explicit Layered(const LayeredParameters& parameters) : parameters_(parameters) {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    [[nodiscard]] bool has_smooth_lobe() const noexcept;
    [[nodiscard]] bool transmits() const noexcept
    {
        return parameters_.transmission.value() > 0.0f ||
               parameters_.diffuse_transmission.value() > 0.0f;
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
