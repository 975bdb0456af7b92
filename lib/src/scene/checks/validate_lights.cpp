#include "scene/checks/validate.h"

#include "geometry/placed_mesh.h"
#include "math/elementary.h"
#include "scene/checks/value_checks.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <tuple>
#include <variant>
#include <vector>

namespace bdpt {
namespace {

void check_direction(const std::string& item, Vec3 direction)
{
    if (!all_finite(&direction[0], 3) || !(dot(direction, direction) > 0.0f)) {
        fail(item, ": direction is zero or not finite");
    }
}

void check_position(const std::string& item, Vec3 position, float reach)
{
    if (!all_finite(&position[0], 3)) {
        fail(item, ": position is not finite");
    }
    const float extent =
        std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)});
    if (extent > reach) {
        fail(item, ": is ", extent, limit_text(reach));
    }
}

void check_radius(const std::string& item, float radius, Rgb intensity)
{
    constexpr float least = 1e-15f;  // keeps the area of the sphere a normal float
    constexpr float most = 1e15f;
    if (radius == 0.0f) {
        return;
    }
    if (!(radius >= least && radius <= most)) {
        fail(item, ": radius is ", radius, ", neither 0 nor in [", least, ", ", most, "]");
    }
    const Rgb radiance = intensity / (pi * radius * radius);
    if (!all_finite(&radiance[0], 3)) {
        fail(item, ": radius ", radius, " is too small for the intensity");
    }
}

void check_ascending(const std::string& item, const char* what, const std::vector<float>& angles)
{
    for (std::size_t i = 0; i < angles.size(); ++i) {
        if (!std::isfinite(angles[i]) || (i > 0 && !(angles[i] > angles[i - 1]))) {
            fail(item, ": ", what, " ", i, " is ", angles[i], ", not above the one before");
        }
    }
}

void check(const LightProfile& profile, const std::string& item)
{
    constexpr float rounding = 1e-5f;
    const std::vector<float>& polar = profile.polar_angles;
    const std::vector<float>& azimuths = profile.azimuths;
    if (polar.size() < 2 || azimuths.empty() ||
        profile.intensities.size() != polar.size() * azimuths.size()) {
        fail(item, ": ", polar.size(), " polar angles and ", azimuths.size(), " azimuths, but ",
             profile.intensities.size(), " intensities");
    }
    check_ascending(item, "polar angle", polar);
    check_ascending(item, "azimuth", azimuths);
    check_range(item, "polar angle", polar.front(), 0.0f, pi + rounding);
    check_range(item, "polar angle", polar.back(), 0.0f, pi + rounding);
    check_range(item, "azimuth", azimuths.front(), -2.0f * pi - rounding, 2.0f * pi + rounding);
    check_range(item, "turn of the azimuths", azimuths.back() - azimuths.front(), 0.0f,
                2.0f * pi + rounding);
    for (const float intensity : profile.intensities) {
        check_range(item, "intensity", intensity, 0.0f, any_positive);
    }
}

void check_image(const std::string& item, const Image& image)
{
    if (image.width < 1 || image.height < 1 ||
        image.pixels.size() != area(image.width, image.height)) {
        fail(item, ": image of ", image.width, " x ", image.height, " with ", image.pixels.size(),
             " pixels");
    }
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const Rgb& pixel = image.pixels[i];
        const float least = std::min({pixel.r, pixel.g, pixel.b});
        if (least >= 0.0f && pixel.r + pixel.g + pixel.b <= any_positive) {
            continue;  // formatting the position would dominate the time
        }
        const auto column = i % static_cast<std::size_t>(image.width);
        const auto row = i / static_cast<std::size_t>(image.width);
        check_color(item + ": pixel (" + std::to_string(column) + ", " + std::to_string(row) + ")",
                    "radiance", pixel, any_positive);
    }
}

void check_rotation(const std::string& item, const Mat3& m)
{
    constexpr float rounding = 1e-4f;
    for (int a = 0; a < 3; ++a) {
        for (int b = a; b < 3; ++b) {
            const float expected = a == b ? 1.0f : 0.0f;
            if (!(std::abs(dot(m[a], m[b]) - expected) <= rounding)) {
                fail(item, ": axes are not orthonormal");
            }
        }
    }
}

