#pragma once

/// @file
/// Describes the lights of a scene.
///
/// @code{.cpp}
/// bdpt::PointLightDesc lamp;
/// lamp.position = {0.0f, 2.0f, 0.0f};
/// lamp.intensity = bdpt::Rgb(60.0f);  // [cd]
/// lamp.radius = 0.05f;                // soft shadows
/// bdpt::SceneBuilder builder;
/// builder.add(lamp);
/// builder.add(bdpt::DirectionalLightDesc{.name = "sun", .direction = {1, -2, 1}});
/// @endcode

#include <bdpt/fields.h>
#include <bdpt/light/environment_image.h>
#include <bdpt/scene_ids.h>
#include <bdpt/types.h>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace bdpt {

/// Maximum luminous flux [lm] of a light in each channel, including emissive triangles: keeps
/// derived values within the range of floats. The sun has 4e28 lm.
inline constexpr float max_light_power = 1e36f;

/// Emits uniformly in all directions; intensity over distance squared [KHR_lights_punctual].
struct PointLightDesc {
    static constexpr std::string_view kind = "point light";  ///< human-readable name

    std::string name{};
    Vec3 position{0.0f};
    Rgb intensity{1.0f};  ///< [cd]
    /// Radius [m]; 0: a point. Otherwise an area light: a sphere of radiance intensity / (pi
    /// radius^2), which rays hit like any surface. It occludes the scene behind it and reflects
    /// nothing.
    float radius = 0.0f;
    std::vector<Vec3> motion{};  ///< later positions
};

/// A point light in a cone, smooth from the inner to the outer angle [KHR_lights_punctual].
struct SpotLightDesc {
    static constexpr std::string_view kind = "spot light";  ///< human-readable name

    std::string name{};
    Vec3 position{0.0f};
    Vec3 direction{0.0f, 0.0f, -1.0f};    ///< axis; any length but 0
    Rgb intensity{1.0f};                  ///< intensity within the inner cone [cd]
    float inner_cone_angle = 0.0f;        ///< [rad] from the axis
    float outer_cone_angle = 0.7853982f;  ///< [rad] from the axis, in (inner, pi/2]
    /// Radius [m], as in `PointLightDesc`; the falloff depends on the direction in which light
    /// leaves the sphere.
    float radius = 0.0f;
    std::vector<Vec3> motion{};  ///< later positions
    /// Later values of `direction`, less than 90 degrees apart.
    std::vector<Vec3> later_directions{};
};

/// The intensities of a luminaire by direction, on a grid of two angles: the polar angle from -z,
/// and the azimuth around that axis, from +x towards +y. Intensities are interpolated bilinearly in
/// the angles; outside of the grid they are zero.
struct LightProfile {
    std::vector<float> polar_angles;  ///< polar angles [rad], two or more, ascending, in [0, pi]
    /// Azimuths [rad], ascending over at most a turn; one: rotationally symmetric.
    std::vector<float> azimuths;
    /// Intensities of all polar angles for each azimuth [cd], >= 0.
    std::vector<float> intensities;
};

/// A point light with the intensity distribution of a measured luminaire [EXT_lights_ies].
struct ProfileLightDesc {
    static constexpr std::string_view kind = "profile light";  ///< human-readable name

    std::string name{};
    Vec3 position{0.0f};
    Mat3 world_from_light{1.0f};  ///< orthonormal; may mirror
    Rgb scale{1.0f};              ///< >= 0, factor of the intensities of the profile
    ProfileId profile{};
    std::vector<Vec3> motion{};  ///< later positions; it does not rotate
};

/// Light from one direction at infinity, like the sun's [KHR_lights_punctual].
struct DirectionalLightDesc {
    static constexpr std::string_view kind = "directional light";  ///< human-readable name

    std::string name{};
    /// Direction in which the light travels; any length but 0.
    Vec3 direction{0.0f, 0.0f, -1.0f};
    Rgb illuminance{1.0f};  ///< illuminance of a surface that faces the light [lx]
    /// Later values of `direction`, less than 90 degrees apart.
    std::vector<Vec3> later_directions{};
};

/// Light from all directions at infinity. `radiance` is equirectangular [nit]: its top row is +y,
/// its centre column is seen along -z and columns to the right turn towards +x. A 1 x 1 image is
/// constant.
struct EnvironmentLightDesc {
    static constexpr std::string_view kind = "environment light";  ///< human-readable name

    EnvironmentImage radiance;
    Mat3 world_from_environment{1.0f};  ///< rotation
};

/// A light that is not an emissive triangle.
using LightDesc = std::variant<PointLightDesc, SpotLightDesc, DirectionalLightDesc,
                               EnvironmentLightDesc, ProfileLightDesc>;
/// Fields of `PointLightDesc`, with names and limits.
template <>
inline constexpr auto fields<PointLightDesc> =
    all_fields(Field{"name", &PointLightDesc::name}, Field{"position", &PointLightDesc::position},
               Number{"intensity", &PointLightDesc::intensity, Limits::at_least(0.0f)},
               Field{"radius", &PointLightDesc::radius}, Field{"motion", &PointLightDesc::motion});
/// Fields of `SpotLightDesc`, with names and limits.
template <>
inline constexpr auto fields<SpotLightDesc> =
    all_fields(Field{"name", &SpotLightDesc::name}, Field{"position", &SpotLightDesc::position},
               Field{"direction", &SpotLightDesc::direction},
               Number{"intensity", &SpotLightDesc::intensity, Limits::at_least(0.0f)},
               Field{"inner cone angle", &SpotLightDesc::inner_cone_angle},
               Field{"outer cone angle", &SpotLightDesc::outer_cone_angle},
               Field{"radius", &SpotLightDesc::radius}, Field{"motion", &SpotLightDesc::motion},
               Field{"later_directions", &SpotLightDesc::later_directions});
/// Fields of `LightProfile`, with names and limits.
template <>
inline constexpr auto fields<LightProfile> = all_fields(
    Field{"polar angles", &LightProfile::polar_angles}, Field{"azimuths", &LightProfile::azimuths},
    Field{"intensities", &LightProfile::intensities});
/// Fields of `ProfileLightDesc`, with names and limits.
template <>
inline constexpr auto fields<ProfileLightDesc> = all_fields(
    Field{"name", &ProfileLightDesc::name}, Field{"position", &ProfileLightDesc::position},
    Field{"axes", &ProfileLightDesc::world_from_light},
    Number{"scale", &ProfileLightDesc::scale, Limits::at_least(0.0f)},
    Field{"profile", &ProfileLightDesc::profile}, Field{"motion", &ProfileLightDesc::motion});
/// Fields of `DirectionalLightDesc`, with names and limits.
template <>
inline constexpr auto fields<DirectionalLightDesc> =
    all_fields(Field{"name", &DirectionalLightDesc::name},
               Field{"direction", &DirectionalLightDesc::direction},
               Number{"illuminance", &DirectionalLightDesc::illuminance, Limits::at_least(0.0f)},
               Field{"later_directions", &DirectionalLightDesc::later_directions});
/// Fields of `EnvironmentLightDesc`, with names and limits.
template <>
inline constexpr auto fields<EnvironmentLightDesc> =
    all_fields(Field{"radiance", &EnvironmentLightDesc::radiance},
               Field{"rotation", &EnvironmentLightDesc::world_from_environment});

}  // namespace bdpt
