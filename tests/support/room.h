#pragma once

#include <bdpt/error.h>
#include <bdpt/scene.h>

#include "scene_builder.h"

#include <utility>
#include <vector>

namespace bdpt::test {

/// A small scene with what could depend on threads: coincident surfaces, glass, and a surface that
/// lets some rays pass.
inline Scene room(Isa isa = Isa::native)
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), plastic(Rgb(0.6f), 0.3f));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    // Two surfaces in the same place: which one is hit must not depend on the thread.
    builder.quad({-0.5f, -0.5f, 0.0f}, {0.5f, -0.5f, 0.0f}, {0.5f, 0.0f, 0.0f}, {-0.5f, 0.0f, 0.0f},
                 lambertian({0.8f, 0.1f, 0.1f}));
    builder.quad({-0.5f, -0.5f, 0.0f}, {0.5f, -0.5f, 0.0f}, {0.5f, 0.0f, 0.0f}, {-0.5f, 0.0f, 0.0f},
                 lambertian({0.1f, 0.1f, 0.8f}));
    builder.sphere({0.4f, -0.7f, 0.4f}, 0.3f, glass(0.0f), 16);
    // Which rays pass must not depend on it either, nor on what other rays did.
    MaterialDesc pane = plastic({0.2f, 0.7f, 0.3f}, 0.4f);
    pane.base_color.w = 0.4f;
    pane.alpha_mode = AlphaMode::blend;
    builder.sphere({-0.3f, 0.3f, 0.3f}, 0.5f, pane, 12);
    builder.light(PointLightDesc{.position = {-0.5f, 0.0f, 0.5f}, .intensity = Rgb(0.3f)});
    return Scene(std::move(builder.desc), isa);
}

/// All that can be pinned here, the least one first.
inline std::vector<Isa> isas_of_this_cpu()
{
    std::vector<Isa> result;
    for (const Isa isa : all_isas) {
        try {
            const Scene scene(SceneDesc{}, isa);
            if (isa != Isa::native) {
                result.push_back(isa);
            }
        } catch (const Error& error) {
            if (error.code() != ErrorCode::usage) {
                throw;
            }
        }
    }
    return result;
}

}  // namespace bdpt::test
