#include "equality_cases.h"
#include "scene_builder.h"

#include <utility>

namespace bdpt::test {
namespace {

/// Smooth and rough texels in turn, of metal and of none. A surface between them looks different
/// from the mean of both, so walks that take different copies do not agree.
TexelImage polish(int size)
{
    TexelImage image{.width = size, .height = size, .bytes = {}, .channels = 3};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const bool odd = (x + y) % 2 == 1;
            const std::uint8_t roughness = odd ? 255 : 80;
            const std::uint8_t metallic = odd ? 0 : 255;
            image.bytes.insert(image.bytes.end(), {0, roughness, metallic});
        }
    }
    return image;
}

TexelImage colors(int size)
{
    TexelImage image{.width = size, .height = size, .bytes = {}, .channels = 3};
    for (int i = 0; i < size * size; ++i) {
        const auto value = static_cast<std::uint8_t>(i * 37 % 256);
        image.bytes.insert(image.bytes.end(), {value, static_cast<std::uint8_t>(255 - value), 200});
    }
    return image;
}

/// A floor and a ball; how large a copy they are looked up in changes over both.
EqualityCase room_with(CameraDesc camera, std::string name)
{
    MaterialDesc material = metal(Rgb(0.9f), 1.0f);
    material.base_color_texture = TextureRef{.image = ImageId{1}, .scale = {3, 2}};
    material.metallic_roughness_texture = TextureRef{.image = ImageId{0}, .scale = {3, 2}};
    SceneBuilder builder;
    builder.walls(material, lambertian({0.7f, 0.5f, 0.3f})).ceiling(lambertian(Rgb(0.7f)));
    builder.lamp(0.98f, 0.85f, Rgb(4.0f, 3.5f, 3.0f));
    builder.sphere({0.0f, -0.4f, 0.0f}, 0.55f, material);
    builder.desc.images = {polish(32), colors(48)};
    builder.desc.texture_filter = TextureFilter::mip_mapped;
    return {.name = std::move(name), .scene = std::move(builder.desc), .camera = camera};
}

}  // namespace

std::vector<EqualityCase> mip_map_cases()
{
    CameraDesc orthographic = room_camera();
    orthographic.projection = Projection::orthographic;
    orthographic.vertical_extent = 2.0f;
    return {room_with(room_camera(), "perspective"), room_with(orthographic, "orthographic")};
}

}  // namespace bdpt::test
