#pragma once

#include <bdpt/fields.h>
#include <bdpt/image.h>
#include <bdpt/light_desc.h>
#include <bdpt/scene_desc.h>
#include <bdpt/types.h>
#include <fmt/core.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.h"
#include "options/option_list.h"
#include "python_errors.h"

namespace bdpt::python {

/// A description whose fields are the attributes of an object of Python: a material or a light.
template <typename Desc>
struct Editable {
    Desc desc{};
    std::map<std::string, TexelImage> textures{};  ///< by attribute
    bool is_frozen = false;                        ///< a scene has been made of it
};

using ArrayMaterial = Editable<MaterialDesc>;
using ArrayLight = std::variant<std::shared_ptr<Editable<PointLightDesc>>,
                                std::shared_ptr<Editable<SpotLightDesc>>,
                                std::shared_ptr<Editable<DirectionalLightDesc>>,
                                std::shared_ptr<Editable<EnvironmentLightDesc>>>;

/// Converts lights to those of scenes, which also have lights of files.
[[nodiscard]] inline std::vector<LightDesc> to_lights(const std::vector<ArrayLight>& lights)
{
    std::vector<LightDesc> result;
    for (const ArrayLight& light : lights) {
        std::visit([&result](const auto& part) { result.emplace_back(part->desc); }, light);
    }
    return result;
}

/// Returns the material for `scene`, to whose images its textures are added.
[[nodiscard]] MaterialDesc with_textures(const ArrayMaterial& material, SceneDesc& scene);

/// Returns the Python name of a field: "sheen colour texture" is sheen_color_texture.
[[nodiscard]] std::string attribute_name(std::string_view field);

/// Returns the documentation of an attribute that is not in the list of fields, such as its unit.
[[nodiscard]] std::string_view note_on(std::string_view attribute);

/// Returns the numbers within `limits` in words: "0 to 1".
[[nodiscard]] std::string limits_text(const Limits& limits);

/// Converts an array or an image of PIL to texels. Throws `Error`.
[[nodiscard]] TexelImage to_texels(const nanobind::object& value);

/// Returns "<float32 (24, 3)>" for an array of that shape.
[[nodiscard]] std::string array_text(std::string_view type,
                                     std::initializer_list<std::size_t> shape);

template <typename Member>
inline constexpr bool is_texture = std::is_same_v<Member, std::optional<TextureRef>>;
template <typename Member>
inline constexpr bool is_motion = std::is_same_v<Member, std::vector<Vec3>>;
template <typename Member>
inline constexpr bool is_vec =
    std::is_same_v<Member, Vec2> || std::is_same_v<Member, Vec3> || std::is_same_v<Member, Vec4>;

/// Calls `visit(field, access)` for each attribute: the fields of `Desc` and of its layers;
/// `access(desc)` is the field of a `Desc`.
template <typename Desc, typename Visit>
void for_each_attribute(const Visit& visit)
{
    const Desc any;
    for_each_field(any, [&visit](const auto& field, const auto& value) {
        const auto member = field.member;
        if constexpr (HasFields<decltype(value)>) {
            for_each_field(value, [&visit, member](const auto& inner, const auto& /*value*/) {
                visit(
                    inner, [ member, last = inner.member ](auto& desc) -> auto& {
                        return (desc.*member).*last;
                    });
            });
        } else if constexpr (!is_motion<std::remove_cvref_t<decltype(value)>>) {
            visit(
                field, [member](auto& desc) -> auto& { return desc.*member; });
        }
    });
}

/// The names of `AlphaMode`, in its order.
inline constexpr std::array<const char*, 3> alpha_modes{"opaque", "mask", "blend"};

/// Returns the Python value of an attribute.
template <typename Member>
[[nodiscard]] auto to_python(const Member& member)
{
    if constexpr (std::is_same_v<Member, AlphaMode>) {
        return std::string(alpha_modes.at(static_cast<std::size_t>(member)));
    } else if constexpr (std::is_same_v<Member, Vec4>) {
        return nanobind::typed<nanobind::tuple, float, nanobind::ellipsis>(
            nanobind::make_tuple(member.x, member.y, member.z, member.w));
    } else if constexpr (is_vec<Member>) {
        return nanobind::typed<nanobind::tuple, float, nanobind::ellipsis>(
            nanobind::make_tuple(member.x, member.y, member.z));
    } else {
        return member;
    }
}

/// Throws unless a number, or each of several, is finite, or is within the limits if the field has
/// any.
template <typename Field, typename Member>
void check_number(const Field& field, const Member& member, const std::string& text)
{
    if constexpr (is_vec<Member>) {
        for (int i = 0; i < Member::length(); ++i) {
            check_number(field, member[i], text);
        }
    } else if constexpr (std::is_same_v<Member, float>) {
        const Limits limits = [&field] {
            if constexpr (requires { field.limits; }) {
                return field.limits;
            } else {
                return static_cast<void>(field), Limits::finite();
            }
        }();
        const bool above = limits.low_is_excluded ? member > limits.low : member >= limits.low;
        if (!above || !(member <= limits.high)) {
            throw ValueError(fmt::format("{}: {} is {}", text, member,
                                         std::isfinite(member)
                                             ? fmt::format("out of range ({})", limits_text(limits))
                                             : "not a finite number"));
        }
    }
}

/// Returns the value of a field for `value` of Python. Throws `CallError` for a wrong type and
/// `ValueError` for a wrong value, both with `text`, the assignment as it is written.
template <typename Member, typename Field>
[[nodiscard]] Member from_python(const Field& field, nanobind::handle value,
                                 const std::string& text)
{
    Member member{};
    if constexpr (std::is_same_v<Member, AlphaMode>) {
        std::string word;
        if (!nanobind::try_cast(value, word)) {
            throw CallError(text + ": expected a text");
        }
        const auto* const mode = std::find(alpha_modes.begin(), alpha_modes.end(), word);
        if (mode == alpha_modes.end()) {
            throw ValueError(text + ": expected opaque, mask or blend");
        }
        return static_cast<AlphaMode>(mode - alpha_modes.begin());
    } else if constexpr (is_vec<Member>) {
        std::vector<float> numbers;
        if (PyUnicode_Check(value.ptr()) != 0 || !nanobind::try_cast(value, numbers)) {
            throw CallError(text + ": expected numbers");
        }
        const auto most = static_cast<std::size_t>(Member::length());
        if (numbers.size() != 3 && numbers.size() != most) {
            throw ValueError(
                fmt::format("{}: expected three{} numbers", text, most == 3 ? "" : " or four"));
        }
        member[Member::length() - 1] = 1.0f;  // alpha
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            member[static_cast<int>(i)] = numbers[i];
        }
    } else if (!nanobind::try_cast(value, member)) {
        throw CallError(fmt::format("{}: expected {}", text,
                                    std::is_same_v<Member, float>  ? "a number"
                                    : std::is_same_v<Member, bool> ? "True or False"
                                                                   : "a text"));
    }
    check_number(field, member, text);
    return member;
}

