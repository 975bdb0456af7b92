#pragma once

#include "geometry/placed_mesh.h"
#include "light/triangle_light.h"
#include "material/material.h"

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace bdpt {

/// Returns the maximum number of samples of its emission texture that a triangle may take along
/// each side, so that the total time stays around a second. `placed[i]` has material
/// `material_ids[i]`.
[[nodiscard]] int max_emission_samples(std::span<const MaterialId> material_ids,
                                       std::span<const PlacedMesh> placed,
                                       std::span<const Material> materials);

/// Emission of the emissive triangles of a scene. It depends on textures and vertex colours, not on
/// transforms, so a mesh with many instances is measured once for each of its materials.
class MeasuredEmission {
public:
    MeasuredEmission(std::span<const MaterialId> material_ids, std::span<const PlacedMesh> placed,
                     std::span<const Material> materials);

    /// Returns the emission of a triangle of an emissive instance.
    [[nodiscard]] const TriangleEmission& of(std::size_t instance, std::uint32_t triangle) const
    {
        return (*of_instance_[instance])[triangle];
    }

private:
    using Key = std::pair<const MeshDesc*, MaterialId>;

    std::map<Key, std::vector<TriangleEmission>> measured_;
    std::vector<const std::vector<TriangleEmission>*>
        of_instance_;  // one per instance; null: not emissive
};

}  // namespace bdpt
