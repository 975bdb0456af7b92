#pragma once

#include <bdpt/error.h>
#include <bdpt/render.h>

#include "scene_builder.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::test {

/// Returns a parallel camera that looks straight down at the square from -2 to 2 m in x (to the
/// right) and z (downwards), from y = 9 m.
inline CameraDesc camera_above()
{
    CameraDesc camera;
    camera.world_from_camera =
        Mat4(Vec4(1, 0, 0, 0), Vec4(0, 0, -1, 0), Vec4(0, 1, 0, 0), Vec4(0, 9, 0, 1));
    return in_parallel(camera, 4.0f);
}

/// Returns options for `side` x `side` pixels of a scene and its shadow on the ground at y = 0.
inline RenderOptions ground_options(int side, std::int64_t samples)
{
    RenderOptions result;
    result.integrator = IntegratorKind::pt;
    result.transport.max_depth = 1;
    result.transport.background = Background::none;
    result.film.width = side;
    result.film.height = side;
    result.film.aovs = {Aov::alpha, Aov::shadow};
    result.film.ground_height = 0.0f;
    result.sampling.samples = {.begin = 0, .end = samples};
    return result;
}

struct Shadow {
    std::vector<float> alpha;
    std::vector<float> opacity;
};

inline Shadow compute_shadow(const RenderResult& result)
{
    Shadow shadow;
    for (const Layer& layer : result.aovs.develop(result.film)) {
        if (layer.channels == "A") {
            (layer.name == "shadow" ? shadow.opacity : shadow.alpha) = layer.values;
        }
    }
    return shadow;
}

inline Shadow compute_shadow(SceneDesc scene, const CameraDesc& camera,
                             const RenderOptions& options)
{
    return compute_shadow(render(Scene(std::move(scene)), camera, options));
}

inline double compute_mean(const std::vector<float>& values)
{
    double sum = 0.0;
    for (const float value : values) {
        sum += static_cast<double>(value);
    }
    return sum / static_cast<double>(values.size());
}

inline EnvironmentLightDesc even_sky(Rgb radiance = Rgb(1.0f))
{
    return {.radiance = Image{.width = 1, .height = 1, .pixels = {radiance}}};
}

/// Returns a sky that is bright above and dark below, with a sun of one texel off centre.
inline EnvironmentLightDesc sunny_sky()
{
    Image image{32, 16, {}};
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            image.pixels.push_back(Rgb(y < 8 ? 1.0f + 0.1f * static_cast<float>(x % 7) : 0.2f));
        }
    }
    image.pixels[4 * 32 + 5] = Rgb(90.0f, 80.0f, 60.0f);
    return {.radiance = std::move(image)};
}

/// Returns a disk of `corners` corners that faces down, with its centre at height y.
inline MeshDesc disk_above(float y, float radius, int corners)
{
    MeshDesc mesh;
    mesh.positions.emplace_back(0.0f, y, 0.0f);
    for (int i = 0; i < corners; ++i) {
        const double angle = 2.0 * 3.14159265358979 * i / corners;
        mesh.positions.emplace_back(static_cast<double>(radius) * std::cos(angle), y,
                                    static_cast<double>(radius) * std::sin(angle));
        const auto here = static_cast<unsigned>(i + 1);
        const auto next = static_cast<unsigned>((i + 1) % corners + 1);
        mesh.triangles.emplace_back(0U, here, next);
    }
    return mesh;
}

}  // namespace bdpt::test
