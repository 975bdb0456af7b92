#pragma once

#include "material/models/scattering_model.h"

namespace bdpt {

/// Scatters nothing. Its base colour is for AOVs only.
class Black {
public:
    Black() = default;
    explicit Black(Rgb base_color) : base_color_(base_color) {}

    [[nodiscard]] BsdfEval eval(Vec3, Vec3, TransportMode) const noexcept { return {}; }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3, float, Vec2, TransportMode) const noexcept
    {
        return std::nullopt;
    }
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return false; }
    [[nodiscard]] bool transmits() const noexcept { return false; }
    [[nodiscard]] Rgb base_color() const noexcept { return base_color_; }

private:
    Rgb base_color_{0.0f};
};

static_assert(ScatteringModel<Black>);

}  // namespace bdpt
