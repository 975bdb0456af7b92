#pragma once

#include <bdpt/scene_desc.h>
#include <bdpt/types.h>
#include <tiny_gltf.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "file/load_context.h"

namespace bdpt::io {

/// A reference from a material to a texture.
struct TextureInfo {
    int index = -1;  ///< -1: no texture
    int tex_coord = 0;
    const tinygltf::Value* transform = nullptr;  ///< KHR_texture_transform, if any
};

/// Reads the reference `key` in an extension of a material.
[[nodiscard]] TextureInfo texture_info(const tinygltf::Value& extension, const std::string& key);

/// Reads a reference from one of tinygltf's structs (TextureInfo, NormalTextureInfo).
template <typename Info>
[[nodiscard]] TextureInfo texture_info(const Info& info)
{
    const auto transform = info.extensions.find("KHR_texture_transform");
    return {info.index, info.texCoord,
            transform == info.extensions.end() ? nullptr : &transform->second};
}

/// Returns number `key` in an extension object, or `fallback`.
[[nodiscard]] double number_or(const tinygltf::Value& object, const std::string& key,
                               double fallback);

/// Resolves references to textures.
class TextureResolver {
public:
    /// Returns the image of an index; none if it cannot be read.
    using FindImage = std::function<std::optional<ImageId>(std::size_t)>;

    TextureResolver(const tinygltf::Model& model, FindImage find_image, LoadContext& context)
        : model_(model), find_image_(std::move(find_image)), context_(context)
    {}

    /// Resolves a reference; returns none if there is no texture or, with a warning, no usable one.
    /// `place` is the JSON pointer of the reference.
    [[nodiscard]] std::optional<TextureRef> resolve(const TextureInfo& info,
                                                    const std::string& place);

private:
    [[nodiscard]] Wrap wrap(int value, int sampler, const char* name);

    const tinygltf::Model& model_;
    FindImage find_image_;
    LoadContext& context_;
};

/// The greatest value of a property without an upper bound.
inline constexpr double no_limit = std::numeric_limits<float>::max();

class MaterialValues;

/// One extension of a material.
struct MaterialExtension {
    const MaterialValues& values;
    const tinygltf::Value& object;
    std::string place;  ///< its place within the material

    /// Returns the place of `key` within the material.
    [[nodiscard]] std::string at(std::string_view key) const;
    /// Returns number `key`, clamped to its range; `fallback` if it is missing.
    [[nodiscard]] float number(const std::string& key, double fallback, double low,
                               double high) const;
    /// Returns colour `key`, in [0, high]; `fallback` if it is missing.
    [[nodiscard]] Rgb color(const std::string& key, double high, Rgb fallback = Rgb(1.0f)) const;
    [[nodiscard]] std::optional<TextureRef> texture(const std::string& key) const;
};

/// The values of one material and its extensions, clamped to their ranges with a warning.
class MaterialValues {
public:
    /// `place` is the JSON pointer of the material. All arguments must outlive this object.
    MaterialValues(const tinygltf::Material& source, const std::string& place,
                   TextureResolver& textures, LoadContext& context)
        : source_(source), place_(place), textures_(textures), context_(context)
    {}

    /// Clamps a value to its range; `key` is its place within the material, for the warning.
    [[nodiscard]] float in_range(double value, double low, double high, std::string_view key) const;
    /// Returns an extension; none if the material does not have it.
    [[nodiscard]] std::optional<MaterialExtension> extension(const std::string& name) const;
    /// Resolves a reference whose place within the material is `key`.
    [[nodiscard]] std::optional<TextureRef> texture(const TextureInfo& info,
                                                    std::string_view key) const;

private:
    const tinygltf::Material& source_;
    const std::string& place_;
    TextureResolver& textures_;
    LoadContext& context_;
};

/// Reads the layers of KHR_materials_{anisotropy, clearcoat, coat, diffuse_roughness,
/// diffuse_transmission, fuzz, iridescence, sheen}. Images that have no influence are not decoded.
void read_layers(const MaterialValues& values, MaterialDesc& desc);

/// Returns the material of a primitive in a variant of KHR_materials_variants: the one mapped to it
/// or, if there is none, that of the primitive; -1: the default material.
[[nodiscard]] int variant_material(const tinygltf::Primitive& primitive, std::size_t variant);

/// Reads a glTF material with its KHR_materials extensions [glTF 2.0, sec. 3.9]. Values out of
/// range are clamped, with a warning. Images that have no influence are not decoded.
[[nodiscard]] MaterialDesc read_material(const tinygltf::Model& model, std::size_t index,
                                         TextureResolver& textures, LoadContext& context);

}  // namespace bdpt::io
