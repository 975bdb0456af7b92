#pragma once

#include "material/lobes/coat.h"
#include "material/models/layered.h"
#include "material/tilted_facet.h"
#include "math/frame.h"

#include <optional>

namespace bdpt {

/// Layers over the facet of a normal map, as in `MappedBsdf`. A coat follows the surface, ignoring
/// the map of the base, or has a map of its own; the other layers follow the facet. Directions are
/// local to the facet.
class CoatedFacet {
public:
    CoatedFacet(const TiltedFacet& facet, const LayeredParameters& parameters);

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    /// `u_lobe` and `u` are uniform in [0, 1).
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;

private:
    /// A direction in the frame of the surface, seen from the side of the coat, and values derived
    /// from it.
    struct Side {
        Vec3 w{0.0f};
        bool above = true;
        bool covered = true;
        float below_coat = 1.0f;  ///< fraction of light that the coat transmits
        float lost = 0.0f;        ///< fraction of light between coat and facet
        // Probabilities of the lobes.
        float coat_choice = 0.0f;
        float again_choice = 0.0f;

        [[nodiscard]] float below_choice() const { return 1.0f - coat_choice - again_choice; }
    };

    [[nodiscard]] Vec3 local_coat_normal(Vec3 normal) const;
    [[nodiscard]] Side side(Vec3 w) const noexcept;
    [[nodiscard]] Vec3 from_surface(Vec3 w, bool above) const
    {
        return surface_.to_world(above ? w : -w);
    }
    [[nodiscard]] BsdfEval eval_lobes(const Side& from, Vec3 wo, Vec3 wi,
                                      TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample_coat(const Side& from, float u_lobe, Vec2 u,
                                                        TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample_below(const Side& from, Vec3 wo, float u_lobe,
                                                         Vec2 u, TransportMode mode) const noexcept;

    TiltedFacet facet_;
    Frame surface_;  ///< local to the facet
    LayeredBsdf below_;
    Coat coat_;
    CoatInterreflection again_;
    Rgb color_;
    bool solid_;
};

}  // namespace bdpt
