#include "equality_cases.h"
#include "scene_builder.h"

#include <utility>

namespace bdpt::test {
namespace {

MaterialDesc see_through(MaterialDesc material, float alpha)
{
    material.alpha_mode = AlphaMode::blend;
    material.base_color.w = alpha;
    return material;
}

/// Alpha from image 0.
MaterialDesc textured(MaterialDesc material, AlphaMode mode)
{
    material.alpha_mode = mode;
    material.base_color_texture =
        TextureRef{.image = ImageId{0}, .rotation = 0.2f, .scale = {2, 2}};
    material.double_sided = true;
    return material;
}

/// Image 0 has spots of different colours with holes in between.
SceneBuilder leafy_room()
{
    SceneBuilder builder;
    TexelImage leaves{.width = 4, .height = 4, .bytes = {}};
    for (int i = 0; i < 16; ++i) {
        const auto alpha = static_cast<std::uint8_t>(i % 3 == 0 ? 0 : i % 3 == 1 ? 255 : 130 + i);
        const auto green = static_cast<std::uint8_t>(255 - 8 * i);
        leaves.bytes.insert(leaves.bytes.end(), {200, green, 120, alpha});
    }
    builder.desc.images.push_back(leaves);
    builder.walls(lambertian(Rgb(0.7f)), lambertian({0.7f, 0.5f, 0.3f}));
    return builder;
}

SceneBuilder closed_room()
{
    SceneBuilder builder = leafy_room();
    builder.ceiling(lambertian(Rgb(0.7f)));
    return builder;
}

/// A sheet that hangs aslant in the middle of the room.
SceneBuilder& hang(SceneBuilder& builder, const MaterialDesc& material)
{
    return builder.quad({-0.7f, -0.5f, 0.3f}, {0.6f, -0.5f, 0.1f}, {0.7f, 0.5f, -0.2f},
                        {-0.6f, 0.5f, -0.1f}, material);
}

EqualityCase in_leafy_room(std::string name, SceneBuilder builder,
                           std::optional<int> seen_by_lt = 1)
{
    return {.name = std::move(name),
            .scene = std::move(builder.desc),
            .camera = room_camera(),
            .seen_by_lt = seen_by_lt};
}

/// Spheres of one mesh, of which each lets rays pass in its own way.
SceneBuilder instances()
{
    SceneBuilder builder = closed_room();
    builder.lamp(0.98f, 0.85f, Rgb(3.0f));
    const MeshId ball = builder.sphere_mesh(16);
    const auto at = [](float x, float y, float z, Vec3 scale) {
        return glm::scale(glm::translate(Mat4(1.0f), Vec3(x, y, z)), scale);
    };
    builder.place(ball, lambertian({0.6f, 0.1f, 0.1f}), at(-0.6f, -0.6f, -0.3f, Vec3(0.35f)));
    builder.place(ball, see_through(plastic({0.2f, 0.5f, 0.2f}, 0.4f), 0.4f),
                  at(0.0f, -0.5f, 0.2f, {-0.4f, 0.4f, 0.4f}));
    builder.place(ball, textured(lambertian(Rgb(0.8f)), AlphaMode::mask),
                  at(0.5f, -0.5f, -0.2f, {0.4f, 0.3f, 0.4f}));
    builder.place(ball, see_through(emitter(Rgb(1.5f)), 0.3f), at(0.3f, 0.3f, 0.2f, Vec3(0.25f)));
    return builder;
}

}  // namespace

std::vector<EqualityCase> alpha_cases()
{
    std::vector<EqualityCase> cases;
    SceneBuilder panes = closed_room();
    panes.lamp(0.98f, 0.85f, Rgb(4.0f, 3.5f, 3.0f));
    panes.quad({-0.9f, 0.5f, -0.9f}, {0.9f, 0.5f, -0.9f}, {0.9f, 0.5f, 0.9f}, {-0.9f, 0.5f, 0.9f},
               see_through(plastic({0.2f, 0.6f, 0.8f}, 0.4f), 0.5f));
    hang(panes, textured(lambertian({0.8f, 0.8f, 0.3f}), AlphaMode::blend));
    cases.push_back(in_leafy_room("blended panes before an area light", std::move(panes)));

    SceneBuilder leaves = closed_room();
    hang(leaves, textured(lambertian(Rgb(0.8f)), AlphaMode::mask));
    leaves.light(PointLightDesc{.position = {0.2f, 0.6f, 0.6f}, .intensity = Rgb(1.5f)});
    cases.push_back(in_leafy_room("masked leaves before a point light", std::move(leaves)));

    SceneBuilder sky = leafy_room();
    hang(sky, textured(plastic(Rgb(0.8f), 0.5f), AlphaMode::mask));
    sky.quad({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1},
             see_through(lambertian({0.3f, 0.6f, 0.3f}), 0.6f));
    sky.light(EnvironmentLightDesc{
        .radiance = Image{.width = 2, .height = 1, .pixels = {Rgb(2.0f, 1.0f, 1.0f), Rgb(0.5f)}}});
    cases.push_back(
        in_leafy_room("masked leaves and a blended roof under a sky", std::move(sky), 2));

    SceneBuilder lamps = closed_room();
    MaterialDesc lantern = emitter({3.0f, 2.0f, 1.0f});
    hang(lamps, textured(lantern, AlphaMode::blend));
    lamps.quad({-0.9f, 0.8f, -0.9f}, {0.9f, 0.8f, -0.9f}, {0.9f, 0.8f, 0.9f}, {-0.9f, 0.8f, 0.9f},
               textured(emitter(Rgb(1.0f)), AlphaMode::mask));
    cases.push_back(in_leafy_room("emitters with alpha", std::move(lamps)));

    SceneBuilder labels = closed_room();
    MaterialDesc label = textured(lambertian(Rgb(1.0f)), AlphaMode::blend);
    label.unlit = true;
    hang(labels, label);
    MaterialDesc panel = lambertian({1.0f, 0.6f, 0.4f});
    panel.unlit = true;
    labels.quad({-0.8f, 0.9f, -0.8f}, {0.8f, 0.9f, -0.8f}, {0.8f, 0.9f, 0.8f}, {-0.8f, 0.9f, 0.8f},
                panel);
    labels.sphere({0.4f, -0.6f, 0.2f}, 0.35f, metal(Rgb(0.9f), 0.2f));
    cases.push_back(in_leafy_room("unlit panels", std::move(labels)));
    cases.back().detectable_bias_of_light_sampling = 0.07;  // a glossy sphere before many lights

    cases.push_back(in_leafy_room("instances with alpha", instances()));

    SceneBuilder glasses = closed_room();
    MaterialDesc tinted = see_through(glass(0.2f), 0.7f);
    tinted.attenuation_color = {0.9f, 0.4f, 0.2f};
    tinted.attenuation_distance = 0.5f;
    glasses.lamp(0.98f, 0.85f, Rgb(3.0f)).sphere({0.4f, -0.5f, 0.1f}, 0.4f, tinted);
    glasses.sphere({-0.4f, -0.5f, 0.1f}, 0.4f, see_through(thin_glass(0.0f), 0.5f));
    cases.push_back(in_leafy_room("glass with alpha", std::move(glasses), std::nullopt));
    cases.back().detectable_bias_of_light_sampling = 0.06;  // nee finds rough glass hard
    return cases;
}

}  // namespace bdpt::test
