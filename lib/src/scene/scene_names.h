#pragma once

#include "geometry/ray.h"

#include <bdpt/aov.h>
#include <bdpt/film/id_film.h>
#include <bdpt/shared_scene_desc.h>

#include <string>
#include <vector>

namespace bdpt {

/// What the surfaces of a scene are called, for images of ids. Objects are instances, and the
/// spheres of lights; those of one name are one object. What has no name is "instance_3",
/// "material_3" or "light_3" by its place in the description. The sphere of a light has no
/// material: the light's name stands for that, too.
class SceneNames {
public:
    explicit SceneNames(const SharedSceneDesc& desc);

    /// Those of the kinds that `aovs` ask for, each once, sorted. Throws `Error` (invalid_input)
    /// for more text than parts of renders hold.
    [[nodiscard]] IdNames names(AovSet aovs) const;
    [[nodiscard]] SurfaceIds ids_of(const RayHit& hit) const noexcept
    {
        return hit.sphere != no_sphere ? spheres_[hit.sphere] : instances_[hit.instance];
    }
    /// Of all instances, then of all spheres: what decides which ids an image has.
    [[nodiscard]] std::vector<NameId> ids(IdKind kind) const;

private:
    std::vector<std::string> objects_;    // of instances, then of spheres
    std::vector<std::string> materials_;  // of materials, then of spheres
    std::vector<SurfaceIds> instances_;
    std::vector<SurfaceIds> spheres_;
};

}  // namespace bdpt
