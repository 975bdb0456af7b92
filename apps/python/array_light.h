#pragma once

#include <bdpt/light_desc.h>

#include <variant>
#include <vector>

namespace bdpt::python {

using ArrayLight =
    std::variant<PointLightDesc, SpotLightDesc, DirectionalLightDesc, EnvironmentLightDesc>;

/// Converts lights to those of scenes, which also have lights of files.
[[nodiscard]] inline std::vector<LightDesc> to_lights(const std::vector<ArrayLight>& lights)
{
    std::vector<LightDesc> result;
    for (const ArrayLight& light : lights) {
        std::visit([&result](const auto& desc) { result.emplace_back(desc); }, light);
    }
    return result;
}

}  // namespace bdpt::python
