#pragma once

#include "scene_builder.h"

#include <bdpt/scene.h>

#include <cstddef>
#include <utility>

namespace bdpt::test {

/// Returns the inside of a sphere of radius 1 around the origin with uniform emission and albedo.
/// As in any closed surface, paths of k edges contribute emitted * albedo^(k - 1); and in a sphere
/// all connections are nearly as bright, so each strategy has little noise.
inline Scene furnace_sphere(Rgb emitted, Rgb albedo)
{
    SceneBuilder builder;
    const MeshId sphere = builder.sphere_mesh(16);
    MeshDesc& mesh = builder.desc.meshes[static_cast<std::size_t>(sphere)];
    mesh.normals.clear();
    for (UVec3& triangle : mesh.triangles) {
        std::swap(triangle.y, triangle.z);  // the front is inside
    }
    builder.place(sphere, emitter(emitted, albedo), Mat4(1.0f));
    return Scene(std::move(builder.desc));
}

}  // namespace bdpt::test