/// Tests whether a field is checked for every kind of light: here, by its limits, or by
/// `check_motion`.
template <typename Field>
constexpr bool is_always_checked(const Field& field)
{
    if constexpr (requires { field.limits; }) {
        return true;
    } else {
        return field.name == "name" || field.name == "position" || field.name == "direction" ||
               field.name == "axes" || field.name == "motion" || field.name == "later_directions";
    }
}

/// Checks specific to one kind of light; kinds without any have no function here.
struct OwnCheck {
    const std::string& item;
    const std::vector<float>& profile_peaks;  // [cd]

    template <typename Light>
    void operator()(const Light& /*light*/) const
    {
        static_assert(
            std::apply([](const auto&... field) { return (is_always_checked(field) && ...); },
                       fields<Light>),
            "give a number limits in its list of fields, or check here what is unusual");
    }

    void operator()(const PointLightDesc& light) const
    {
        check_radius(item, light.radius, light.intensity);
    }

    void operator()(const SpotLightDesc& light) const
    {
        check_radius(item, light.radius, light.intensity);
        check_range(item, "inner cone angle", light.inner_cone_angle, 0.0f, 0.5f * pi);
        check_range(item, "outer cone angle", light.outer_cone_angle, 1e-4f, 0.5f * pi + 1e-6f);
        if (!(light.inner_cone_angle < light.outer_cone_angle)) {
            fail(item, ": inner cone angle ", light.inner_cone_angle,
                 " is not below the outer cone angle ", light.outer_cone_angle);
        }
    }

    void operator()(const ProfileLightDesc& light) const
    {
        const auto profile = static_cast<std::size_t>(light.profile);
        if (profile >= profile_peaks.size()) {
            fail(item, ": profile ", profile, ", but the number of profiles is ",
                 profile_peaks.size());
        }
        check_color(item, "intensity", light.scale * profile_peaks[profile], any_positive);
    }

    void operator()(const EnvironmentLightDesc& light) const
    {
        // Compact texels are finite and not negative.
        if (!light.radiance.texels()) {
            const Image none;
            const Image* const image = light.radiance.floats();
            check_image(item, image != nullptr ? *image : none);
        }
        if (!all_finite(&light.world_from_environment[0][0], 9)) {
            fail(item, ": rotation is not finite");
        }
    }
};

/// Checks the common members of lights by name, then the specific ones.
template <typename Light>
void check(const Light& light, std::size_t index, float reach,
           const std::vector<float>& profile_peaks)
{
    const std::string item = light_label(light, index);
    if constexpr (requires { light.position; }) {
        check_position(item, light.position, reach);
    }
    if constexpr (requires { light.direction; }) {
        check_direction(item, light.direction);
    }
    if constexpr (requires { light.world_from_light; }) {
        check_rotation(item, light.world_from_light);
    }
    check_own_limits(item, light);
    OwnCheck{item, profile_peaks}(light);
}

}  // namespace

void validate_lights(const SharedSceneDesc& desc, float reach)
{
    std::vector<float> peaks;
    for (std::size_t i = 0; i < desc.profiles.size(); ++i) {
        const std::vector<float>& intensities = desc.profiles[i].intensities;
        check(desc.profiles[i], label("light profile", i, ""));
        peaks.push_back(*std::max_element(intensities.begin(), intensities.end()));
    }
    std::size_t environments = 0;
    for (std::size_t i = 0; i < desc.lights.size(); ++i) {
        std::visit([&](const auto& light) { check(light, i, reach, peaks); }, desc.lights[i]);
        environments += std::holds_alternative<EnvironmentLightDesc>(desc.lights[i]) ? 1U : 0U;
    }
    if (environments > 1) {
        fail("there are ", environments, " environment lights, but at most one is allowed");
    }
}

std::string limit_text(float reach)
{
    std::ostringstream text;
    text << " m from the origin, but " << reach << " m is the most";
    if (reach < max_coordinate) {
        text << ", because an instanced or moving mesh is scaled down very much";
    }
    return text.str();
}

}  // namespace bdpt