/// Returns a value as Python writes it, but floats with the digits that they have.
template <typename Member>
[[nodiscard]] std::string value_text(const Member& member)
{
    if constexpr (std::is_same_v<Member, float>) {
        return std::isfinite(member) ? fmt::format("{}", member)
                                     : fmt::format("float('{}')", member);
    } else if constexpr (is_vec<Member>) {
        std::string text;
        for (int i = 0; i < Member::length(); ++i) {
            text += (i == 0 ? "" : ", ") + value_text(member[i]);
        }
        return "(" + text + ")";
    } else {
        return nanobind::cast<std::string>(nanobind::repr(nanobind::cast(to_python(member))));
    }
}

/// Returns "Material(name='paint', metallic=0)": what differs from the defaults.
template <typename Desc>
[[nodiscard]] std::string to_text(const Editable<Desc>& part, std::string_view class_name)
{
    const Desc otherwise;
    std::string text;
    for_each_attribute<Desc>([&](const auto& field, const auto& access) {
        const std::string name = attribute_name(field.name);
        std::string value;
        if constexpr (is_texture<std::remove_cvref_t<decltype(access(otherwise))>>) {
            const auto found = part.textures.find(name);
            if (found == part.textures.end()) {
                return;
            }
            const TexelImage& texels = found->second;
            value = array_text(
                texels.type == TexelType::unorm8    ? "uint8"
                : texels.type == TexelType::unorm16 ? "uint16"
                                                    : "float32",
                {static_cast<std::size_t>(texels.height), static_cast<std::size_t>(texels.width),
                 static_cast<std::size_t>(texels.channels)});
        } else if (access(part.desc) != access(otherwise)) {
            value = value_text(access(part.desc));
        } else {
            return;
        }
        text += fmt::format("{}{}={}", text.empty() ? "" : ", ", name, value);
    });
    return fmt::format("{}({})", class_name, text);
}

