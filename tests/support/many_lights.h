#pragma once

#include "scene_builder.h"
#include "statistics.h"

#include <cstdint>

namespace bdpt::test {

/// Returns `count` lights of all kinds with a position, at random in the cube [-1, 1]^3, of very
/// different power: one- and two-sided triangles, points, spots, and both as spheres.
inline SceneBuilder random_lights(std::uint64_t seed, int count)
{
    Random random(seed);
    const auto between = [&](float low, float high) { return low + (high - low) * random.next(); };
    // Compilers evaluate the arguments of one call in different orders.
    const auto place = [&] {
        const float z = between(-1, 1);
        const float y = between(-1, 1);
        return Vec3(between(-1, 1), y, z);
    };
    SceneBuilder builder;
    for (int i = 0; i < count; ++i) {
        const Rgb light(between(0.01f, 1.0f) * (i % 7 == 0 ? 50.0f : 1.0f));
        const float outer = between(0.05f, 1.5f);
        const float radius = i % 6 < 4 ? 0.0f : between(0.001f, 0.2f);
        if (i % 6 < 2) {
            MaterialDesc material = emitter(light);
            material.double_sided = i % 6 == 1;
            const Vec3 a = place();
            const float size = between(0.01f, 0.5f);
            MeshDesc mesh;
            mesh.positions = {a, a + size * random.direction(), a + size * random.direction()};
            mesh.triangles = {{0, 1, 2}};
            builder.place(builder.add_mesh(std::move(mesh)), material, Mat4(1.0f));
        } else if (i % 2 == 0) {
            builder.light(
                PointLightDesc{.position = place(), .intensity = light, .radius = radius});
        } else {
            builder.light(SpotLightDesc{.position = place(),
                                        .direction = random.direction(),
                                        .intensity = light,
                                        .inner_cone_angle = outer * between(0.0f, 0.99f),
                                        .outer_cone_angle = outer,
                                        .radius = radius});
        }
    }
    return builder;
}

}  // namespace bdpt::test
