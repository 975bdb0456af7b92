#pragma once

#include <bdpt/fields.h>
#include <bdpt/image.h>
#include <bdpt/light_desc.h>
#include <bdpt/part/content_hash.h>
#include <bdpt/part/identity.h>
#include <bdpt/shared_scene_desc.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

namespace bdpt {

/// Values without pointers and padding: numbers, enumerators, vectors and matrices of GLM.
template <typename T>
concept PlainValue = std::is_arithmetic_v<T> || std::is_enum_v<T> || requires(const T& value)
{
    typename T::value_type;
    value.length();
    requires std::is_trivially_copyable_v<T>;
    requires !std::is_convertible_v<T, std::string_view>;
};

/// Hashes descriptions by their lists of fields (bdpt/fields.h). Names are ignored, as they affect
/// no image.
class DescHasher {
public:
    template <PlainValue T>
    void add(const T& value)
    {
        hasher_.add(&value, sizeof value);
    }
    void add(const std::string& /*name*/) {}
    template <typename T>
    void add(const std::vector<T>& values)
    {
        add(values.size());
        if constexpr (PlainValue<T>) {
            hasher_.add(values.data(), values.size() * sizeof(T));
        } else {
            for (const T& value : values) {
                add(value);
            }
        }
    }
    template <typename T, std::size_t n>
    void add(const std::array<T, n>& values)
    {
        for (const T& value : values) {
            add(value);
        }
    }
    template <typename T>
    void add(const std::optional<T>& value)
    {
        add(value.has_value());
        if (value) {
            add(*value);
        }
    }
    void add(const LightDesc& light)
    {
        add(light.index());
        std::visit([this](const auto& kind) { add(kind); }, light);
    }
    void add(const EnvironmentImage& image)
    {
        add(image.width());
        add(image.height());
        if (image.texels() == nullptr) {
            const std::vector<Rgb> none;
            add(image.floats() != nullptr ? image.floats()->pixels : none);
            return;
        }
        // Hashed as floats, whichever way they are stored.
        std::vector<Rgb> row(static_cast<std::size_t>(image.width()));
        add(row.size() * static_cast<std::size_t>(image.height()));
        for (int y = 0; y < image.height(); ++y) {
            image.copy_row(y, row);
            hasher_.add(row.data(), row.size() * sizeof(Rgb));
        }
    }
    void add(const TexelImage& image)
    {
        add(image.width);
        add(image.height);
        add(image.channels);
        add(image.type);
        add(image.bytes);
    }
    template <HasFields Desc>
    void add(const Desc& desc)
    {
        for_each_field(desc,
                       [this](const auto& /*field*/, const auto& value) { this->add(value); });
    }

    [[nodiscard]] ContentHash hash() const { return hasher_.hash(); }

private:
    ContentHasher hasher_;
};

/// Returns "#" and the hash of one value.
template <typename T>
[[nodiscard]] std::string hash_text(const T& value)
{
    DescHasher hasher;
    hasher.add(value);
    return "#" + to_string(hasher.hash());
}

/// Identity components of a scene, by the members of the description.
using SceneComponents =
    std::array<std::vector<IdentityComponent>,
               std::tuple_size_v<std::remove_cv_t<decltype(fields<SceneDesc>)>>>;

/// Returns the components of `scene`. `known` are those of `before`: lists that both descriptions
/// share are not hashed again.
[[nodiscard]] SceneComponents scene_components(const SharedSceneDesc& scene,
                                               const SharedSceneDesc& before,
                                               const SceneComponents& known);

/// Returns all components, in order.
[[nodiscard]] std::vector<IdentityComponent> joined(const SceneComponents& components);

/// Returns the components of a scene that shares nothing.
[[nodiscard]] std::vector<IdentityComponent> identity_components(const SharedSceneDesc& scene);

}  // namespace bdpt