/// Returns "Radiance [nit]; at least 0; default 0."
template <typename Field, typename Member>
[[nodiscard]] std::string description(const Field& field, const Member& otherwise)
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

template <typename Desc, typename Field, typename Access>
void def_attribute(nanobind::class_<Editable<Desc>>& type, const Field& field, const Access& access)
{
    namespace nb = nanobind;
    using Member = std::remove_cvref_t<decltype(access(std::declval<Desc&>()))>;
    const std::string name = attribute_name(field.name);
    const char* const value_type = is_texture<Member> ? "numpy.typing.ArrayLike | None"
                                   : is_vec<Member>   ? "collections.abc.Sequence[float]"
                                   : std::is_same_v<Member, float> ? "float"
                                   : std::is_same_v<Member, bool>  ? "bool"
                                                                   : "str";
    const std::string getter = fmt::format("def {}(self) -> {}", name,
                                           is_texture<Member> ? "numpy.ndarray | None"
                                           : is_vec<Member>   ? "tuple[float, ...]"
                                                              : value_type);
    const std::string setter = fmt::format("def {}(self, value: {}, /) -> None", name, value_type);
    const std::string text =
        is_texture<Member>
            ? "An array (height, width, channels) of uint8, uint16 or float32, or what NumPy "
              "converts to one, such as a PIL image; None: no texture."
            : description(field, access(static_cast<const Desc&>(Desc())));
    type.def_prop_rw(
        name.c_str(),
        [name, access](const Editable<Desc>& part) -> nb::object {
            if constexpr (is_texture<Member>) {
                const auto found = part.textures.find(name);
                return found == part.textures.end() ? nb::none() : to_array(found->second);
            } else {
                return nb::cast(to_python(access(part.desc)));
            }
        },
        [name, access, field](Editable<Desc>& part, const nb::object& value) {
            if (part.is_frozen) {
                throw nb::attribute_error(
                    (name + " cannot be set: a scene has been made of this object and would stay "
                            "as it is; edit scene.material(...), or change a copy.copy() of it")
                        .c_str());
            }
            if constexpr (!is_texture<Member>) {
                access(part.desc) =
                    from_python<Member>(field, value, fmt::format("{}={}", name, written(value)));
            } else if (value.is_none()) {
                part.textures.erase(name);
            } else {
                part.textures[name] = to_texels(value);
            }
        },
        nb::for_getter(nb::sig(getter.c_str())), nb::for_setter(nb::sig(setter.c_str())),
        nb::for_setter(nb::arg("value").none()), text.c_str());
}

/// Binds an `Editable`, whose constructor takes its attributes as keywords.
template <typename Desc>
void bind_editable(nanobind::module_& module, const char* name, const char* text)
{
    namespace nb = nanobind;
    nb::class_<Editable<Desc>> type(module, name, text);
    std::vector<std::string> names;
    for_each_attribute<Desc>([&](const auto& field, const auto& access) {
        names.push_back(attribute_name(field.name));
        def_attribute(type, field, access);
    });
    const std::string call = fmt::format("{}()", name);
    type.def(
        "__init__",
        [names, call](nb::pointer_and_handle<Editable<Desc>> self, const nb::kwargs& values) {
            new (self.p) Editable<Desc>();
            nb::inst_mark_ready(self.h);
            for (const auto& [key, value] : values) {
                const auto given = nb::cast<std::string>(key);
                if (!job::is_among(names, given)) {
                    fail_keyword(call, given, job::closest(given, names));
                }
                nb::setattr(self.h, key, value);
            }
        },
        nb::arg("attributes"));
    const auto copied = [](const Editable<Desc>& part) {
        return Editable<Desc>{.desc = part.desc, .textures = part.textures};
    };
    type.def("__copy__", copied, "A copy, which can be changed.");
    type.def(
        "__deepcopy__",
        [copied](const Editable<Desc>& part, const nb::object& /*memo*/) { return copied(part); },
        nb::arg("memo"), "As __copy__.");
    type.def("__repr__", [name](const Editable<Desc>& part) { return to_text(part, name); });
}

}  // namespace bdpt::python
