#include "scene/scene_names.h"

#include "scene/checks/value_checks.h"
#include "scene/light_set.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <variant>

namespace bdpt {
namespace {

/// Maximum size of all names that images show [bytes]: as JSON they still fit the header of a
/// part's file.
constexpr std::size_t max_text_bytes = std::size_t{4} << 20;

std::string name_or_place(const std::string& name, std::string_view kind, std::size_t index)
{
    return name.empty() ? std::string(kind) + "_" + std::to_string(index) : name;
}

std::string find_name(const LightDesc& light, std::size_t index)
{
    return std::visit(
        [index](const auto& desc) {
            if constexpr (requires { desc.name; }) {
                return name_or_place(desc.name, "light", index);
            } else {
                return name_or_place({}, "light", index);
            }
        },
        light);
}

std::vector<NamedId> named_ids(std::vector<std::string> names)
{
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    std::vector<NamedId> result;
    result.reserve(names.size());
    for (std::string& name : names) {
        const NameId id = name_id(name);
        result.push_back({.name = std::move(name), .id = id});
    }
    return result;
}

/// Returns the names, each of them once and with an id of its own.
std::vector<std::string> unique_names(const std::vector<std::string>& names)
{
    std::unordered_map<std::string_view, int> uses;
    for (const std::string& name : names) {
        ++uses[name];
    }
    std::unordered_set<NameId> taken;
    std::vector<std::string> result;
    for (const std::string& name : names) {  // those that keep their name
        const bool is_free = uses[name] == 1 && taken.insert(name_id(name)).second;
        result.push_back(is_free ? name : std::string());
    }
    std::unordered_map<std::string_view, int> numbers;
    for (std::size_t i = 0; i < names.size(); ++i) {
        while (result[i].empty()) {
            const std::string numbered = names[i] + "." + std::to_string(++numbers[names[i]]);
            if (!uses.contains(numbered) && taken.insert(name_id(numbered)).second) {
                result[i] = numbered;
            }
        }
    }
    return result;
}

constexpr std::array<NameId SurfaceIds::*, id_kinds.size()> ids_of_kinds{
    &SurfaceIds::object, &SurfaceIds::material, &SurfaceIds::instance};

}  // namespace

SceneNames::SceneNames(const SharedSceneDesc& desc)
{
    std::vector<NameId> materials;
    for (std::size_t i = 0; i < desc.materials.size(); ++i) {
        materials_.push_back(name_or_place(desc.materials[i].name, "material", i));
        materials.push_back(name_id(materials_.back()));
    }
    for (std::size_t i = 0; i < desc.instances.size(); ++i) {
        const InstanceDesc& instance = desc.instances[i];
        objects_.push_back(name_or_place(instance.name, "instance", i));
        instances_.push_back({.object = name_id(objects_.back()),
                              .material = materials[static_cast<std::size_t>(instance.material)]});
    }
    for (std::size_t i = 0; i < desc.lights.size(); ++i) {
        if (!light_spheres(std::span(&desc.lights[i], 1)).empty()) {
            const std::string name = find_name(desc.lights[i], i);
            objects_.push_back(name);
            materials_.push_back(name);
            spheres_.push_back({.object = name_id(name), .material = name_id(name)});
        }
    }
    own_names_ = unique_names(objects_);
    for (std::size_t i = 0; i < own_names_.size(); ++i) {
        SurfaceIds& surface =
            i < instances_.size() ? instances_[i] : spheres_[i - instances_.size()];
        surface.instance = name_id(own_names_[i]);
    }
}

IdNames SceneNames::names(AovSet aovs) const
{
    IdNames result;
    const std::array by_kind{&objects_, &materials_, &own_names_};
    for (std::size_t kind = 0; kind < by_kind.size(); ++kind) {
        if (aovs.contains(id_aovs[kind])) {
            result[kind] = named_ids(*by_kind[kind]);
        }
    }
    std::size_t text = 0;
    for (const std::vector<NamedId>& names : result) {
        for (const NamedId& name : names) {
            text += name.name.size();
        }
    }
    if (text > max_text_bytes) {
        fail("the names of objects and materials have ", text,
             " bytes, but Cryptomatte layers hold at most ", max_text_bytes);
    }
    return result;
}

std::vector<NameId> SceneNames::ids(IdKind kind) const
{
    const auto member = ids_of_kinds[static_cast<std::size_t>(kind)];
    std::vector<NameId> result;
    result.reserve(instances_.size() + spheres_.size());
    for (const auto* surfaces : {&instances_, &spheres_}) {
        for (const SurfaceIds& ids : *surfaces) {
            result.push_back(ids.*member);
        }
    }
    return result;
}

}  // namespace bdpt
