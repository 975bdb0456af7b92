#pragma once

#include "material/models/scattering_model.h"

namespace bdpt {

/// A model and values that depend on wo alone, computed once for all connections of a path vertex.
/// All calls must use that wo.
template <typename Model>
class SeenFrom {
public:
    SeenFrom(const Model& model, Vec3 wo) noexcept : model_(model), from_(model.side(wo.z)) {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
    {
        return model_.eval(from_, wo, wi, mode);
    }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
    {
        return model_.sample(from_, wo, u_lobe, u, mode);
    }
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return model_.has_smooth_lobe(); }
    [[nodiscard]] bool transmits() const noexcept { return model_.transmits(); }
    [[nodiscard]] Rgb base_color() const noexcept { return model_.base_color(); }

    /// Changes wo, and computes these values again.
    void move_to(Vec3 wo) noexcept { from_ = model_.side(wo.z); }

private:
    Model model_;
    typename Model::Side from_;
};

}  // namespace bdpt
