#include "attributes.h"

#include <bdpt/error.h>
#include <fmt/core.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "arrays.h"
#include "python_scene.h"

namespace bdpt::python {

namespace nb = nanobind;

std::string attribute_name(std::string_view field)
{
    std::string name(field);
    const auto replace = [&name](std::string_view what, std::string_view with) {
        for (std::size_t at = name.find(what); at != std::string::npos; at = name.find(what)) {
            name.replace(at, what.size(), with);
        }
    };
    replace("colour", "color");
    replace("index of refraction", "ior");
    replace("-", "_");
    replace(" ", "_");
    return name;
}

std::string_view note_on(std::string_view attribute)
{
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 21> notes{{
        {"name", "Name in id layers"},
        {"base_color", "Linear RGB or RGBA"},
        {"alpha_mode", "'opaque', 'mask' or 'blend'"},
        {"unlit", "Emits its base colour [nit]"},
        {"roughness", "Perceptual roughness: its square is the GGX alpha"},
        {"emission", "Radiance [nit]"},
        {"double_sided", "Emits from both sides"},
        {"thickness", "Above 0: the mesh bounds a solid body; 0: a thin sheet"},
        {"attenuation_distance", "[m]"},
        {"attenuation_color", "Colour of white light after attenuation_distance"},
        {"dispersion", "20 / Abbe number"},
        {"anisotropy_rotation", "[rad] from the tangent to the bitangent"},
        {"iridescence_thickness_minimum", "[nm] where the texture is 0"},
        {"iridescence_thickness_maximum", "[nm] where the texture is 1, or without it"},
        {"position", "[m]"},
        {"direction", "Direction in which the light travels; of a spot light, its axis"},
        {"intensity", "[cd]; of a spot light, within the inner cone"},
        {"illuminance", "[lx] on a surface facing the light"},
        {"inner_cone_angle", "[rad] from the axis"},
        {"outer_cone_angle", "[rad] from the axis"},
        {"radius", "[m] 0: a point; else a sphere that is seen"},
    }};
    const auto* const note = std::find_if(
        notes.begin(), notes.end(), [attribute](const auto& of) { return of.first == attribute; });
    return note == notes.end() ? std::string_view() : note->second;
}

std::string limits_text(const Limits& limits)
{
    constexpr float largest = std::numeric_limits<float>::max();
    if (limits.high < largest) {
        return fmt::format("{} to {}", limits.low, limits.high);
    }
    if (limits.low <= -largest) {
        return "any number";
    }
    return fmt::format("{} {}", limits.low_is_excluded ? "above" : "at least", limits.low);
}

TexelImage to_texels(const nb::object& value)
{
    using TexelArray = nb::ndarray<nb::ro, nb::c_contig, nb::device::cpu>;
    const auto array = nb::cast<TexelArray>(nb::module_::import_("numpy").attr("asarray")(value));
    const auto type = array.dtype() == nb::dtype<std::uint8_t>()    ? TexelType::unorm8
                      : array.dtype() == nb::dtype<std::uint16_t>() ? TexelType::unorm16
                                                                    : TexelType::float32;
    if (type == TexelType::float32 && array.dtype() != nb::dtype<float>()) {
        throw CallError("a texture is an array of uint8, uint16 or float32");
    }
    constexpr std::size_t max_channels = 4;
    if (array.ndim() < 2 || array.ndim() > 3 ||
        (array.ndim() == 3 && array.shape(2) > max_channels)) {
        throw Error(ErrorCode::usage,
                    "a texture has the shape (height, width, channels), with 1 to 4 "
                    "channels, or (height, width)");
    }
    const auto* bytes = static_cast<const std::uint8_t*>(array.data());
    return {.width = to_side(array.shape(1)),
            .height = to_side(array.shape(0)),
            .bytes = std::vector<std::uint8_t>(bytes, bytes + array.nbytes()),
            .channels = array.ndim() == 3 ? static_cast<int>(array.shape(2)) : 1,
            .type = type};
}

std::string array_text(std::string_view type, std::initializer_list<std::size_t> shape)
{
    std::string sides;
    for (const std::size_t side : shape) {
        sides += fmt::format("{}{}", sides.empty() ? "" : ", ", side);
    }
    return fmt::format("<{} ({})>", type, sides);
}

MaterialDesc with_textures(const ArrayMaterial& material, SceneDesc& scene)
{
    MaterialDesc desc = material.desc;
    for_each_attribute<MaterialDesc>([&](const auto& field, const auto& access) {
        if constexpr (is_texture<std::remove_cvref_t<decltype(access(desc))>>) {
            const auto found = material.textures.find(attribute_name(field.name));
            if (found != material.textures.end()) {
                access(desc) =
                    TextureRef{.image = ImageId{static_cast<std::uint32_t>(scene.images.size())}};
                scene.images.push_back(found->second);
            }
        }
    });
    return desc;
}

void bind_material(nb::module_& module)
{
    bind_editable<MaterialDesc>(
        module, "Material",
        "A material as in glTF 2.0 and its KHR extensions, with their names, units and defaults. "
        "Keyword arguments are attributes.");
}

}  // namespace bdpt::python
