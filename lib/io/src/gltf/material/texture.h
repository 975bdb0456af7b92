#pragma once

#include "file/load_context.h"

#include <bdpt/scene_desc.h>

#include <tiny_gltf.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

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

}  // namespace bdpt::io
