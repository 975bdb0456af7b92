#include "equality_cases.h"

#include "scene_builder.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace bdpt::test {
namespace {

const MediumDesc mist{.extinction = {0.2f, 0.4f, 0.8f}, .albedo = {0.9f, 0.8f, 0.6f}};

SceneBuilder lit_room()
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), lambertian({0.7f, 0.5f, 0.3f}));
    builder.ceiling(lambertian(Rgb(0.7f))).lamp(0.9f, 0.7f, Rgb(4.0f, 3.5f, 3.0f));
    return builder;
}

EqualityCase of(std::string name, SceneBuilder builder)
{
    EqualityCase result{
        .name = std::move(name), .scene = std::move(builder.desc), .camera = room_camera()};
    result.detectable_bias = 0.05;
    // A vertex in a medium may lie as close to the lens as it likes: splats alone have no finite
    // variance.
    result.seen_by_lt = std::nullopt;
    return result;
}

/// A body whose boundary does nothing but let light in.
MaterialDesc inside_of(Rgb attenuation, float distance, VolumeScatterDesc scatter)
{
    MaterialDesc material = glass(0.0f);
    material.ior = 1.0f;
    material.attenuation_color = attenuation;
    material.attenuation_distance = distance;
    material.volume_scatter = scatter;
    return material;
}

EqualityCase fog()
{
    SceneBuilder builder = lit_room();
    builder.sphere({0.3f, -0.6f, 0.1f}, 0.4f, plastic(Rgb(0.6f), 0.4f), 24);
    builder.desc.fog = mist;
    builder.desc.fog->anisotropy = 0.5f;
    return of("fog that colours light", std::move(builder));
}

EqualityCase fog_under_sky()
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), lambertian({0.7f, 0.5f, 0.3f}));
    Image sky{.width = 4, .height = 2, .pixels = {}};
    for (int i = 0; i < 8; ++i) {
        sky.pixels.emplace_back(0.5f + 0.2f * static_cast<float>(i));
    }
    builder.light(EnvironmentLightDesc{.radiance = std::move(sky)});
    builder.desc.fog = mist;
    return of("fog under a sky", std::move(builder));
}

/// What scatters within a rough boundary, beside what scatters within no boundary at all.
EqualityCase bodies()
{
    SceneBuilder builder = lit_room();
    MaterialDesc wax = lambertian(Rgb(0.9f));
    wax.thickness = 1.0f;
    wax.diffuse_transmission.factor = 0.8f;
    wax.attenuation_color = {0.5f, 0.3f, 0.2f};
    wax.attenuation_distance = 0.3f;
    wax.volume_scatter = {.color = {0.9f, 0.7f, 0.5f}, .anisotropy = 0.3f};
    builder.sphere({-0.45f, -0.5f, 0.0f}, 0.45f, wax, 24);
    builder.sphere({0.5f, -0.5f, 0.2f}, 0.4f,
                   inside_of({0.3f, 0.5f, 0.6f}, 0.5f, {Rgb(0.8f), -0.3f}), 24);
    EqualityCase result = of("bodies that scatter", std::move(builder));
    result.max_depth = 5;
    return result;
}

/// Camera rays, light paths to the lens and light samples in fog pass the pane.
EqualityCase fog_behind_tinted_pane()
{
    SceneBuilder builder = lit_room();
    builder.sphere({0.3f, -0.6f, 0.1f}, 0.4f, plastic(Rgb(0.6f), 0.4f), 24);
    MaterialDesc pane = thin_glass(0.0f);
    pane.base_color = {0.9f, 0.5f, 0.2f, 1.0f};
    builder.quad({-1.0f, -1.0f, 0.5f}, {1.0f, -1.0f, 0.5f}, {1.0f, 1.0f, 0.7f}, {-1.0f, 1.0f, 0.7f},
                 pane);
    builder.desc.fog = mist;
    EqualityCase result = of("a wide lens and fog behind a tinted pane", std::move(builder));
    result.camera = with_lens(room_camera(), 0.8f, 3.4f);
    return result;
}

EqualityCase lens_in_fog()
{
    EqualityCase result = fog();
    result.name = "a wide lens in fog";
    result.camera = with_lens(room_camera(), 0.8f, 3.4f);
    return result;
}

/// So many that a tree chooses among them, at finite places and at infinity, beside a sheet that
/// lets half of all rays pass.
EqualityCase lamps_in_fog()
{
    SceneBuilder builder = lit_room();
    for (int i = 0; i < 4; ++i) {
        const Vec3 p(0.4f * static_cast<float>(i) - 0.6f, 0.2f, i % 2 == 0 ? 0.3f : -0.3f);
        builder.light(
            PointLightDesc{.position = p, .intensity = Rgb(0.3f), .radius = i == 3 ? 0.0f : 0.1f});
    }
    builder.light(
        DirectionalLightDesc{.direction = {0.2f, -0.3f, -1.0f}, .illuminance = Rgb(2.0f)});
    MaterialDesc sheet = lambertian(Rgb(0.6f));
    sheet.alpha_mode = AlphaMode::blend;
    sheet.base_color.a = 0.5f;
    sheet.double_sided = true;
    builder.quad({-0.8f, -0.4f, 0.6f}, {0.1f, -0.4f, 0.6f}, {0.1f, 0.5f, 0.6f}, {-0.8f, 0.5f, 0.6f},
                 sheet);
    builder.desc.fog = mist;
    return of("lamps in fog", std::move(builder));
}

/// A cloud that is denser in the middle, beside fog and a body within it.
EqualityCase cloud()
{
    SceneBuilder builder = lit_room();
    builder.sphere({0.4f, -0.2f, 0.2f}, 0.3f, plastic(Rgb(0.6f), 0.4f), 24);
    VolumeDesc volume;
    volume.size = {12, 10, 9};
    for (std::uint32_t i = 0; i < 12 * 10 * 9; ++i) {
        const Vec3 at(i % 12, i / 12 % 10, i / 120);
        const Vec3 offset = (at - Vec3(5.5f, 4.5f, 4.0f)) / Vec3(6.0f, 5.0f, 4.5f);
        volume.density.push_back(std::max(0.0f, 1.0f - dot(offset, offset)) *
                                 (i % 3 == 0 ? 1.5f : 0.5f));
    }
    volume.world_from_grid =
        glm::scale(glm::translate(Mat4(1.0f), Vec3(-0.8f, -0.7f, -0.6f)), Vec3(0.14f));
    volume.extinction = {2.0f, 3.0f, 4.0f};
    volume.albedo = {0.9f, 0.7f, 0.5f};
    volume.anisotropy = 0.4f;
    builder.desc.volumes.push_back(std::move(volume));
    builder.desc.fog = MediumDesc{.extinction = {0.05f, 0.1f, 0.15f}, .albedo = Rgb(0.8f)};
    return of("a cloud in fog", std::move(builder));
}

}  // namespace

std::vector<EqualityCase> media_cases()
{
    return {fog(),         lamps_in_fog(),           fog_under_sky(), bodies(),
            lens_in_fog(), fog_behind_tinted_pane(), cloud()};
}

}  // namespace bdpt::test
