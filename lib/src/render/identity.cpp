#include <bdpt/part/identity.h>

#include "identity/scene_identity.h"
#include "render/view.h"
#include "scene/scene_names.h"
#include "scene/world.h"

#include <bdpt/render.h>
#include <bdpt/scene.h>
#include <bdpt/version.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string_view>

namespace bdpt {
namespace {

/// Names are in no image but those of ids.
void add_names(std::vector<IdentityComponent>& result, const SharedSceneDesc& scene, AovSet aovs)
{
    if (!asks_for_ids(aovs)) {
        return;
    }
    const SceneNames names(scene);
    constexpr std::array components{"scene: names of objects", "scene: names of materials",
                                    "scene: names of instances"};
    for (std::size_t kind = 0; kind < components.size(); ++kind) {
        if (aovs.contains(id_aovs[kind])) {
            result.push_back(
                {.name = components[kind], .value = hash_text(names.ids(id_kinds[kind]))});
        }
    }
}

/// Returns the values by component name; for duplicate names the first.
std::map<std::string_view, std::string_view> values_by_name(const Identity& identity)
{
    std::map<std::string_view, std::string_view> result;
    for (const auto& [name, value] : identity.components) {
        result.emplace(name, value);
    }
    return result;
}

/// Returns " (8, not 4)" if both values are human-readable.
std::string values_text(std::string_view there, std::string_view here)
{
    constexpr std::size_t max_length = 80;
    const auto is_readable = [](std::string_view value) {
        return !value.starts_with('#') && value.size() <= max_length;
    };
    return is_readable(there) && is_readable(here)
               ? " (" + std::string(there) + ", not " + std::string(here) + ")"
               : "";
}

}  // namespace

Identity identity(const Scene& scene, const CameraDesc& camera, const RenderOptions& options)
{
    Identity result{scene.identity()};
    add_names(result.components, scene.world().description(), options.film.aovs);
    add_camera(result.components, camera);
    add_options(result.components, chosen_options(scene, camera, options));
    result.components.push_back({.name = "build: version", .value = BDPT_VERSION});
#if defined(__VERSION__)
    result.components.push_back({.name = "build: compiler", .value = __VERSION__});
#endif
    return result;
}

std::optional<std::string> difference(const Identity& here, const Identity& there)
{
    constexpr std::size_t max_named = 3;
    const auto values_here = values_by_name(here);
    const auto values_there = values_by_name(there);
    std::vector<std::string> names;
    for (const auto& [name, value] : here.components) {
        const auto its = values_there.find(name);
        if (its == values_there.end()) {
            names.push_back(name + " (missing in it)");
        } else if (its->second != value) {
            names.push_back(name + values_text(its->second, value));
        }
    }
    for (const auto& [name, value] : there.components) {
        if (!values_here.contains(name)) {
            names.push_back(name + " (only in it)");
        }
    }
    if (names.empty()) {
        // The difference must be in the order, or in duplicate names.
        return here == there ? std::nullopt : std::optional<std::string>("the order of components");
    }
    std::string result;
    for (std::size_t i = 0; i < std::min(names.size(), max_named); ++i) {
        result += (i > 0 ? "; " : "") + names[i];
    }
    return names.size() > max_named
               ? result + "; and " + std::to_string(names.size() - max_named) + " more"
               : result;
}

}  // namespace bdpt
