#include "identity/scene_identity.h"

#include <bdpt/part/content_hash.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <type_traits>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace bdpt {

struct ContentHasher::State {
    XXH3_state_t xxh3;
};

ContentHasher::ContentHasher() : state_(std::make_unique<State>())
{
    XXH3_128bits_reset(&state_->xxh3);
}

ContentHasher::~ContentHasher() = default;

void ContentHasher::add(const void* bytes, std::size_t size)
{
    XXH3_128bits_update(&state_->xxh3, bytes, size);
}

ContentHash ContentHasher::hash() const
{
    const XXH128_hash_t hash = XXH3_128bits_digest(&state_->xxh3);
    return {.low = hash.low64, .high = hash.high64};
}

std::string to_string(const ContentHash& hash)
{
    std::array<char, 33> text{};
    std::snprintf(text.data(), text.size(), "%016llx%016llx",
                  static_cast<unsigned long long>(hash.high),
                  static_cast<unsigned long long>(hash.low));
    return text.data();
}

namespace {

/// Longer lists have one hash for all items, so that an identity stays short.
constexpr std::size_t max_items_hashed_alone = 64;

template <typename T>
void add_component(std::vector<IdentityComponent>& result, const std::string& name,
                   const SharedList<T>& list)
{
    if (list.size() > max_items_hashed_alone) {
        result.push_back({.name = name, .value = hash_text(list.values())});
        return;
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
        result.push_back(
            {.name = name + "[" + std::to_string(i) + "]", .value = hash_text(list[i])});
    }
}

template <typename T>
void add_component(std::vector<IdentityComponent>& result, const std::string& name, const T& value)
{
    result.push_back({.name = name, .value = hash_text(value)});
}

template <typename T>
bool is_known(const SharedList<T>& list, const SharedList<T>& before)
{
    return !list.empty() && list.is_shared_with(before);
}

/// Returns false, for values that are fast to hash.
template <typename T>
bool is_known(const T& /*value*/, const T& /*before*/)
{
    return false;
}

template <std::size_t... i>
SceneComponents compute_components(const SharedSceneDesc& scene, const SharedSceneDesc& before,
                                   const SceneComponents& known, std::index_sequence<i...>)
{
    const auto values = scene.members();
    const auto values_before = before.members();
    SceneComponents result;
    const auto add = [&]<std::size_t member>(std::integral_constant<std::size_t, member>) {
        const auto& value = std::get<member>(values);
        if (is_known(value, std::get<member>(values_before))) {
            result[member] = known[member];
        } else {
            const std::string name(std::get<member>(fields<SceneDesc>).name);
            add_component(result[member], "scene: " + name, value);
        }
    };
    (add(std::integral_constant<std::size_t, i>()), ...);
    return result;
}

}  // namespace

SceneComponents scene_components(const SharedSceneDesc& scene, const SharedSceneDesc& before,
                                 const SceneComponents& known)
{
    return compute_components(scene, before, known,
                              std::make_index_sequence<std::tuple_size_v<SceneComponents>>());
}

std::vector<IdentityComponent> joined(const SceneComponents& components)
{
    std::vector<IdentityComponent> result;
    for (const std::vector<IdentityComponent>& some : components) {
        result.insert(result.end(), some.begin(), some.end());
    }
    return result;
}

std::vector<IdentityComponent> identity_components(const SharedSceneDesc& scene)
{
    return joined(scene_components(scene, {}, {}));
}

}  // namespace bdpt
