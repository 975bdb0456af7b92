#include "gltf/material/material_table.h"

#include "gltf/material/material.h"
#include "gltf/material/texture.h"

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

/// Images that the materials ask for, in the order in which they do.
std::vector<std::size_t> wanted_images(const tinygltf::Model& model,
                                       const std::vector<int>& indices, LoadContext& context)
{
    std::vector<std::size_t> wanted;
    std::set<std::size_t> known;
    const Silence silence(
        context.warnings);  // They come again when the materials are read for good.
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

}  // namespace

std::vector<MaterialDesc> read_materials(
    const tinygltf::Model& model, const std::vector<int>& indices, ImageTable& images,
    const std::function<void(const LoadProgress&)>& on_progress, LoadContext& context)
{
    images.decode(wanted_images(model, indices, context), on_progress);
    TextureResolver textures(
        model, [&images](std::size_t image) { return images.get(image); }, context);
    return read_all(model, indices, textures, context);
}

}  // namespace bdpt::io
