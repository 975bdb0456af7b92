#include "array_material.h"

#include <bdpt/error.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <utility>

#include "arrays.h"
#include "attributes.h"
#include "python_scene.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

template <typename T>
void def_value(nb::class_<ArrayMaterial>& type, const char* name, T MaterialDesc::*member,
               const char* text)
{
    type.def_prop_rw(
        name, [member](const ArrayMaterial& material) { return material.desc.*member; },
        [member](ArrayMaterial& material, T value) { material.desc.*member = value; }, text);
}

void def_color(nb::class_<ArrayMaterial>& type, const char* name, Rgb MaterialDesc::*member,
               const char* text)
{
    type.def_prop_rw(
        name,
        [member](const ArrayMaterial& material) {
            const Rgb& color = material.desc.*member;
            return Three{color.r, color.g, color.b};
        },
        [member](ArrayMaterial& material, const Three& value) {
            material.desc.*member = to_vec(value);
        },
        text);
}

TexelImage to_texels(const nb::ndarray<nb::ro, nb::c_contig, nb::device::cpu>& array)
{
    const auto type = array.dtype() == nb::dtype<std::uint8_t>()    ? TexelType::unorm8
                      : array.dtype() == nb::dtype<std::uint16_t>() ? TexelType::unorm16
                                                                    : TexelType::float32;
    if (type == TexelType::float32 && array.dtype() != nb::dtype<float>()) {
        throw Error(ErrorCode::usage, "a texture is an array of uint8, uint16 or float32");
    }
    constexpr std::size_t most_channels = 4;
    if (array.ndim() < 2 || array.ndim() > 3 ||
        (array.ndim() == 3 && array.shape(2) > most_channels)) {
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

using TextureSlot = std::optional<TextureRef> MaterialDesc::*;
constexpr std::pair<const char*, TextureSlot> texture_slots[]{
    {"base_color_texture", &MaterialDesc::base_color_texture},
    {"metallic_roughness_texture", &MaterialDesc::metallic_roughness_texture},
    {"normal_texture", &MaterialDesc::normal_texture},
    {"emission_texture", &MaterialDesc::emission_texture},
    {"transmission_texture", &MaterialDesc::transmission_texture},
};

}  // namespace

MaterialDesc with_textures(const ArrayMaterial& material, SceneDesc& scene)
{
    MaterialDesc desc = material.desc;
    for (const auto& [name, slot] : texture_slots) {
        const auto found = material.textures.find(name);
        if (found != material.textures.end()) {
            desc.*slot =
                TextureRef{.image = ImageId{static_cast<std::uint32_t>(scene.images.size())}};
            scene.images.push_back(found->second);
        }
    }
    return desc;
}

void bind_material(nb::module_& module)
{
    nb::class_<ArrayMaterial> type(module, "Material",
                                   "A material as in glTF 2.0, with its names, units and defaults. "
                                   "Keyword arguments are attributes.");
    type.def("__init__", &construct<ArrayMaterial>, nb::arg("attributes"));
    def_value(type, "name", &MaterialDesc::name, "For layers of ids.");
    type.def_prop_rw(
        "base_color",
        [](const ArrayMaterial& material) {
            const Vec4& color = material.desc.base_color;
            return Four{color.r, color.g, color.b, color.a};
        },
        [](ArrayMaterial& material, const std::vector<float>& color) {
            if (color.size() != 3 && color.size() != 4) {
                throw Error(ErrorCode::usage, "base_color: expected three or four numbers");
            }
            material.desc.base_color = {color[0], color[1], color[2],
                                        color.size() == 4 ? color[3] : 1.0f};
        },
        "Linear RGB or RGBA, [0, 1].");
    def_value(type, "metallic", &MaterialDesc::metallic, "[0, 1]; default 1.");
    def_value(type, "roughness", &MaterialDesc::roughness, "[0, 1]; default 1.");
    def_color(type, "emission", &MaterialDesc::emission, "Radiance [nit].");
    def_value(type, "double_sided", &MaterialDesc::double_sided, "Emits from both sides.");
    def_value(type, "unlit", &MaterialDesc::unlit, "Shines with its base colour [nit].");
    def_value(type, "ior", &MaterialDesc::ior, "Index of refraction; default 1.5.");
    def_value(type, "specular", &MaterialDesc::specular, "[0, 1]; default 1.");
    def_value(type, "transmission", &MaterialDesc::transmission, "[0, 1].");
    def_value(type, "thickness", &MaterialDesc::thickness,
              "Above 0: the mesh bounds a solid body; 0: a thin sheet.");
    def_value(type, "attenuation_distance", &MaterialDesc::attenuation_distance, "[m]");
    def_color(type, "attenuation_color", &MaterialDesc::attenuation_color,
              "What is left of white after attenuation_distance.");
    def_value(type, "dispersion", &MaterialDesc::dispersion, "20 / Abbe number.");
    for (const auto& [name, slot] : texture_slots) {
        type.def_prop_rw(
            name, [](const ArrayMaterial&) { return nb::none(); },
            [name = std::string(name)](
                ArrayMaterial& material,
                const nb::ndarray<nb::ro, nb::c_contig, nb::device::cpu>& array) {
                material.textures[name] = to_texels(array);
            },
            "An array (height, width, channels) of uint8, uint16 or float32; write only.");
    }
}

}  // namespace bdpt::python
