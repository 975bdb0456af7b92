#include "equality_cases.h"
#include "scene_builder.h"

#include <utility>

namespace bdpt::test {
namespace {

/// Bright to one side, dim to the other, dark above; coarse, so that cells are not even.
LightProfile lopsided()
{
    return {.polar_angles = {0.0f, 0.4f, 1.0f, 1.9f, 2.4f},
            .azimuths = {0.0f, 1.2f, 2.5f, 4.4f, 6.2831853f},
            .intensities = {2.0f, 3.0f, 4.0f, 1.0f, 0.0f,  //
                            2.0f, 1.0f, 0.5f, 0.2f, 0.0f,  //
                            2.0f, 0.8f, 0.3f, 0.1f, 0.0f,  //
                            2.0f, 1.0f, 1.0f, 0.4f, 0.0f,  //
                            2.0f, 3.0f, 4.0f, 1.0f, 0.0f}};
}

/// Its axis, -z, points down; azimuths begin towards +x and turn to the back.
Mat3 hanging(float turned)
{
    const Mat4 down = glm::rotate(Mat4(1.0f), -1.5707963f, Vec3(1.0f, 0.0f, 0.0f));
    return Mat3(glm::rotate(Mat4(1.0f), turned, Vec3(0.0f, 1.0f, 0.0f)) * down);
}

SceneBuilder profile_room()
{
    const Rgb white(0.7f);
    SceneBuilder builder;
    builder.walls(lambertian(white), lambertian({0.7f, 0.5f, 0.3f})).ceiling(lambertian(white));
    builder.sphere({0.4f, -0.6f, 0.0f}, 0.4f, plastic({0.6f, 0.1f, 0.1f}, 0.5f));
    builder.desc.profiles.push_back(lopsided());
    return builder;
}

}  // namespace

std::vector<EqualityCase> profile_cases()
{
    std::vector<EqualityCase> cases;
    SceneBuilder alone = profile_room();
    alone.light(ProfileLightDesc{.position = {-0.3f, 0.6f, 0.2f},
                                 .world_from_light = hanging(0.7f),
                                 .scale = {0.9f, 0.8f, 0.7f}});
    cases.push_back(
        {.name = "light profile", .scene = std::move(alone.desc), .camera = room_camera()});

    // Two of one profile, one of them mirrored, beside a lamp and a point.
    SceneBuilder among = profile_room();
    Mat3 mirrored = hanging(-0.4f);
    mirrored[0] = -mirrored[0];
    among.lamp(0.9f, 0.4f, Rgb(2.0f));
    among.light(PointLightDesc{.position = {0.5f, 0.2f, 0.5f}, .intensity = {0.3f, 0.1f, 0.1f}});
    among.light(ProfileLightDesc{.position = {0.5f, 0.5f, -0.4f},
                                 .world_from_light = mirrored,
                                 .scale = {0.2f, 0.3f, 0.2f}});
    among.light(ProfileLightDesc{.position = {-0.6f, 0.1f, 0.3f},
                                 .world_from_light = hanging(2.0f),
                                 .scale = {0.3f, 0.2f, 0.3f}});
    cases.push_back({.name = "light profiles, lamp and point",
                     .scene = std::move(among.desc),
                     .camera = room_camera()});
    return cases;
}

}  // namespace bdpt::test
