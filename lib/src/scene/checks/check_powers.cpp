#include "scene/checks/validate.h"

#include "scene/checks/value_checks.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <variant>

namespace bdpt {
namespace {

float max_channel(Rgb value)
{
    return std::max({value.r, value.g, value.b});
}

/// Tests whether a power exceeds the limit; a NaN, the product of infinity and zero, does, too.
bool is_too_great(Rgb power)
{
    return !(power.r <= max_light_power && power.g <= max_light_power &&
             power.b <= max_light_power);
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
                     max_channel(material.mean_emission()), " nit shines with ", max_channel(power),
                     " lm, but ", max_light_power, " lm is the most");
            }
        }
    }
    for (std::size_t i = 0; i < desc.lights.size(); ++i, ++number) {
        const Rgb power = lights[LightId{number}].power();
        if (is_too_great(power)) {
            const std::string item = std::visit(
                [i](const auto& light) { return light_label(light, i); }, desc.lights[i]);
            fail(item, ": shines with ", max_channel(power), " lm, but ", max_light_power,
                 " lm is the most");
        }
    }
}

}  // namespace bdpt
