#pragma once

#include "material/layers.h"
#include "material/models/scattering_model.h"

#include <glm/common.hpp>

namespace bdpt {

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
