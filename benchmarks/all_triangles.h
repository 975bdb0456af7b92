#pragma once

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <vector>

#include "ray_recorder.h"

namespace bdpt {

/// The triangles of a scene, each of which is asked whether a ray meets it: what a BVH is held
/// against. Spheres, alpha and motion are ignored.
class AllTriangles {
public:
    explicit AllTriangles(const SceneDesc& scene);

    [[nodiscard]] std::size_t size() const { return triangles_.size(); }

    /// Does the ray meet any? If it asks for the closest hit, all are tried [Moeller and Trumbore
    /// 1997].
    [[nodiscard]] bool is_hit_by(const RecordedRay& ray) const;

private:
    struct Triangle {
        Vec3 corner;
        Vec3 edge1;
        Vec3 edge2;
    };

    std::vector<Triangle> triangles_;  // in the world
};

}  // namespace bdpt
