#pragma once

#include "geometry/embree_scene.h"

#include <bdpt/scene_desc.h>

#include <memory>
#include <utility>
#include <vector>

namespace bdpt::test {

/// Meshes as rays meet them, moving where they do.
struct Traced {
    explicit Traced(SceneDesc d) : desc(std::move(d))
    {
        for (const InstanceDesc& instance : desc.instances) {
            placed.emplace_back(desc.meshes[static_cast<std::size_t>(instance.mesh)], instance);
        }
        embree = std::make_unique<EmbreeScene>(desc.instances, placed, desc.meshes.size());
    }

    SceneDesc desc;
    std::vector<PlacedMesh> placed;
    std::unique_ptr<EmbreeScene> embree;
};

}  // namespace bdpt::test
