// Measures the cost of edits of a scene of many triangles, against building it anew: wall-clock
// time.

#include <bdpt/default_lights.h>
#include <bdpt/framing.h>
#include <bdpt/scene.h>

#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "measure.h"

namespace {

using namespace bdpt;

/// Returns waves of 2 * side * side triangles.
MeshDesc waves(unsigned side)
{
    MeshDesc mesh;
    for (unsigned row = 0; row <= side; ++row) {
        for (unsigned column = 0; column <= side; ++column) {
            const float x = static_cast<float>(column) / static_cast<float>(side);
            const float z = static_cast<float>(row) / static_cast<float>(side);
            mesh.positions.emplace_back(x, 0.02f * std::sin(40.0f * x) * std::cos(30.0f * z), z);
        }
    }
    for (unsigned row = 0; row < side; ++row) {
        for (unsigned column = 0; column < side; ++column) {
            const unsigned a = row * (side + 1) + column;
            mesh.triangles.emplace_back(a, a + side + 1, a + 1);
            mesh.triangles.emplace_back(a + 1, a + side + 1, a + side + 2);
        }
    }
    return mesh;
}

InstanceDesc placed(const char* name, std::uint32_t mesh, std::uint32_t material, Vec3 place)
{
    InstanceDesc instance{.name = name, .mesh = MeshId{mesh}, .material = MaterialId{material}};
    instance.world_from_object[3] = Vec4(place, 1.0f);
    return instance;
}

/// Returns waves, and a quarter of their triangles instanced twice, under a sky and a point light.
SceneDesc large_scene(unsigned side)
{
    SceneDesc desc;
    desc.meshes = {waves(side), waves(side / 2)};
    desc.materials.resize(3);
    desc.materials[0].name = "water";
    desc.instances = {placed("sea", 0, 0, {0, 0, 0}), placed("left", 1, 1, {-2, 0, 0}),
                      placed("right", 1, 2, {2, 0, 0})};
    EnvironmentLightDesc sky;
    sky.radiance =
        Image{.width = 1024, .height = 512, .pixels = std::vector<Rgb>(1024 * 512, Rgb(1.0f))};
    desc.lights = {sky, PointLightDesc{.position = {0.5f, 1.0f, 0.5f}}};
    return desc;
}

struct Edit {
    const char* name;
    std::function<Scene(const Scene&)> make;
};

std::vector<Edit> edits()
{
    const auto material = [](const auto& change) {
        return [change](const Scene& scene) {
            MaterialDesc water = scene.description().materials[0];
            change(water);
            return scene.with("water", water);
        };
    };
    return {
        {"all anew", [](const Scene& scene) { return Scene(scene.description()); }},
        {"colour", material([](auto& m) {
             m.base_color = {0.1f, 0.2f, 0.9f, 1.0f};
         })},
        {"index of refraction", material([](auto& m) { m.ior = 1.33f; })},
        {"emission", material([](auto& m) { m.emission = Rgb(1.0f); })},
        {"alpha",
         material([](auto& m) { m.alpha_mode = AlphaMode::blend, m.base_color.w = 0.5f; })},
        {"lamp",
         [](const Scene& scene) {
             std::vector<LightDesc> lights = scene.description().lights;
             std::get<PointLightDesc>(lights[1]).intensity = Rgb(2.0f);
             return scene.with_lights(std::move(lights));
         }},
        {"sky turned",
         [](const Scene& scene) {
             const auto& sky = std::get<EnvironmentLightDesc>(scene.description().lights[0]);
             return scene.with_environment(turned(sky, 0.5f));
         }},
        {"instance moved",
         [](const Scene& scene) {
             return scene.with("left", placed("left", 1, 1, {-3, 0, 0}));
         }},
    };
}

}  // namespace

int main(int argc, char** argv)
{
    CLI::App app("What edits of a scene cost, in milliseconds.");
    unsigned side = 633;
    int rounds = 5;
    app.add_option("--side", side, "The scene has 2.5 N N triangles")->capture_default_str();
    app.add_option("--rounds", rounds, "Times that each is done")->capture_default_str();
    CLI11_PARSE(app, argc, argv);

    const Scene scene(large_scene(side));
    std::printf("%zu triangles\n", scene.counts().triangles);
    const std::vector<Edit> all = edits();
    const auto times = in_turn(all.size(), rounds, [&](std::size_t variant, int /*round*/) {
        const auto start = std::chrono::steady_clock::now();
        const Scene edited = all[variant].make(scene);
        const std::chrono::duration<double, std::milli> time =
            std::chrono::steady_clock::now() - start;
        return time.count();
    });
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::printf("%-20s %8.2f ms\n", all[i].name, median(times[i]));
    }
}
