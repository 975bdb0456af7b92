#include "equality_cases.h"
#include "scene_builder.h"

#include <utility>

namespace bdpt::test {
namespace {

const Rgb white(0.7f);

/// A square of half width `h` about `p` that faces down, or up.
void add_panel(SceneBuilder& builder, Vec3 p, float h, const MaterialDesc& material, bool up)
{
    const Vec3 x(up ? -h : h, 0.0f, 0.0f);
    const Vec3 z(0.0f, 0.0f, h);
    builder.quad(p - x - z, p + x - z, p + x + z, p - x + z, material);
}

SceneBuilder bare_room()
{
    SceneBuilder builder;
    builder.walls(lambertian(white), lambertian({0.7f, 0.5f, 0.3f})).ceiling(lambertian(white));
    return builder;
}

EqualityCase in_bare_room(std::string name, SceneBuilder builder)
{
    return {.name = std::move(name), .scene = std::move(builder.desc), .camera = room_camera()};
}

/// Panels that face down, up and both ways, over and under a sheet of paper that lets light through
/// and a sphere with smooth normals.
EqualityCase panels()
{
    SceneBuilder builder = bare_room();
    const MaterialDesc front = emitter({6.0f, 5.0f, 4.0f});
    MaterialDesc both = emitter({2.0f, 3.0f, 4.0f});
    both.double_sided = true;
    for (int i = 0; i < 9; ++i) {
        const Vec3 p(0.6f * static_cast<float>(i % 3 - 1), 0.75f,
                     0.6f * static_cast<float>(i / 3 - 1));
        add_panel(builder, p, 0.2f, i % 4 == 3 ? both : front, i % 4 == 2);
    }
    MaterialDesc paper = lambertian(Rgb(0.8f));
    paper.diffuse_transmission.factor = 0.6f;
    add_panel(builder, {0.4f, -0.2f, 0.2f}, 0.45f, paper, true);
    builder.sphere({-0.5f, -0.5f, 0.1f}, 0.4f, plastic(white, 0.4f), 16);
    return in_bare_room("panels", std::move(builder));
}

/// Points and spots, with and without a radius, among panels.
EqualityCase punctual()
{
    SceneBuilder builder = bare_room();
    for (int i = 0; i < 8; ++i) {
        const float x = 0.4f * static_cast<float>(i % 4) - 0.6f;
        const float z = i < 4 ? -0.4f : 0.4f;
        const Rgb light = Rgb(0.2f) + 0.05f * Rgb(i % 3, i % 2, 1.0f);
        if (i % 2 == 0) {
            builder.light(PointLightDesc{
                .position = {x, 0.3f, z}, .intensity = light, .radius = i % 4 == 0 ? 0.12f : 0.0f});
        } else {
            builder.light(SpotLightDesc{.position = {x, 0.5f, z},
                                        .direction = {0.3f, i == 3 ? 0.6f : -1.0f, -0.2f},
                                        .intensity = 3.0f * light,
                                        .inner_cone_angle = 0.3f,
                                        .outer_cone_angle = 0.9f,
                                        .radius = i % 4 == 1 ? 0.1f : 0.0f});
        }
    }
    add_panel(builder, {0.5f, 0.8f, 0.0f}, 0.3f, emitter(Rgb(3.0f)), false);
    builder.sphere({0.3f, -0.6f, 0.1f}, 0.35f, plastic({0.6f, 0.2f, 0.2f}, 0.4f));
    return in_bare_room("points, spots and spheres", std::move(builder));
}

/// The tree beside a sun and a sky.
EqualityCase with_sky()
{
    SceneBuilder builder;
    builder.walls(lambertian(white), lambertian({0.7f, 0.5f, 0.3f}));
    for (int i = 0; i < 6; ++i) {
        const Vec3 p(0.5f * static_cast<float>(i % 3 - 1), 0.5f, i < 3 ? -0.5f : 0.5f);
        add_panel(builder, p, 0.2f, emitter(Rgb(3.0f)), i == 4);
    }
    builder.sphere({0.3f, -0.6f, 0.1f}, 0.35f, lambertian({0.6f, 0.2f, 0.2f}));
    builder.light(
        DirectionalLightDesc{.direction = {0.3f, -1.0f, -0.4f}, .illuminance = Rgb(1.0f)});
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(0.5f)}}});
    EqualityCase result = in_bare_room("panels, sun and sky", std::move(builder));
    result.seen_by_lt = 2;
    return result;
}

}  // namespace

std::vector<EqualityCase> many_light_cases()
{
    return {panels(), punctual(), with_sky()};
}

}  // namespace bdpt::test
