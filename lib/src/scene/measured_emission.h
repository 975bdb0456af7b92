#pragma once

#include "geometry/placed_mesh.h"
#include "light/triangle_emission.h"
#include "material/material.h"

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace bdpt {

/// How many samples of its emission texture a triangle may take along each side, so that all
/// together stay in the range of a second. `placed[i]` is of material `material_ids[i]`.
[[nodiscard]] int max_emission_samples(std::span<const MaterialId> material_ids,
                                       std::span<const PlacedMesh> placed,
                                       std::span<const Material> materials);

/// What the emissive triangles of a scene emit. It depends on textures and vertex colours, not on
/// places, so a mesh that is placed often is measured once for each of its materials.
class MeasuredEmission {
public:
    MeasuredEmission(std::span<const MaterialId> material_ids, std::span<const PlacedMesh> placed,
                     std::span<const Material> materials);

    /// Of an instance that emits.
    [[nodiscard]] const TriangleEmission& of(std::size_t instance, std::uint32_t triangle) const
    {
        return (*of_instance_[instance])[triangle];
    }

private:
    using Key = std::pair<const MeshDesc*, MaterialId>;

    std::map<Key, std::vector<TriangleEmission>> measured_;
    std::vector<const std::vector<TriangleEmission>*> of_instance_;  // null: emits nothing
};

}  // namespace bdpt
