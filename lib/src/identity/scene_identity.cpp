#include "identity/scene_identity.h"

#include "identity/desc_hasher.h"

#include <cstddef>
#include <string>

namespace bdpt {
namespace {

/// Longer lists have one hash for all, so that an identity stays short.
constexpr std::size_t most_items_by_themselves = 64;

template <typename T>
void add_list(std::vector<IdentityComponent>& result, const std::string& name,
              const std::vector<T>& list)
{
    if (list.size() > most_items_by_themselves) {
        result.push_back({.name = name, .value = hash_text(list)});
        return;
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
        result.push_back(
            {.name = name + "[" + std::to_string(i) + "]", .value = hash_text(list[i])});
    }
}

template <typename T>
void add_list(std::vector<IdentityComponent>& result, const std::string& name, const T& value)
{
    result.push_back({.name = name, .value = hash_text(value)});
}

}  // namespace

std::vector<IdentityComponent> identity_components(const SceneDesc& scene)
{
    std::vector<IdentityComponent> result;
    for_each_field(scene, [&result](const auto& field, const auto& value) {
        add_list(result, "scene: " + std::string(field.name), value);
    });
    return result;
}

}  // namespace bdpt
