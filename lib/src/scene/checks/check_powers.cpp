#include "scene/checks/check_powers.h"

#include "scene/checks/value_checks.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <variant>

namespace bdpt {
namespace {

float greatest_channel(Rgb value)
{
    return std::max({value.r, value.g, value.b});
}

/// A NaN, as it comes from products of infinity and zero, is too great, too.
bool is_too_great(Rgb power)
{
    return !(power.r <= greatest_light_power && power.g <= greatest_light_power &&
             power.b <= greatest_light_power);
}

}  // namespace

void check_powers(const SharedSceneDesc& desc, std::span<const MaterialId> material_ids,
                  std::span<const Material> materials, const LightSet& lights)
{
    std::uint32_t number = 0;
    for (std::uint32_t i = 0; i < desc.instances.size(); ++i) {
        const InstanceDesc& instance = desc.instances[i];
        if (!lights.of_triangle(i, 0)) {
            continue;
        }
        const std::size_t triangles =
            desc.meshes[static_cast<std::size_t>(instance.mesh)].triangles.size();
        for (std::size_t t = 0; t < triangles; ++t, ++number) {
            const Rgb power = lights[LightId{number}].power();
            if (is_too_great(power)) {
                const Material& material = materials[static_cast<std::size_t>(material_ids[i])];
                fail(label("instance", i, instance.name), ": triangle ", t, " with an emission of ",
                     greatest_channel(material.mean_emission()), " nit shines with ",
                     greatest_channel(power), " lm, but ", greatest_light_power, " lm is the most");
            }
        }
    }
    for (std::size_t i = 0; i < desc.lights.size(); ++i, ++number) {
        const Rgb power = lights[LightId{number}].power();
        if (is_too_great(power)) {
            const std::string item = std::visit(
                [i](const auto& light) { return light_label(light, i); }, desc.lights[i]);
            fail(item, ": shines with ", greatest_channel(power), " lm, but ", greatest_light_power,
                 " lm is the most");
        }
    }
}

}  // namespace bdpt
