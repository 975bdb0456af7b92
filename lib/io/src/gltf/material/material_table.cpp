#include "gltf/material/image_table.h"

#include "gltf/material/material.h"

#include <fmt/core.h>

#include <cstddef>
#include <optional>
#include <set>

namespace bdpt::io {

namespace {

std::vector<MaterialDesc> read_all(const tinygltf::Model& model, const std::vector<int>& indices,
                                   TextureResolver& textures, LoadContext& context)
{
    std::vector<MaterialDesc> materials;
    materials.reserve(indices.size());
    for (const int index : indices) {
        if (index < 0) {
            materials.emplace_back().name = "default";
            continue;
        }
        materials.push_back(
            read_material(model, static_cast<std::size_t>(index), textures, context));
        if (materials.back().name.empty()) {
            materials.back().name = fmt::format("material_{}", index);
        }
    }
    return materials;
}

/// Returns the images that the materials use, in order of use.
std::vector<std::size_t> wanted_images(const tinygltf::Model& model,
                                       const std::vector<int>& indices, LoadContext& context)
{
    std::vector<std::size_t> wanted;
    std::set<std::size_t> known;
    const Silence silence(
        context.warnings);  // Warnings are repeated when the materials are actually read.
    TextureResolver textures(
        model,
        [&](std::size_t image) {
            if (known.insert(image).second) {
                wanted.push_back(image);
            }
            return std::optional(ImageId{});
        },
        context);
    static_cast<void>(read_all(model, indices, textures, context));
    return wanted;
}

/// Warns of images whose colour encoding differs from the one that their textures need.
void check_encodings(const MaterialDesc& material, ImageTable& images)
{
    const auto check = [&images](const std::optional<TextureRef>& texture, ColorEncoding wanted) {
        if (texture) {
            images.check_encoding(texture->image, wanted);
        }
    };
    for (const auto* texture : {&material.base_color_texture, &material.emission_texture,
                                &material.specular_color_texture, &material.sheen.color_texture,
                                &material.fuzz.color_texture, &material.coat.color_texture,
                                &material.diffuse_transmission.color_texture}) {
        check(*texture, ColorEncoding::srgb);
    }
    // Alpha is linear in either encoding, so textures of which only alpha is read do not count.
    for (const auto* texture :
         {&material.metallic_roughness_texture, &material.normal_texture,
          &material.transmission_texture, &material.clearcoat.texture,
          &material.clearcoat.roughness_texture, &material.clearcoat.normal_texture,
          &material.anisotropy.texture, &material.iridescence.texture,
          &material.iridescence.thickness_texture, &material.diffuse_roughness.texture,
          &material.fuzz.texture, &material.coat.texture, &material.coat.roughness_texture,
          &material.coat.normal_texture, &material.coat.anisotropy_texture}) {
        check(*texture, ColorEncoding::linear);
    }
}

}  // namespace

std::vector<MaterialDesc> read_materials(
    const tinygltf::Model& model, const std::vector<int>& indices, ImageTable& images,
    const std::function<void(const LoadProgress&)>& on_progress, LoadContext& context)
{
    images.decode(wanted_images(model, indices, context), on_progress);
    TextureResolver textures(
        model, [&images](std::size_t image) { return images.get(image); }, context);
    std::vector<MaterialDesc> materials = read_all(model, indices, textures, context);
    for (const MaterialDesc& material : materials) {
        check_encodings(material, images);
    }
    return materials;
}

}  // namespace bdpt::io
