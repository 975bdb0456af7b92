#include "scene/light_set.h"

#include "math/rgb.h"

#include <type_traits>

namespace bdpt {
namespace {

Light make_light(const LightDesc& desc, const BoundingSphere& bounds)
{
    return std::visit(
        [&bounds](const auto& d) {
            using T = std::decay_t<decltype(d)>;
            if constexpr (std::is_same_v<T, DirectionalLightDesc>) {
                return Light(DirectionalLight(d, bounds));
            } else if constexpr (std::is_same_v<T, EnvironmentLightDesc>) {
                return Light(EnvironmentLight(d, bounds));
            } else {
                return Light(PunctualLight(d));
            }
        },
        desc);
}

AliasTable powers(const std::vector<Light>& lights)
{
    std::vector<float> luminances;
    luminances.reserve(lights.size());
    for (const Light& light : lights) {
        luminances.push_back(luminance(light.power()));
    }
    return AliasTable(luminances);
}

}  // namespace

LightSet::LightSet(std::span<const InstanceDesc> instances, std::span<const PlacedMesh> placed,
                   std::span<const Material> materials, std::span<const LightDesc> lights,
                   const BoundingSphere& bounds)
    : first_of_instance_(instances.size())
{
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const Material& material = materials[static_cast<std::size_t>(instances[i].material)];
        if (is_black(material.mean_emission())) {
            continue;
        }
        first_of_instance_[i] = static_cast<std::uint32_t>(lights_.size());
        for (std::uint32_t t = 0; t < placed[i].triangle_count(); ++t) {
            lights_.emplace_back(TriangleLight(placed[i], material, t));
        }
    }
    for (const LightDesc& desc : lights) {
        if (std::holds_alternative<EnvironmentLightDesc>(desc)) {
            environment_ = LightId{static_cast<std::uint32_t>(lights_.size())};
        }
        lights_.push_back(make_light(desc, bounds));
    }
    by_power_ = powers(lights_);
}

std::optional<LightSet::Choice> LightSet::choose_for_emission(Vec2 u) const
{
    if (by_power_.empty()) {
        return std::nullopt;
    }
    const auto choice = by_power_.sample(fine_uniform(u));
    return Choice{.id = LightId{choice.index}, .probability = choice.probability};
}

float LightSet::emission_probability(LightId id) const
{
    return by_power_.probability(static_cast<std::uint32_t>(id));
}

std::optional<LightSet::Choice> LightSet::choose_for_receiver(Vec3 /*receiver*/, Vec2 u) const
{
    return choose_for_emission(u);
}

float LightSet::receiver_probability(LightId id, Vec3 /*receiver*/) const
{
    return emission_probability(id);
}

std::optional<LightId> LightSet::of_triangle(std::uint32_t instance, std::uint32_t triangle) const
{
    const auto& first = first_of_instance_[instance];
    if (!first) {
        return std::nullopt;
    }
    return LightId{*first + triangle};
}

}  // namespace bdpt
