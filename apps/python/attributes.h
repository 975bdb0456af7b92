#pragma once

#include <bdpt/light_desc.h>
#include <bdpt/scene_desc.h>
#include <bdpt/types.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace bdpt::python {

using Three = std::array<float, 3>;
using Four = std::array<float, 4>;

inline Vec3 to_vec(const Three& values)
{
    return {values[0], values[1], values[2]};
}

inline Vec4 to_vec(const Four& values)
{
    return {values[0], values[1], values[2], values[3]};
}

/// Constructs an object and sets the attributes named by keyword arguments.
template <typename T>
void construct(nanobind::pointer_and_handle<T> self, const nanobind::kwargs& values)
{
    new (self.p) T();
    nanobind::inst_mark_ready(self.h);
    for (const auto& [name, value] : values) {
        nanobind::setattr(self.h, name, value);
    }
}

/// Defines an attribute of three or four numbers.
template <typename T, typename Class>
void def_vec(Class& type, const char* name, T member, const char* text)
{
    using Owner = typename Class::Type;
    using Value = std::remove_reference_t<decltype(std::declval<Owner&>().*member)>;
    using Array = std::array<float, static_cast<std::size_t>(Value::length())>;
    type.def_prop_rw(
        name,
        [member](const Owner& owner) {
            Array array{};
            for (int i = 0; i < Value::length(); ++i) {
                array[static_cast<std::size_t>(i)] = (owner.*member)[i];
            }
            return array;
        },
        [member](Owner& owner, const Array& values) { owner.*member = to_vec(values); }, text);
}

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

/// A material with its textures by slot.
struct ArrayMaterial {
    MaterialDesc desc;
    std::map<std::string, TexelImage> textures;
};

/// Returns the material for `scene`, to whose images its textures are added.
[[nodiscard]] MaterialDesc with_textures(const ArrayMaterial& material, SceneDesc& scene);

}  // namespace bdpt::python
