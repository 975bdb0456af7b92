#pragma once

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <vector>

#include "ray_recorder.h"

namespace bdpt {

/// All triangles of a scene, each of which is tested against each ray: the baseline of a BVH.
/// Spheres, alpha and motion are ignored.
class AllTriangles {
public:
    explicit AllTriangles(const SceneDesc& scene);

    [[nodiscard]] std::size_t size() const { return triangles_.size(); }

    /// Tests whether the ray hits a triangle. For a closest-hit query all triangles are tested
    /// [Moeller and Trumbore 1997].
    [[nodiscard]] bool is_hit_by(const RecordedRay& ray) const;

private:
    struct Triangle {
        Vec3 corner;
        Vec3 edge1;
        Vec3 edge2;
    };

    std::vector<Triangle> triangles_;  // in world space
};

}  // namespace bdpt
