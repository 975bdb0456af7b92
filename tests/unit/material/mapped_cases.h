#pragma once

#include "bsdf_cases.h"
#include "math/frame.h"

#include <cmath>
#include <vector>

namespace bdpt::test {

/// A surface of normal +z whose normal map leans by an angle [rad], in no special direction; both
/// walks over it.
class MappedSurface {
public:
    MappedSurface(const BsdfCase& tested, float lean, Vec3 ng = {0.0f, 0.0f, 1.0f})
        : model_(tested),
          ng_(ng),
          facet_(Frame::from_normal({std::sin(lean) * 0.8f, std::sin(lean) * 0.6f, std::cos(lean)}))
    {}

    [[nodiscard]] Bsdf seen_from(Vec3 wo) const
    {
        return model_.mapped(ng_, {0.0f, 0.0f, 1.0f}, facet_, wo);
    }
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const
    {
        return seen_from(wo).eval(wi, mode);
    }
    /// The normal of the map.
    [[nodiscard]] Vec3 normal() const { return facet_.z; }
    [[nodiscard]] bool has_smooth_lobe() const { return model_.has_smooth_lobe(); }

private:
    TestedBsdf model_;
    Vec3 ng_;
    Frame facet_;
};

constexpr float degrees = 0.017453293f;

/// How far maps lean: 70 degrees are as much as real ones do.
[[nodiscard]] inline std::vector<float> leans()
{
    return {8.0f * degrees, 35.0f * degrees, 70.0f * degrees};
}

}  // namespace bdpt::test
