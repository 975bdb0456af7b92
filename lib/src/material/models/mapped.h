#pragma once

#include "material/mapped_bsdf.h"
#include "material/models/layered.h"
#include "material/models/metallic_roughness.h"
#include "material/models/simple_models.h"
#include "material/small_numbers.h"

#include <glm/geometric.hpp>

namespace bdpt {

/// What a model on a facet keeps of wo: nothing, if it computes nothing of one direction alone.
template <typename Model>
struct SeenOnFacet {};
template <>
struct SeenOnFacet<MetallicRoughness> {
    MappedBsdf<MetallicRoughness>::Sides sides{};
};

/// A model on the facet of a normal map (`MappedBsdf`), whose normal is +z; a coat follows the
/// surface or has a map of its own (`LayeredFacet`). Keeps what depends on wo alone, as `SeenFrom`
/// does, for walks from the eye.
template <ScatteringModel Model>
class Mapped {
public:
    /// `ns`, local, is the unit normal of the surface without the map, above the facet. All calls
    /// must use this `wo`.
    Mapped(const Model& model, Vec3 ns, Vec3 wo) noexcept : model_(model), ns_(ns) { move_to(wo); }

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return model_.has_smooth_lobe(); }
    [[nodiscard]] bool transmits() const noexcept { return model_.transmits(); }
    [[nodiscard]] Rgb base_color() const noexcept { return model_.base_color(); }
    /// Returns the normal of the surface without the map.
    [[nodiscard]] Vec3 normal() const noexcept { return ns_.value(); }
    /// Returns the cosine to it.
    [[nodiscard]] float height(Vec3 w) const noexcept { return dot(w, ns_.value()); }
    /// Changes wo, and computes these values again.
    void move_to(Vec3 wo) noexcept;

private:
    Model model_;
    Direction16 ns_;
    [[no_unique_address]] SeenOnFacet<Model> seen_;
};

extern template class Mapped<Lambertian>;
extern template class Mapped<MetallicRoughness>;
extern template class Mapped<Layered>;

static_assert(ScatteringModel<Mapped<Lambertian>>);

}  // namespace bdpt
