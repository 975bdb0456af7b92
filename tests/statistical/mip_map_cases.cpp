#include "equality_cases.h"
#include "scene_builder.h"

#include <utility>

namespace bdpt::test {
namespace {

/// Blocks of 4 x 4 texels with these values in turn.
TexelImage blocks(std::uint8_t even, std::uint8_t odd)
{
    constexpr int size = 64;
    TexelImage image{.width = size, .height = size, .bytes = {}, .channels = 1};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            image.bytes.push_back((x / 4 + y / 4) % 2 == 0 ? even : odd);
        }
    }
    return image;
}

/// A floor and a sphere, white where no light passes and black where it does: the mean of both
/// reflects half as much as both do on average, so that walks which take different copies do not
/// agree. How large a copy it is changes over the room.
EqualityCase room_with(CameraDesc camera, std::string name)
{
    MaterialDesc material = lambertian(Rgb(0.9f));
    material.transmission = 1.0f;
    material.transmission_texture = TextureRef{.image = ImageId{0}, .scale = {6, 6}};
    material.base_color_texture = TextureRef{.image = ImageId{1}, .scale = {6, 6}};
    SceneBuilder builder;
    builder.walls(material, lambertian({0.7f, 0.5f, 0.3f})).ceiling(lambertian(Rgb(0.7f)));
    builder.lamp(0.98f, 0.85f, Rgb(4.0f, 3.5f, 3.0f));
    builder.sphere({0.0f, -0.4f, 0.0f}, 0.55f, material);
    builder.desc.images = {blocks(0, 255), blocks(255, 0)};
    builder.desc.texture_filter = TextureFilter::mip_mapped;
    // Walks that take different copies are apart by nine per cent and more.
    return {.name = std::move(name),
            .scene = std::move(builder.desc),
            .camera = camera,
            .detectable_bias = 0.04,
            .detectable_bias_of_light_sampling = 0.04};
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
