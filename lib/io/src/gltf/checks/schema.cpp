#include "gltf/checks/checks.h"

#include "gltf/checks/extension_table.h"
#include "gltf/checks/schema_rules.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

namespace bdpt::io {

namespace {

using enum Kind;

/// Returns the size of the array at a path without wildcards; 0 if there is none.
std::size_t array_size(const JsonPlace& place, std::string_view path)
{
    const std::size_t slash = path.find('/');
    const std::string_view head = path.substr(0, slash);
    if (!place.has(head)) {
        return 0;
    }
    const JsonPlace next = place.member(head);
    return slash == std::string_view::npos ? next.size() : array_size(next, path.substr(slash + 1));
}

void check_number(const JsonPlace& place)
{
    if (!place.value().is_number()) {
        place.fail("must be a number, but is " + brief(place.value()));
    }
    const double value = place.value().get<double>();
    if (!(std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max()))) {
        place.fail("must be a finite single-precision number, but is " + brief(place.value()));
    }
}

void check_index(const JsonPlace& place, std::string_view target, std::size_t size)
{
    const std::uint64_t value = place.as_unsigned();
    if (value >= size) {
        place.fail(fmt::format("index {}, but the number of {} is {}", value,
                               target.substr(target.rfind('/') + 1), size));
    }
}

void check_code(const JsonPlace& place)
{
    if (place.as_unsigned() > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
        place.fail(brief(place.value()) + " is out of range");
    }
}

void check_numbers(const JsonPlace& place, std::size_t length)
{
    if (!place.value().is_array() || (length != 0 && place.size() != length)) {
        place.fail(fmt::format("must be {} numbers, but is {}", length, brief(place.value())));
    }
    for (std::size_t i = 0; i < place.size(); ++i) {
        check_number(place.element(i));
    }
}

void require(const JsonPlace& place, bool right_type, std::string_view type)
{
    if (!right_type) {
        place.fail(fmt::format("must be {}, but is {}", type, brief(place.value())));
    }
}

void check_value(const JsonPlace& place, const SchemaRule& rule, std::size_t target_size)
{
    switch (rule.kind) {
        case object:
            return require(place, place.value().is_object(), "an object");
        case array:
            return require(place, place.value().is_array(), "an array");
        case string:
            return require(place, place.value().is_string(), "a string");
        case boolean:
            return require(place, place.value().is_boolean(), "true or false");
        case number:
            return check_number(place);
        case count:
            return static_cast<void>(place.as_unsigned());
        case code:
            return check_code(place);
        case numbers:
            return check_numbers(place, rule.length);
        case index:
            return check_index(place, rule.target, target_size);
    }
}

/// Applies a rule to all places that match the rest of its path.
void walk(const JsonPlace& place, std::string_view path, const SchemaRule& rule,
          std::size_t target_size)
{
    if (path.empty()) {
        return check_value(place, rule, target_size);
    }
    const std::size_t slash = path.find('/');
    std::string_view head = path.substr(0, slash);
    const std::string_view rest =
        slash == std::string_view::npos ? std::string_view{} : path.substr(slash + 1);
    if (head == "*") {
        require(place, place.value().is_array(), "an array");
        for (std::size_t i = 0; i < place.size(); ++i) {
            walk(place.element(i), rest, rule, target_size);
        }
        return;
    }
    require(place, place.value().is_object(), "an object");
    if (head == "{}") {
        for (const auto& item : place.value().items()) {
            walk(place.member(item.key()), rest, rule, target_size);
        }
        return;
    }
    const bool required = head.ends_with('!');
    if (required) {
        head.remove_suffix(1);
    }
    if (place.has(head)) {
        return walk(place.member(head), rest, rule, target_size);
    }
    if (required) {
        place.fail(fmt::format("\"{}\" is missing", head));
    }
}

/// Checks the numbers in the extensions of materials.
void check_material_extensions(const JsonPlace& root)
{
    for (const ExtensionSupport& extension : extension_table) {
        for (const MaterialProperty& property : extension.properties) {
            if (property.path.empty()) {
                break;
            }
            const bool one = property.components == 1;
            walk(root, fmt::format("materials/*/extensions/{}/{}", extension.name, property.path),
                 {"", one ? number : numbers, "", property.components}, 0);
        }
    }
}

/// Checks texture references, which occur in many places of a material, all in members whose names
/// end in "Texture". Marks the textures that they use.
void check_texture_references(const JsonPlace& place, std::vector<bool>& used)
{
    constexpr SchemaRule transform_rules[] = {{"offset", numbers, "", 2},
                                              {"scale", numbers, "", 2},
                                              {"rotation", number},
                                              {"texCoord", code}};
    if (!place.value().is_object()) {
        return;
    }
    for (const auto& item : place.value().items()) {
        if (item.key() == "extras") {
            continue;  // user data
        }
        const JsonPlace member = place.member(item.key());
        if (!item.key().ends_with("Texture")) {
            check_texture_references(member, used);
            continue;
        }
        walk(member, "index!", {"", index, "textures"}, used.size());
        used[member.value()["index"].get<std::size_t>()] = true;
        walk(member, "texCoord", {"", code}, 0);
        for (const SchemaRule& rule : transform_rules) {
            walk(member, fmt::format("extensions/KHR_texture_transform/{}", rule.path), rule, 0);
        }
    }
}

/// Checks that the references of used textures exist.
void check_textures(const JsonPlace& root, const std::vector<bool>& used, LoadContext& context)
{
    for (std::size_t i = 0; i < used.size(); ++i) {
        const JsonPlace textures = root.member("textures");
        const JsonPlace texture = textures.element(i);
        try {
            for (const SchemaRule& rule : texture_rules) {
                walk(texture, rule.path, rule, array_size(root, rule.target));
            }
        } catch (const Error& error) {
            if (used[i]) {
                throw;
            }
            context.warn("a broken texture that no material uses is left out", error.what());
        }
    }
}

/// Checks that a value with a type has the member required by its type.
void check_kinds(const JsonPlace& values, std::initializer_list<std::string_view> kinds)
{
    for (std::size_t i = 0; i < values.size(); ++i) {
        const JsonPlace value = values.element(i);
        const JsonPlace type = value.member("type");
        for (const std::string_view kind : kinds) {
            if (type.value() == kind && !value.has(kind)) {
                value.fail(fmt::format("\"{}\" is missing", kind));
            }
        }
    }
}

void check_cameras(const JsonPlace& cameras)
{
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const JsonPlace camera = cameras.element(i);
        const JsonPlace type = camera.member("type");
        if (type.value() != "perspective" && type.value() != "orthographic") {
            type.fail(brief(type.value()) + " is not a type of camera");
        }
    }
    check_kinds(cameras, {"perspective", "orthographic"});
}

void check_lights(const JsonPlace& root)
{
    if (!root.has("extensions")) {
        return;
    }
    const JsonPlace extensions = root.member("extensions");
    if (!extensions.has("KHR_lights_punctual")) {
        return;
    }
    const JsonPlace punctual = extensions.member("KHR_lights_punctual");
    if (punctual.has("lights")) {
        check_kinds(punctual.member("lights"), {"spot"});
    }
}

}  // namespace

void check_schema(const JsonPlace& root, LoadContext& context)
{
    if (!root.value().is_object()) {
        root.fail("a glTF document must be a JSON object, but is " + brief(root.value()));
    }
    for (const SchemaRule& rule : schema_rules) {
        walk(root, rule.path, rule, rule.kind == index ? array_size(root, rule.target) : 0);
    }
    check_material_extensions(root);
    if (root.has("cameras")) {
        check_cameras(root.member("cameras"));
    }
    check_lights(root);
    std::vector<bool> used_textures(array_size(root, "textures"), false);
    for (std::size_t i = 0; i < array_size(root, "materials"); ++i) {
        const JsonPlace materials = root.member("materials");
        check_texture_references(materials.element(i), used_textures);
    }
    check_textures(root, used_textures, context);
}

}  // namespace bdpt::io
