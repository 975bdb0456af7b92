#include <bdpt/default_lights.h>

#include <bdpt/light/light_meter.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>
#include <variant>
#include <vector>

namespace bdpt {
namespace {

/// Do surfaces that emit light what is framed, when nothing else does?
bool is_lit_by_emitters(const Scene& scene, const FramedView& framed, float aspect)
{
    // Of the 1 nit that the default sky or lamp would give white cards [nit]. Scenes that were made
    // for their emitters are well above, models that glow here and there well below: found by
    // trying both kinds (docs/decisions/0059-light-of-scenes-without-lights.md).
    constexpr double least_outside = 0.03;
    constexpr double least_inside = 0.001;
    std::vector<double> cards = white_cards(scene, framed.camera, {.aspect = aspect});
    if (cards.empty()) {
        return false;
    }
    if (!framed.enclosed) {
        const auto middle = cards.begin() + static_cast<std::ptrdiff_t>(cards.size() / 2);
        std::nth_element(cards.begin(), middle, cards.end());
        return *middle >= least_outside;
    }
    // The mean, as a room may be dark but for a beam of light.
    const double sum = std::accumulate(cards.begin(), cards.end(), 0.0);
    return sum >= least_inside * static_cast<double>(cards.size());
}

}  // namespace

bool has_light(const SceneDesc& desc)
{
    return !desc.lights.empty() ||
           std::any_of(desc.instances.begin(), desc.instances.end(),
                       [&desc](const InstanceDesc& instance) {
                           const auto index = static_cast<std::size_t>(instance.material);
                           return index < desc.materials.size() &&
                                  desc.materials[index].emission != Rgb(0.0f);
                       });
}

bool has_surface(const SceneDesc& desc)
{
    const auto has_triangles = [&desc](const InstanceDesc& instance) {
        const auto index = static_cast<std::size_t>(instance.mesh);
        return index < desc.meshes.size() && !desc.meshes[index].triangles.empty();
    };
    const auto is_sphere = [](const LightDesc& light) {
        const auto* point = std::get_if<PointLightDesc>(&light);
        const auto* spot = std::get_if<SpotLightDesc>(&light);
        return (point != nullptr && point->radius > 0.0f) ||
               (spot != nullptr && spot->radius > 0.0f);
    };
    return std::any_of(desc.instances.begin(), desc.instances.end(), has_triangles) ||
           std::any_of(desc.lights.begin(), desc.lights.end(), is_sphere);
}

EnvironmentLightDesc default_environment()
{
    // Rows are 5.6 degrees high: the gradient shows no steps between interpolated texels.
    constexpr int height = 32;
    constexpr int width = 2;
    constexpr float ground = 0.5f;
    // The mean over the upper half of 1 + 2 sin(elevation) is 2, so that of all directions is 1
    // when the sky starts at 0.75 over the horizon: (0.5 + 0.75 * 2) / 2.
    constexpr float horizon = 0.75f;

    // Sine and cosine of the elevation of the first row, and of the angle between two rows. Turning
    // by them takes no sine of the C library, which may differ between machines.
    double sine = 0.99879545620517239;
    double cosine = 0.049067674327418015;
    constexpr double step_sine = 0.098017140329560602;
    constexpr double step_cosine = 0.99518472667219693;

    EnvironmentLightDesc result;
    result.radiance.width = width;
    result.radiance.height = height;
    for (int row = 0; row < height; ++row) {
        const float radiance =
            sine > 0.0 ? horizon * (1.0f + 2.0f * static_cast<float>(sine)) : ground;
        result.radiance.pixels.insert(result.radiance.pixels.end(), width, Rgb(radiance));
        const double before = sine;
        sine = sine * step_cosine - cosine * step_sine;
        cosine = cosine * step_cosine + before * step_sine;
    }
    return result;
}

PointLightDesc default_lamp(const FramedView& view)
{
    // Keeps the lamp lit when the camera stands in it.
    constexpr float shortest = 1e-3f;
    const Vec3 eye(view.camera.world_from_camera[3]);
    const float distance = std::max(glm::distance(eye, view.lamp_position), shortest);
    PointLightDesc result;
    result.name = "default lamp";
    result.position = view.lamp_position;
    // A white diffuse surface has the radiance I / (pi d^2).
    result.intensity = Rgb(std::numbers::pi_v<float> * distance * distance);
    return result;
}

DefaultLights missing_lights(const Scene& scene, const FramedView& framed, float aspect)
{
    if (!scene.description().lights.empty() ||
        (scene.counts().emissive_triangles > 0 && is_lit_by_emitters(scene, framed, aspect))) {
        return DefaultLights::none;
    }
    return framed.enclosed ? DefaultLights::sky_and_lamp : DefaultLights::sky;
}

DefaultLights add_default_lights(SceneDesc& desc, float aspect)
{
    if (!desc.lights.empty()) {
        return DefaultLights::none;
    }
    const Scene scene(desc);
    const FramedView framed = frame_scene(scene, aspect);
    const DefaultLights missing = missing_lights(scene, framed, aspect);
    if (missing != DefaultLights::none) {
        desc.lights.emplace_back(default_environment());
    }
    if (missing == DefaultLights::sky_and_lamp) {
        desc.lights.emplace_back(default_lamp(framed));
    }
    return missing;
}

}  // namespace bdpt
