#include "equality_cases.h"
#include "moving_scenes.h"

#include <utility>

namespace bdpt::test {
namespace {

/// Emitters, instances, meshes and the camera move at once.
EqualityCase moving_surfaces()
{
    EqualityCase result{.name = "surfaces that move",
                        .scene = std::move(moving_stage().desc),
                        .camera = moving(room_camera())};
    result.detectable_bias = 0.04;
    result.detectable_bias_of_light_sampling = 0.08;
    return result;
}

/// Lights that are no surface, and spheres.
EqualityCase moving_lights()
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), lambertian({0.7f, 0.5f, 0.3f}));
    builder.sphere({0.4f, -0.6f, 0.0f}, 0.35f, plastic({0.6f, 0.1f, 0.1f}, 0.5f), 24);
    builder.light(PointLightDesc{.position = {-0.6f, 0.5f, 0.3f},
                                 .intensity = Rgb(0.4f),
                                 .motion = {{0.5f, 0.1f, 0.3f}, {0.5f, 0.6f, 0.6f}}});
    builder.light(SpotLightDesc{.position = {-0.5f, 0.8f, 0.3f},
                                .direction = {0.4f, -1.0f, -0.2f},
                                .intensity = Rgb(1.0f),
                                .inner_cone_angle = 0.2f,
                                .outer_cone_angle = 0.7f,
                                .motion = {{0.1f, 0.6f, 0.3f}},
                                .later_directions = {{-0.2f, -1.0f, 0.4f}, {-0.8f, -0.7f, 0.0f}}});
    builder.light(PointLightDesc{.position = {-0.5f, -0.5f, 0.2f},
                                 .intensity = {0.4f, 0.8f, 0.3f},
                                 .radius = 0.2f,
                                 .motion = {{-0.3f, 0.2f, -0.3f}, {-0.6f, 0.4f, 0.5f}}});
    builder.light(SpotLightDesc{.position = {0.4f, 0.7f, 0.1f},
                                .direction = {-0.4f, -1.0f, -0.2f},
                                .intensity = Rgb(1.0f),
                                .inner_cone_angle = 0.4f,
                                .outer_cone_angle = 1.1f,
                                .radius = 0.25f,
                                .motion = {{0.5f, 0.5f, -0.4f}},
                                .later_directions = {{0.4f, -1.0f, 0.6f}}});
    builder.light(DirectionalLightDesc{.direction = {0.3f, -1.0f, -0.4f},
                                       .illuminance = Rgb(0.6f),
                                       .later_directions = {{-0.6f, -1.0f, -0.3f}}});
    EqualityCase result{.name = "lights that move",
                        .scene = std::move(builder.desc),
                        .camera = moving(room_camera())};
    result.detectable_bias = 0.04;
    result.detectable_bias_of_light_sampling = 0.05;
    return result;
}

/// Mirrors and glass that move, and what lets light pass.
EqualityCase moving_glass()
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), lambertian({0.7f, 0.5f, 0.3f}));
    builder.lamp(0.98f, 0.85f, Rgb(4.0f, 3.5f, 3.0f));
    MaterialDesc tinted = glass(0.0f);
    tinted.attenuation_color = {0.9f, 0.4f, 0.2f};
    tinted.attenuation_distance = 0.5f;
    const MeshId ball = builder.sphere_mesh(24);
    builder.place(ball, tinted, Mat4(1.0f));
    move_last(builder, 2, [](float t) {
        return glm::scale(translation({-0.6f + 0.5f * t, -0.5f, 0.2f}),
                          Vec3(0.4f, 0.3f + 0.1f * t, 0.4f));
    });
    builder.place(ball, metal(Rgb(0.95f), 0.0f), Mat4(1.0f));
    move_last(builder, 1, [](float t) {
        return glm::scale(translation({0.6f, -0.6f + 0.6f * t, -0.3f}), Vec3(0.3f));
    });
    MaterialDesc pane = lambertian({0.2f, 0.7f, 0.3f});
    pane.base_color.w = 0.4f;
    pane.alpha_mode = AlphaMode::blend;
    builder.quad({-0.5f, -0.4f, 0.5f}, {0.5f, -0.4f, 0.5f}, {0.5f, 0.4f, 0.5f}, {-0.5f, 0.4f, 0.5f},
                 pane);
    move_last(builder, 3, [](float t) {
        return rotate(translation({0.0f, 0.4f * t, 0.0f}), 1.4f * t, Vec3(0.0f, 1.0f, 0.0f));
    });
    return {.name = "glass, mirror and a pane that move",
            .scene = std::move(builder.desc),
            .camera = moving(room_camera()),
            .detectable_bias = 0.04,
            .detectable_bias_of_light_sampling = 0.05,
            .seen_by_lt = std::nullopt};
}

/// A plate that leaves for far away at the last step, under a sun, which shines on all that there
/// is at any time.
EqualityCase leaving_plate()
{
    SceneBuilder builder;
    builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, lambertian(Rgb(0.7f)));
    builder.quad({-0.5f, 0, 0.5f}, {0.5f, 0, 0.5f}, {0.5f, 0, -0.5f}, {-0.5f, 0, -0.5f},
                 lambertian({0.7f, 0.5f, 0.3f}));
    const auto pose = [](float t) { return translation({t > 0.9f ? 4.0f : 0.0f, 0.0f, 0.0f}); };
    move_last(builder, 2, pose);
    builder.light(
        DirectionalLightDesc{.direction = {0.3f, -1.0f, -0.4f}, .illuminance = Rgb(3.0f)});
    return {.name = "a plate that leaves",
            .scene = std::move(builder.desc),
            .camera = camera_at({1.5f, 3.0f, 5.0f}, {1.5f, -0.5f, 0.0f}, 0.8f),
            .detectable_bias = 0.05,
            .detectable_bias_of_light_sampling = 0.05};
}

}  // namespace

std::vector<EqualityCase> motion_cases()
{
    return {moving_surfaces(), moving_lights(), moving_glass(), leaving_plate()};
}

}  // namespace bdpt::test
