#include "equality_cases.h"
#include "scene_builder.h"
#include "statistics.h"

#include <utility>

namespace bdpt::test {
namespace {

/// A sphere in the room of the other cases, lit by a lamp.
EqualityCase ball(std::string name, const MaterialDesc& material)
{
    const Rgb white(0.7f);
    SceneBuilder builder;
    builder.walls(lambertian(white), lambertian({0.7f, 0.5f, 0.3f})).ceiling(lambertian(white));
    builder.lamp(0.98f, 0.85f, Rgb(4.0f, 3.5f, 3.0f));
    builder.sphere({0.0f, -0.4f, 0.0f}, 0.55f, material);
    return {.name = std::move(name), .scene = std::move(builder.desc), .camera = room_camera()};
}

/// Slopes to four sides.
TexelImage bumps()
{
    return {
        .width = 2,
        .height = 2,
        .bytes = {160, 128, 245, 255, 128, 160, 245, 255, 96, 128, 245, 255, 128, 96, 245, 255}};
}

/// An even coat over a bumpy base: two shading normals at each point.
EqualityCase clearcoat()
{
    MaterialDesc material = metal({0.9f, 0.5f, 0.3f}, 0.5f);
    material.normal_texture = TextureRef{.image = ImageId{0}, .scale = {6, 4}};
    material.clearcoat.factor = 1.0f;
    material.clearcoat.roughness = 0.3f;
    EqualityCase result = ball("clearcoat", material);
    result.scene.images.push_back(bumps());
    return result;
}

EqualityCase lacquer()
{
    MaterialDesc material = plastic({0.8f, 0.6f, 0.4f}, 0.3f);
    material.coat.factor = 0.9f;
    material.coat.roughness = 0.3f;
    material.coat.ior = 1.8f;
    material.coat.color = {0.9f, 0.4f, 0.2f};
    material.coat.anisotropy_strength = 0.5f;
    return ball("coat", material);
}

EqualityCase cloth()
{
    MaterialDesc material = lambertian({0.3f, 0.1f, 0.1f});
    material.sheen.color = {0.9f, 0.8f, 0.5f};
    material.sheen.roughness = 0.4f;
    return ball("sheen", material);
}

/// Dust on varnish, both on a bumpy base.
EqualityCase dusty()
{
    MaterialDesc material = plastic({0.6f, 0.2f, 0.1f}, 0.5f);
    material.normal_texture = TextureRef{.image = ImageId{0}, .scale = {6, 4}};
    material.clearcoat.factor = 1.0f;
    material.clearcoat.roughness = 0.3f;
    material.fuzz.factor = 0.8f;
    material.fuzz.color = {0.9f, 0.8f, 0.6f};
    EqualityCase result = ball("fuzz", material);
    result.scene.images.push_back(bumps());
    return result;
}

/// The sphere has texture coordinates, which give it tangents.
EqualityCase brushed()
{
    MaterialDesc material = metal({0.9f, 0.7f, 0.4f}, 0.3f);
    material.anisotropy.strength = 0.7f;
    material.anisotropy.rotation = 0.6f;
    return ball("anisotropy", material);
}

EqualityCase film()
{
    MaterialDesc material = plastic({0.5f, 0.3f, 0.2f}, 0.3f);
    material.iridescence.factor = 1.0f;
    material.iridescence.ior = 2.0f;
    return ball("iridescence", material);
}

EqualityCase clay()
{
    MaterialDesc material = plastic({0.8f, 0.4f, 0.2f}, 0.4f);
    material.diffuse_roughness.factor = 1.0f;
    return ball("diffuse roughness", material);
}

/// A sphere of wax, whose inside absorbs.
EqualityCase translucent()
{
    MaterialDesc material = plastic({0.5f, 0.3f, 0.2f}, 0.4f);
    material.diffuse_transmission.factor = 0.6f;
    material.diffuse_transmission.color = {0.9f, 0.7f, 0.6f};
    material.thickness = 1.0f;
    material.attenuation_color = {0.9f, 0.5f, 0.3f};
    material.attenuation_distance = 0.5f;
    return ball("diffuse transmission", material);
}

/// Rough, so that light tracing and all joins see it; light paths and camera paths share a colour.
EqualityCase dispersion()
{
    MaterialDesc material = glass(0.35f);
    material.dispersion = 6.0f;
    EqualityCase result = ball("dispersion", material);
    result.detectable_bias = 0.04;  // a third of the samples counts for each channel
    result.detectable_bias_of_light_sampling = 0.08;
    return result;
}

/// Leans by 70 degrees to four sides, and by 30 in between.
TexelImage steep_bumps()
{
    return {
        .width = 4, .height = 2, .bytes = {247, 128, 171, 255, 192, 128, 238, 255, 8,   128, 171,
                                           255, 64,  128, 238, 255, 128, 247, 171, 255, 128, 64,
                                           238, 255, 128, 8,   171, 255, 128, 192, 238, 255}};
}

EqualityCase steep_map(std::string name, MaterialDesc material)
{
    material.normal_texture = TextureRef{.image = ImageId{0}, .scale = {5, 6}};
    EqualityCase result = ball(std::move(name), material);
    result.scene.images.push_back(steep_bumps());
    result.detectable_bias = 0.03;
    result.detectable_bias_of_light_sampling = 0.05;
    return result;
}

/// So many lights that they are chosen by the side of the surface on which a point is: that of the
/// surface, where it is seen from behind a facet, too.
EqualityCase steep_map_under_panels()
{
    EqualityCase result =
        steep_map("steep normal map, many lights", plastic({0.8f, 0.5f, 0.3f}, 0.5f));
    SceneBuilder builder{.desc = std::move(result.scene)};
    for (int i = 0; i < 4; ++i) {
        const Vec3 p(i % 2 == 0 ? -0.95f : 0.95f, -0.2f, i < 2 ? -0.4f : 0.4f);
        const Vec3 z(0.0f, 0.0f, p.x < 0.0f ? 0.3f : -0.3f);
        const Vec3 y(0.0f, 0.3f, 0.0f);
        builder.quad(p - y + z, p - y - z, p + y - z, p + y + z, emitter(Rgb(4.0f)));
    }
    result.scene = std::move(builder.desc);
    return result;
}

/// The map is that of the coat, over a base that has it too.
EqualityCase steep_coat()
{
    MaterialDesc material = plastic({0.6f, 0.3f, 0.2f}, 0.6f);
    material.clearcoat.factor = 1.0f;
    material.clearcoat.roughness = 0.4f;
    material.clearcoat.normal_texture = TextureRef{.image = ImageId{0}, .scale = {3, 4}};
    return steep_map("coat with a steep normal map", material);
}

/// A material with some of all layers and other properties, rough enough for light tracing.
MaterialDesc any_material(Random& random)
{
    const auto color = [&random] { return Rgb(random.next(), random.next(), random.next()); };
    const auto sometimes = [&random](float share) {
        return random.next() < share ? 0.3f + 0.7f * random.next() : 0.0f;
    };
    const auto rough = [&random] { return 0.35f + 0.65f * random.next(); };
    MaterialDesc material;
    material.base_color = Vec4(color(), 1.0f);
    material.metallic = sometimes(0.4f);
    material.roughness = rough();
    material.ior = 1.0f + 1.5f * random.next();
    material.specular = random.next();
    material.specular_color = color();
    material.clearcoat.factor = sometimes(0.3f);
    material.clearcoat.roughness = rough();
    material.coat.factor = sometimes(0.5f);
    material.coat.roughness = rough();
    material.coat.ior = 1.0f + 1.2f * random.next();
    material.coat.color = color();
    material.coat.darkening = random.next();
    material.coat.anisotropy_strength = sometimes(0.4f);
    material.sheen.color = sometimes(0.3f) * color();
    material.sheen.roughness = random.next();
    material.fuzz.factor = sometimes(0.4f);
    material.fuzz.color = color();
    material.fuzz.roughness = random.next();
    material.anisotropy.strength = sometimes(0.3f);
    material.iridescence.factor = sometimes(0.3f);
    material.diffuse_transmission.factor = sometimes(0.2f);
    material.diffuse_roughness.factor = sometimes(0.4f);
    if (random.next() < 0.3f) {
        material.normal_texture = TextureRef{.image = ImageId{0}, .scale = {6, 4}};
    }
    return material;
}

MaterialDesc tinted_glass(float roughness, float ior, Rgb color)
{
    MaterialDesc material = glass(roughness);
    material.ior = ior;
    material.attenuation_color = color;
    material.attenuation_distance = 0.4f;
    return material;
}

/// A dense sphere and one of little but air in a sphere of water, with a stone that is not round.
EqualityCase spheres_in_a_sphere()
{
    EqualityCase result = ball("bodies in a body", tinted_glass(0.35f, 1.33f, {0.5f, 0.8f, 0.9f}));
    SceneBuilder builder{.desc = std::move(result.scene)};
    builder.sphere({-0.2f, -0.3f, 0.0f}, 0.22f, tinted_glass(0.35f, 1.8f, {0.9f, 0.5f, 0.4f}), 24);
    builder.sphere({0.2f, -0.25f, 0.1f}, 0.18f, tinted_glass(0.4f, 1.05f, {0.9f, 0.9f, 0.5f}), 24);
    builder.sphere({0.0f, -0.7f, 0.1f}, 0.15f, lambertian({0.8f, 0.3f, 0.2f}), 8);
    result.scene = std::move(builder.desc);
    result.max_depth = 5;
    result.detectable_bias = 0.05;
    result.detectable_bias_of_light_sampling = 0.1;
    return result;
}

/// The camera is in a block of dark glass, with a stone that the block does not wholly hold.
EqualityCase camera_in_a_block()
{
    const Rgb white(0.7f);
    SceneBuilder builder;
    builder.walls(lambertian(white), lambertian({0.7f, 0.5f, 0.3f})).ceiling(lambertian(white));
    builder.lamp(0.98f, 0.85f, Rgb(4.0f, 3.5f, 3.0f));
    builder.cube({0.0f, 0.0f, 0.2f}, 0.75f, tinted_glass(0.9f, 1.1f, {0.4f, 0.7f, 0.8f}));
    builder.sphere({0.1f, -0.7f, -0.1f}, 0.3f, lambertian({0.8f, 0.3f, 0.2f}), 16);
    return {.name = "camera in a body",
            .scene = std::move(builder.desc),
            .camera = camera_at({0.0f, 0.1f, 0.8f}, {0.0f, -0.2f, 0.0f}, 1.2f),
            .max_depth = 4,
            .detectable_bias = 0.06,
            // Few samples of light find a way through the glass.
            .detectable_bias_of_light_sampling = 0.25};
}

}  // namespace

std::vector<EqualityCase> volume_cases()
{
    return {spheres_in_a_sphere(), camera_in_a_block()};
}

std::vector<EqualityCase> any_material_cases()
{
    // Six rows of ten balls on the wall that the camera faces.
    const Rgb white(0.7f);
    SceneBuilder builder;
    builder.walls(lambertian(white), lambertian({0.7f, 0.5f, 0.3f})).ceiling(lambertian(white));
    builder.lamp(0.98f, 0.85f, Rgb(4.0f, 3.5f, 3.0f));
    Random random(2022);
    for (int i = 0; i < 60; ++i) {
        const auto column = static_cast<float>(i % 10);
        const auto row = static_cast<float>(i / 10);
        builder.sphere({-0.81f + 0.18f * column, -0.75f + 0.3f * row, -0.3f}, 0.085f,
                       any_material(random), 16);
    }
    EqualityCase result{
        .name = "sixty materials", .scene = std::move(builder.desc), .camera = room_camera()};
    result.scene.images.push_back(bumps());
    return {result};
}

std::vector<EqualityCase> layer_cases()
{
    return {clearcoat(), lacquer(), cloth(),       dusty(),     brushed(),
            film(),      clay(),    translucent(), dispersion()};
}

std::vector<EqualityCase> normal_map_cases()
{
    EqualityCase mirror = steep_map("steep normal map, mirror", metal(Rgb(0.9f), 0.0f));
    mirror.seen_by_lt.reset();
    EqualityCase clear =
        steep_map("steep normal map, smooth plastic", plastic({0.6f, 0.3f, 0.2f}, 0.0f));
    clear.seen_by_lt.reset();
    return {steep_map("steep normal map, plastic", plastic({0.8f, 0.5f, 0.3f}, 0.5f)),
            steep_map("steep normal map, rough metal", metal({0.9f, 0.7f, 0.4f}, 0.5f)),
            steep_map("steep normal map, rough glass", glass(0.5f)),
            std::move(mirror),
            std::move(clear),
            steep_coat(),
            steep_map_under_panels()};
}

}  // namespace bdpt::test
