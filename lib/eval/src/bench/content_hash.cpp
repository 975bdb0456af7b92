#include <bdpt/eval/bench/bench_scene.h>

#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "bench/hasher.h"

namespace bdpt::eval {
namespace {

// What holds descriptions, and images. All else goes by the lists of fields (bdpt/fields.h).
template <HasFields Desc>
void add(Hasher& hasher, const Desc& desc);

void add(Hasher& hasher, const Image& image)
{
    hasher.add(image.width);
    hasher.add(image.height);
    hasher.add_array(image.pixels);
}

void add(Hasher& hasher, const TexelImage& image)
{
    hasher.add(image.width);
    hasher.add(image.height);
    hasher.add(image.channels);
    hasher.add(image.type);
    hasher.add_array(image.bytes);
}

void add(Hasher& hasher, const std::optional<TextureRef>& texture)
{
    hasher.add(texture.has_value());
    if (texture) {
        add(hasher, *texture);
    }
}

void add(Hasher& hasher, const LightDesc& light)
{
    hasher.add(light.index());
    std::visit([&](const auto& kind) { add(hasher, kind); }, light);
}

template <typename T>
constexpr bool is_vector = false;
template <typename T>
constexpr bool is_vector<std::vector<T>> = true;

/// Of types whose values are added by `Hasher::add_array`.
template <typename T>
concept Plain = requires(Hasher hasher, const T& value)
{
    hasher.add(value);
};

template <typename T>
void add_all(Hasher& hasher, std::string_view name, const std::vector<T>& values)
{
    // What stands still has the hash that it had before anything could move, and scenes without
    // profiles that of older reports.
    const bool later =
        name == "motion" || name == "turn" || name == "profiles" || name == "volumes";
    if (later && values.empty()) {
        return;
    }
    if constexpr (Plain<T>) {
        hasher.add_array(values);
    } else {
        if (!later) {
            hasher.add(values.size());
        }
        for (const T& value : values) {
            add(hasher, value);
        }
    }
}

/// `name`: of the field.
template <typename T>
void add_value(Hasher& hasher, std::string_view name, const T& value)
{
    if constexpr (std::is_same_v<T, std::optional<MediumDesc>>) {
        if (value) {  // scenes without fog have the hash of older reports
            add(hasher, *value);
        }
    } else if constexpr (std::is_same_v<T, VolumeScatterDesc>) {
        if (value.color != Rgb(0.0f)) {  // and so have materials that scatter nothing within
            add(hasher, value);
        }
    } else if constexpr (std::is_same_v<T, std::string> ||
                         std::is_same_v<T, std::optional<float>>) {
        return;  // names, and what their author had in mind, show in no image
    } else if constexpr (std::is_same_v<T, std::optional<TextureRef>>) {
        return;  // all at the end
    } else if constexpr (is_vector<T>) {
        add_all(hasher, name, value);
    } else if constexpr (Plain<T>) {
        hasher.add(value);
    } else if constexpr (requires { value.front(); }) {
        for (const auto& one : value) {
            add_value(hasher, name, one);
        }
    } else {
        add(hasher, value);
    }
}

template <HasFields Desc>
void add(Hasher& hasher, const Desc& desc)
{
    for_each_field(desc, [&hasher](const auto& field, const auto& value) {
        add_value(hasher, field.name, value);
    });
    if constexpr (std::is_same_v<Desc, MaterialDesc>) {
        for_each_texture(desc, [&hasher](const auto& texture) { add(hasher, texture); });
    }
}

}  // namespace

std::uint64_t content_hash(const SceneDesc& scene)
{
    Hasher hasher;
    add(hasher, scene);
    return hasher.hash();
}

std::uint64_t content_hash(const CameraDesc& camera)
{
    Hasher hasher;
    add(hasher, camera);
    return hasher.hash();
}

}  // namespace bdpt::eval
