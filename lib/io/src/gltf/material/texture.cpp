#include "gltf/material/material.h"

#include "image/encoded_image.h"

#include <fmt/format.h>

namespace bdpt::io {

namespace {

constexpr const char* transform_name = "KHR_texture_transform";

Vec2 pair_or(const tinygltf::Value& object, const std::string& key, Vec2 fallback)
{
    if (!object.Has(key)) {
        return fallback;
    }
    const tinygltf::Value& pair = object.Get(key);
    return {static_cast<float>(pair.Get(0).GetNumberAsDouble()),
            static_cast<float>(pair.Get(1).GetNumberAsDouble())};
}

/// Returns the image of a texture by an extension.
std::optional<std::size_t> find_source(const tinygltf::Texture& texture, const char* extension)
{
    const auto found = texture.extensions.find(extension);
    if (found == texture.extensions.end() || !found->second.Has("source")) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(found->second.Get("source").GetNumberAsInt());
}

/// Returns the images of a texture, the best first: WebP by its extension, KTX2 by its own if there
/// is a library that decodes it, then the core image.
std::vector<std::size_t> sources(const tinygltf::Texture& texture, const std::string& place,
                                 LoadContext& context)
{
    std::vector<std::size_t> result;
    if (const auto webp = find_source(texture, "EXT_texture_webp")) {
        result.push_back(*webp);
    }
    if (const auto basis = find_source(texture, "KHR_texture_basisu")) {
        const std::string* const obstacle =
            context.ktx2 != nullptr ? context.ktx2->obstacle() : nullptr;
        if (obstacle == nullptr) {
            result.push_back(*basis);
        } else if (texture.source >= 0 || !result.empty()) {
            context.warn(WarningKind::loss,
                         fmt::format("the image beside the KTX2 one is used: {}", *obstacle),
                         place);
        } else {
            context.warn(WarningKind::loss,
                         fmt::format("the KTX2 texture is left out: {}", *obstacle), place);
        }
    }
    if (texture.source >= 0) {
        result.push_back(static_cast<std::size_t>(texture.source));
    }
    return result;
}

/// Returns the extensions whose images of a texture cannot be read, in parentheses.
std::string unread_images(const tinygltf::Texture& texture)
{
    std::string names;
    for (const char* name : {"EXT_texture_avif", "MSFT_texture_dds"}) {
        if (texture.extensions.contains(name)) {
            names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
        }
    }
    return names.empty() ? names : fmt::format(" ({})", names);
}

}  // namespace

TextureInfo texture_info(const tinygltf::Value& extension, const std::string& key)
{
    if (!extension.Has(key)) {
        return {};
    }
    const tinygltf::Value& info = extension.Get(key);
    TextureInfo result;
    result.index = info.Get("index").GetNumberAsInt();
    result.tex_coord = info.Has("texCoord") ? info.Get("texCoord").GetNumberAsInt() : 0;
    if (info.Has("extensions") && info.Get("extensions").Has(transform_name)) {
        result.transform = &info.Get("extensions").Get(transform_name);
    }
    return result;
}

double number_or(const tinygltf::Value& object, const std::string& key, double fallback)
{
    return object.Has(key) ? object.Get(key).GetNumberAsDouble() : fallback;
}

Wrap TextureResolver::wrap(int value, int sampler, const char* name)
{
    switch (value) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return Wrap::repeat;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Wrap::mirrored_repeat;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Wrap::clamp_to_edge;
        default:
            context_.warn("unknown wrap mode; the texture repeats",
                          fmt::format("/samplers/{}/{}: {}", sampler, name, value));
            return Wrap::repeat;
    }
}

std::optional<TextureRef> TextureResolver::resolve(const TextureInfo& info,
                                                   const std::string& place)
{
    if (info.index < 0) {
        return std::nullopt;
    }
    TextureRef ref;
    ref.uv_set = info.tex_coord;
    if (info.transform != nullptr) {
        const tinygltf::Value& transform = *info.transform;
        ref.offset = pair_or(transform, "offset", ref.offset);
        ref.scale = pair_or(transform, "scale", ref.scale);
        ref.rotation = static_cast<float>(number_or(transform, "rotation", 0.0));
        if (transform.Has("texCoord")) {
            ref.uv_set = transform.Get("texCoord").GetNumberAsInt();
        }
    }
    if (ref.uv_set > 1) {
        context_.warn(WarningKind::loss,
                      "only TEXCOORD_0 and TEXCOORD_1 are read; the texture is left out",
                      fmt::format("{}: texCoord {}", place, ref.uv_set));
        return std::nullopt;
    }
    const auto& texture = model_.textures[static_cast<std::size_t>(info.index)];
    const std::string texture_place = fmt::format("/textures/{}", info.index);
    const std::vector<std::size_t> images = sources(texture, texture_place, context_);
    if (images.empty() && !find_source(texture, "KHR_texture_basisu")) {
        context_.warn(WarningKind::loss,
                      "the texture has no PNG, JPEG, WebP or KTX2 image and is left out",
                      texture_place + unread_images(texture));
    }
    std::optional<ImageId> image;
    for (std::size_t i = 0; i < images.size() && !image; ++i) {
        image = find_image_(images[i]);
    }
    if (!image) {
        return std::nullopt;
    }
    ref.image = *image;
    if (texture.sampler >= 0) {
        const auto& sampler = model_.samplers[static_cast<std::size_t>(texture.sampler)];
        ref.wrap_u = wrap(sampler.wrapS, texture.sampler, "wrapS");
        ref.wrap_v = wrap(sampler.wrapT, texture.sampler, "wrapT");
    }
    return ref;
}

}  // namespace bdpt::io
