// A small Lambertian patch under one area light: its radiance is albedo E / pi, and the irradiance
// E is known on paper. The patch is so small that E is constant over the film.

#include "catch.hpp"
#include "equal_means.h"
#include "lambertian_floor.h"

#include <cmath>
#include <vector>

namespace bdpt::test::closed_form_lights_test {
namespace {

void check_irradiance(SceneBuilder builder, double irradiance)
{
    const Scene scene(std::move(builder.desc));
    const CameraDesc camera = patch_camera();
    const double expected = static_cast<double>(floor_albedo) * irradiance / pi_double;
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt}) {
        RenderOptions options;
        options.integrator = kind;
        options.transport.max_depth = 2;
        TileMeans means(scene, camera, options);
        // Without light sampling most samples miss the light.
        const double bias = kind == IntegratorKind::pt ? 0.03 : 0.01;
        const MeanComparison result = compare_means(means, expected, {.detectable_bias = bias});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        // Light sampling has next to no variance here, so a part in a thousand is rounding, the
        // width of the patch and the corners of polygons.
        CHECK(result.found_bias < 1e-3);
    }
}

/// A sphere of the given radiance, seen from the origin in the direction of `center`.
SceneBuilder ball(Vec3 center, float radius, float radiance)
{
    SceneBuilder builder = lambertian_floor();
    builder.light(PointLightDesc{.position = center,
                                 .intensity = Rgb(radiance * 3.14159265f * radius * radius),
                                 .radius = radius});
    return builder;
}

}  // namespace

TEST_CASE("sphere light: E = pi L (r / d)^2 cos", "[closed-form][long]")
{
    // The cone with half angle s around a direction at angle a from the normal projects onto the
    // unit disk as an ellipse with half axes sin s and sin s cos a: area pi sin^2 s cos a.
    constexpr float radiance = 3.0f;
    struct Place {
        float angle;
        float radius;  // at distance 1
    };
    for (const Place place : {Place{0.0f, 0.8f}, Place{0.3f, 0.3f}, Place{0.9f, 0.5f}}) {
        const Vec3 center(-std::sin(place.angle), std::cos(place.angle), 0.0f);
        const auto radius = static_cast<double>(place.radius);
        INFO("angle " << place.angle << ", radius " << place.radius);
        check_irradiance(ball(center, place.radius, radiance),
                         pi_double * static_cast<double>(radiance) * radius * radius *
                             std::cos(static_cast<double>(place.angle)));
    }
}

TEST_CASE("sphere light, half below the horizon: E = L (s - sin s cos s)", "[closed-form][long]")
{
    // The upper half of a cone around a horizontal axis projects onto the unit disk as the segment
    // that the chord at distance cos s from the centre cuts off.
    constexpr float radiance = 3.0f;
    const double s = std::asin(0.8);
    check_irradiance(ball({-0.5f, 0.0f, 0.0f}, 0.4f, radiance),
                     static_cast<double>(radiance) * (s - std::sin(s) * std::cos(s)));
}

TEST_CASE("sphere spot light: the cone is that of the direction of emission", "[closed-form][long]")
{
    // The patch looks straight up at a sphere that shines straight down, with no fall-off between
    // the cones: light arrives from the directions within the outer cone, however wide the sphere
    // looks. E = L pi sin^2(cone).
    constexpr float cone = 0.4f;
    constexpr float radius = 0.4f;
    SceneBuilder builder = lambertian_floor();
    builder.light(SpotLightDesc{.position = {0.0f, 0.8f, 0.0f},
                                .direction = {0.0f, -1.0f, 0.0f},
                                .intensity = Rgb(2.0f),
                                .inner_cone_angle = 0.9999f * cone,
                                .outer_cone_angle = cone,
                                .radius = radius});
    const double radiance = 2.0 / (pi_double * 0.16);
    const double sine = std::sin(0.4);
    check_irradiance(std::move(builder), radiance * pi_double * sine * sine);
}

TEST_CASE("profile light: E = I cos / d^2, with I between the angles of the grid", "[closed-form]")
{
    // -z of the profile points down and its x axis to +x. The patch lies at an angle of 0.6 rad
    // from the axis, towards azimuth 0.5: a fifth of the way from 0.5 to 1, half of that from 0
    // to 1.
    const Mat3 hanging(Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(0, 1, 0));
    const double distance = 1.3;
    const Vec3 to_patch(std::sin(0.6) * std::cos(0.5), std::sin(0.6) * std::sin(0.5),
                        -std::cos(0.6));
    SceneBuilder builder = lambertian_floor();
    builder.desc.profiles.push_back({.polar_angles = {0.0f, 0.5f, 1.0f},
                                     .azimuths = {0.0f, 1.0f},
                                     .intensities = {1.0f, 2.0f, 7.0f, 1.0f, 6.0f, 1.0f}});
    builder.light(ProfileLightDesc{.position = static_cast<float>(distance) * -(hanging * to_patch),
                                   .world_from_light = hanging,
                                   .scale = Rgb(3.0f)});
    const double intensity = 3.0 * (0.5 * (0.8 * 2.0 + 0.2 * 7.0) + 0.5 * (0.8 * 6.0 + 0.2 * 1.0));
    check_irradiance(std::move(builder), intensity * std::cos(0.6) / (distance * distance));
}

TEST_CASE("disk light of triangles: E = pi L R^2 / (R^2 + d^2)", "[closed-form]")
{
    constexpr int corners = 400;
    constexpr float radius = 0.7f;
    constexpr float height = 1.2f;
    MeshDesc disk;
    disk.positions.emplace_back(0.0f, height, 0.0f);
    for (int i = 0; i < corners; ++i) {
        const double phi = 2.0 * pi_double * i / corners;
        disk.positions.emplace_back(static_cast<double>(radius) * std::cos(phi), height,
                                    static_cast<double>(radius) * std::sin(phi));
        const auto next = static_cast<unsigned>((i + 1) % corners);
        disk.triangles.emplace_back(0U, static_cast<unsigned>(i) + 1, next + 1);  // looks down
    }
    SceneBuilder builder = lambertian_floor();
    const MeshId mesh = builder.add_mesh(std::move(disk));
    builder.place(mesh, emitter(Rgb(2.0f), Rgb(0.0f)), Mat4(1.0f));
    check_irradiance(std::move(builder), pi_double * 2.0 * 0.49 / (0.49 + 1.44));
}

TEST_CASE("quad light: the contour integral of Lambert", "[closed-form]")
{
    // E = L / 2 sum over the edges of angle * (unit normal of the plane of edge and eye) . n
    // [Arvo 1994, "The Irradiance Jacobian for Partially Occluded Polyhedral Sources", sec. 2].
    const std::vector<glm::dvec3> corners{
        {-0.3, 0.9, -0.5}, {0.8, 0.9, -0.5}, {0.8, 1.3, 0.7}, {-0.3, 1.3, 0.7}};
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 a = normalize(corners[i]);
        const glm::dvec3 b = normalize(corners[(i + 1) % 4]);
        sum += std::acos(dot(a, b)) * normalize(cross(a, b)).y;
    }
    SceneBuilder builder = lambertian_floor();
    builder.quad(Vec3(corners[0]), Vec3(corners[1]), Vec3(corners[2]), Vec3(corners[3]),
                 emitter(Rgb(2.0f), Rgb(0.0f)));
    check_irradiance(std::move(builder), std::abs(sum));
}

}  // namespace bdpt::test::closed_form_lights_test
