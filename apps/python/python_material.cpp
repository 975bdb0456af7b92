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
namespace {

namespace nb = nanobind;

using TexelArray = nb::ndarray<nb::ro, nb::c_contig, nb::device::cpu>;

// Attributes are generated from the lists of fields of `MaterialDesc` and of its layers.

/// Returns the Python name of a field: "sheen colour texture" is sheen_color_texture.
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

/// Returns additional documentation of an attribute that is not in the list of fields.
std::string_view note_on(std::string_view attribute)
{
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 14> notes{{
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

/// Calls `visit(field, access)` for each field of materials and of their layers; `access(desc)` is
/// the field of a `MaterialDesc`.
template <typename Visit>
void for_each_attribute(const Visit& visit)
{
    const MaterialDesc any;
    for_each_field(any, [&visit](const auto& field, const auto& value) {
        const auto member = field.member;
        if constexpr (HasFields<decltype(value)>) {
            for_each_field(value, [&visit, member](const auto& inner, const auto& /*value*/) {
                visit(
                    inner, [ member, last = inner.member ](auto& desc) -> auto& {
                        return (desc.*member).*last;
                    });
            });
        } else {
            visit(
                field, [member](auto& desc) -> auto& { return desc.*member; });
        }
    });
}

template <typename Member>
inline constexpr bool is_texture = std::is_same_v<Member, std::optional<TextureRef>>;

TexelImage to_texels(const nb::object& value)
{
    const auto array = nb::cast<TexelArray>(nb::module_::import_("numpy").attr("asarray")(value));
    const auto type = array.dtype() == nb::dtype<std::uint8_t>()    ? TexelType::unorm8
                      : array.dtype() == nb::dtype<std::uint16_t>() ? TexelType::unorm16
                                                                    : TexelType::float32;
    if (type == TexelType::float32 && array.dtype() != nb::dtype<float>()) {
        throw Error(ErrorCode::usage, "a texture is an array of uint8, uint16 or float32");
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

void def_texture(nb::class_<ArrayMaterial>& type, const std::string& name)
{
    const std::string getter = "def " + name + "(self) -> numpy.ndarray | None";
    const std::string setter =
        "def " + name + "(self, value: numpy.typing.ArrayLike | None, /) -> None";
    type.def_prop_rw(
        name.c_str(),
        [name](const ArrayMaterial& material) -> nb::object {
            const auto found = material.textures.find(name);
            return found == material.textures.end() ? nb::none() : to_array(found->second);
        },
        [name](ArrayMaterial& material, const nb::object& value) {
            if (value.is_none()) {
                material.textures.erase(name);
            } else {
                material.textures[name] = to_texels(value);
            }
        },
        nb::for_getter(nb::sig(getter.c_str())), nb::for_setter(nb::sig(setter.c_str())),
        nb::for_setter(nb::arg("value").none()),
        "An array (height, width, channels) of uint8, uint16 or float32, or what NumPy converts to "
        "one, such as a PIL image; None: no texture.");
}

template <typename Access>
void def_alpha_mode(nb::class_<ArrayMaterial>& type, const char* name, const Access& access,
                    const char* text)
{
    static constexpr std::array<std::pair<const char*, AlphaMode>, 3> modes{
        {{"opaque", AlphaMode::opaque}, {"mask", AlphaMode::mask}, {"blend", AlphaMode::blend}}};
    type.def_prop_rw(
        name,
        [access](const ArrayMaterial& material) {
            return modes.at(static_cast<std::size_t>(access(material.desc))).first;
        },
        [access](ArrayMaterial& material, const std::string& word) {
            for (const auto& [mode_name, mode] : modes) {
                if (word == mode_name) {
                    access(material.desc) = mode;
                    return;
                }
            }
            throw Error(ErrorCode::usage,
                        fmt::format("alpha_mode \"{}\": expected opaque, mask or blend", word));
        },
        text);
}

template <typename Access>
void def_rgba(nb::class_<ArrayMaterial>& type, const char* name, const Access& access,
              const char* text)
{
    type.def_prop_rw(
        name,
        [access](const ArrayMaterial& material) {
            const Vec4& color = access(material.desc);
            return Four{color.r, color.g, color.b, color.a};
        },
        [access, name = std::string(name)](ArrayMaterial& material,
                                           const std::vector<float>& color) {
            if (color.size() != 3 && color.size() != 4) {
                throw Error(ErrorCode::usage, name + ": expected three or four numbers");
            }
            access(material.desc) = {color[0], color[1], color[2],
                                     color.size() == 4 ? color[3] : 1.0f};
        },
        text);
}

template <typename Access>
void def_rgb(nb::class_<ArrayMaterial>& type, const char* name, const Access& access,
             const char* text)
{
    type.def_prop_rw(
        name,
        [access](const ArrayMaterial& material) {
            const Rgb& color = access(material.desc);
            return Three{color.r, color.g, color.b};
        },
        [access](ArrayMaterial& material, const Three& color) {
            access(material.desc) = to_vec(color);
        },
        text);
}

template <typename Member, typename Access>
void def_attribute(nb::class_<ArrayMaterial>& type, const std::string& name, const Access& access,
                   const std::string& text)
{
    if constexpr (is_texture<Member>) {
        def_texture(type, name);
    } else if constexpr (std::is_same_v<Member, AlphaMode>) {
        def_alpha_mode(type, name.c_str(), access, text.c_str());
    } else if constexpr (std::is_same_v<Member, Vec4>) {
        def_rgba(type, name.c_str(), access, text.c_str());
    } else if constexpr (std::is_same_v<Member, Rgb>) {
        def_rgb(type, name.c_str(), access, text.c_str());
    } else {
        static_assert(std::is_same_v<Member, float> || std::is_same_v<Member, bool> ||
                      std::is_same_v<Member, std::string>);
        type.def_prop_rw(
            name.c_str(),
            [access](const ArrayMaterial& material) -> Member { return access(material.desc); },
            [access](ArrayMaterial& material, Member value) {
                access(material.desc) = std::move(value);
            },
            text.c_str());
    }
}

/// Returns "Radiance [nit]; at least 0; default 0."
template <typename Field, typename Member>
std::string description(const Field& field, const Member& otherwise)
{
    std::string text(note_on(attribute_name(field.name)));
    const auto append = [&text](const std::string& more) {
        text += (text.empty() ? "" : "; ") + more;
    };
    if constexpr (requires { field.limits; }) {
        append(limits_text(field.limits));
    }
    if constexpr (std::is_same_v<Member, float>) {
        append(fmt::format("default {}", otherwise));
    }
    return text.empty() ? text : text + ".";
}

}  // namespace

MaterialDesc with_textures(const ArrayMaterial& material, SceneDesc& scene)
{
    MaterialDesc desc = material.desc;
    for_each_attribute([&](const auto& field, const auto& access) {
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
    nb::class_<ArrayMaterial> type(module, "Material",
                                   "A material as in glTF 2.0 and its KHR extensions, with their "
                                   "names, units and defaults. Keyword arguments are attributes.");
    type.def("__init__", &construct<ArrayMaterial>, nb::arg("attributes"));
    const MaterialDesc otherwise;
    for_each_attribute([&](const auto& field, const auto& access) {
        using Member = std::remove_cvref_t<decltype(access(otherwise))>;
        def_attribute<Member>(type, attribute_name(field.name), access,
                              description(field, access(otherwise)));
    });
}

}  // namespace bdpt::python
