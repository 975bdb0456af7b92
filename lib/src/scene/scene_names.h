#pragma once

#include "geometry/ray.h"

#include <bdpt/aov.h>
#include <bdpt/film/id_film.h>
#include <bdpt/shared_scene_desc.h>

#include <string>
#include <vector>

namespace bdpt {

/// Names of a scene's surfaces, for id images. Objects are instances, and the spheres of lights;
/// those with the same name are one object. Unnamed ones are called "instance_3", "material_3" or
/// "light_3" by their index in the description. The sphere of a light has no material: the light's
/// name also names its material. Instances and spheres whose name others have, too, are numbered in
/// their order: "leaf.1", "leaf.2"; a number that makes the name of another one is left out.
class SceneNames {
public:
    explicit SceneNames(const SharedSceneDesc& desc);

    /// Returns the names of the kinds that `aovs` request, sorted, without duplicates. Throws
    /// `Error` (invalid_input) if the text exceeds the limit of parts of renders.
    [[nodiscard]] IdNames names(AovSet aovs) const;
    [[nodiscard]] SurfaceIds surface_ids(const RayHit& hit) const noexcept
    {
        return hit.sphere != no_sphere ? spheres_[hit.sphere] : instances_[hit.instance];
    }
    /// Returns the ids of all instances, then of all spheres: they determine which ids an image
    /// has.
    [[nodiscard]] std::vector<NameId> ids(IdKind kind) const;

private:
    std::vector<std::string> objects_;    // names of instances, then of spheres
    std::vector<std::string> materials_;  // names of materials, then of spheres
    std::vector<std::string> own_names_;  // unique names of instances, then of spheres
    std::vector<SurfaceIds> instances_;
    std::vector<SurfaceIds> spheres_;
};

}  // namespace bdpt
