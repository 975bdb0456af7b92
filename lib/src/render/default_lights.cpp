#include <bdpt/default_lights.h>

#include <bdpt/light/light_meter.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <variant>
#include <vector>

namespace bdpt {
namespace {

double mean(const std::vector<double>& cards)
{
    return std::accumulate(cards.begin(), cards.end(), 0.0) / static_cast<double>(cards.size());
}

double median(std::vector<double> cards)
{
    const auto middle = cards.begin() + static_cast<std::ptrdiff_t>(cards.size() / 2);
    std::nth_element(cards.begin(), middle, cards.end());
    return *middle;
}

constexpr float metered_aspect = 16.0f / 9.0f;

/// Tests with few paths whether cards show so much more than `least` [nit] that more paths need not
/// be traced. Uses the median, which few paths make too low rather than too high: most of their
/// noise is in a few bright cards.
bool is_clearly_lit(double least, const Scene& scene, const FramedView& framed)
{
    constexpr double margin = 3.0;
    const std::vector<double> cards =
        white_cards(scene, framed.camera, {.aspect = metered_aspect, .paths = 2});
    return !cards.empty() && median(cards) >= margin * least;
}

/// Tests whether emissive surfaces illuminate the framed view when nothing else does.
bool is_lit_by_emitters(const Scene& scene, const FramedView& framed)
{
    // Relative to the 1 nit that the default sky or lamp would give white cards [nit]. Scenes
    // designed around their emitters are well above, models with glowing details well below: tuned
    // on both kinds (docs/decisions/0059-light-of-scenes-without-lights.md).
    constexpr double min_outside = 0.03;
    constexpr double min_inside = 0.001;
    const double least = framed.enclosed ? min_inside : min_outside;
    if (is_clearly_lit(least, scene, framed)) {
        return true;
    }
    const std::vector<double> cards = white_cards(scene, framed.camera, {.aspect = metered_aspect});
    if (cards.empty()) {
        return false;
    }
    // Uses the mean in rooms, which may be dark except for a beam of light.
    return (framed.enclosed ? mean(cards) : median(cards)) >= least;
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

PointLightDesc default_lamp(const FramedView& view)
{
    // Keeps the lamp lit if the camera is at its position.
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

FramedView metered_view(const Scene& scene)
{
    return frame_scene(scene, metered_aspect);
}

DefaultLights missing_lights(const Scene& scene, const FramedView& framed)
{
    if (!scene.description().lights.empty() ||
        (scene.counts().emissive_triangles > 0 && is_lit_by_emitters(scene, framed))) {
        return DefaultLights::none;
    }
    return framed.enclosed ? DefaultLights::sky_and_lamp
           : framed.room   ? DefaultLights::sky
                           : DefaultLights::object;
}

std::vector<LightDesc> default_lights(DefaultLights missing, const FramedView& framed)
{
    std::vector<LightDesc> lights;
    if (missing == DefaultLights::object) {
        lights.emplace_back(object_environment());
    } else if (missing != DefaultLights::none) {
        lights.emplace_back(default_environment());
    }
    if (missing == DefaultLights::sky_and_lamp) {
        lights.emplace_back(default_lamp(framed));
    }
    return lights;
}

DefaultLights add_default_lights(SceneDesc& desc)
{
    if (!desc.lights.empty()) {
        return DefaultLights::none;
    }
    const Scene scene(desc);
    const FramedView framed = metered_view(scene);
    const DefaultLights missing = missing_lights(scene, framed);
    desc.lights = default_lights(missing, framed);
    return missing;
}

}  // namespace bdpt
