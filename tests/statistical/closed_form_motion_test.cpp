// A pixel is the mean of the still images of all times: a patch under lights that move, whose
// irradiance at each time is known on paper.

#include "catch.hpp"
#include "equal_means.h"
#include "lambertian_floor.h"
#include "moving_scenes.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace bdpt::test::closed_form_motion_test {
namespace {

double mean(const std::function<double(double)>& irradiance)
{
    constexpr int times = 4000;
    double sum = 0.0;
    for (int i = 0; i < times; ++i) {
        sum += irradiance((i + 0.5) / times) / times;
    }
    return sum;
}

void check_irradiance(SceneBuilder builder, const std::function<double(double)>& irradiance,
                      double detectable_bias = 0.01)
{
    const Scene scene(std::move(builder.desc));
    const CameraDesc camera = patch_camera();
    const double expected = static_cast<double>(floor_albedo) * mean(irradiance) / pi_double;
    for (const auto kind :
         {IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::mis, IntegratorKind::bdpt}) {
        RenderOptions options;
        options.integrator = kind;
        options.transport.max_depth = 2;
        TileMeans means(scene, camera, options);
        const double bias = kind == IntegratorKind::pt ? 0.03 : detectable_bias;
        const MeanComparison result = compare_means(means, expected, {.detectable_bias = bias});
        INFO("integrator " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.found_bias < 1e-3);
    }
}

/// Of a polygon of unit radiance seen from the origin of a floor, by the contour integral of
/// Lambert.
double polygon(const std::array<glm::dvec3, 4>& corners)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 a = normalize(corners[i]);
        const glm::dvec3 b = normalize(corners[(i + 1) % 4]);
        sum += 0.5 * std::acos(dot(a, b)) * normalize(cross(a, b)).y;
    }
    return std::abs(sum);
}

const std::array<glm::dvec3, 4> square{
    {{-0.3, 0, -0.4}, {0.3, 0, -0.4}, {0.3, 0, 0.4}, {-0.3, 0, 0.4}}};

}  // namespace

TEST_CASE("point and sphere lights that move: the mean of their irradiances",
          "[closed-form][motion][long]")
{
    const auto height = [](double t) { return 0.6 + 1.2 * t; };
    SceneBuilder point = lambertian_floor();
    point.light(PointLightDesc{
        .position = {0.0f, 0.6f, 0.0f}, .intensity = Rgb(2.0f), .motion = {{0.0f, 1.8f, 0.0f}}});
    check_irradiance(std::move(point), [&](double t) { return 2.0 / (height(t) * height(t)); });

    // E = pi L (r / d)^2 cos, and pi L r^2 is the intensity.
    SceneBuilder ball = lambertian_floor();
    ball.light(PointLightDesc{.position = {-0.5f, 0.8f, 0.0f},
                              .intensity = Rgb(2.0f),
                              .radius = 0.3f,
                              .motion = {{0.0f, 0.8f, 0.0f}, {1.5f, 0.8f, 0.0f}}});
    check_irradiance(std::move(ball), [](double t) {
        const double x = t < 0.5 ? -0.5 + t : 3.0 * (t - 0.5);
        const double squared = x * x + 0.64;
        return 2.0 * 0.8 / (squared * std::sqrt(squared));
    });
}

TEST_CASE("a sun that turns: the mean of its cosines", "[closed-form][motion]")
{
    SceneBuilder sun = lambertian_floor();
    sun.light(DirectionalLightDesc{.direction = {0.0f, -1.0f, 0.0f},
                                   .illuminance = Rgb(2.0f),
                                   .later_directions = {{2.0f, -1.0f, 0.0f}}});
    check_irradiance(std::move(sun), [](double t) { return 2.0 / std::sqrt(1.0 + 4.0 * t * t); });
}

TEST_CASE("an emitter that travels, turns and grows: the mean of its irradiances",
          "[closed-form][motion][long]")
{
    // Between two steps matrices and vertices go along straight lines, so the corners do.
    const auto pose = [](float t) {
        return glm::scale(glm::rotate(translation({-0.4f + t, 0.8f + 0.5f * t, 0.0f}), 0.9f * t,
                                      Vec3(0.0f, 0.0f, 1.0f)),
                          Vec3(0.5f + 1.5f * t, 1.0f, 1.0f + t));
    };
    const auto corner = [&](std::size_t i, double t) {
        const double u = 2.0 * t - (t < 0.5 ? 0.0 : 1.0);
        const glm::dmat4 a(pose(t < 0.5 ? 0.0f : 0.5f));
        const glm::dmat4 b(pose(t < 0.5 ? 0.5f : 1.0f));
        return glm::dvec3(((1.0 - u) * a + u * b) * glm::dvec4(square[i], 1.0));
    };
    const auto irradiance = [&](double t) {
        return 3.0 * polygon({corner(0, t), corner(1, t), corner(2, t), corner(3, t)});
    };
    MeshDesc mesh;
    for (const glm::dvec3& p : square) {
        mesh.positions.emplace_back(p);
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};  // the front looks down
    SceneBuilder rigid = lambertian_floor();
    rigid.place(rigid.add_mesh(mesh), emitter(Rgb(3.0f), Rgb(0.0f)), Mat4(1.0f));
    move_last(rigid, 2, pose);
    check_irradiance(std::move(rigid), irradiance);

    SceneBuilder deforming = lambertian_floor();
    deform(mesh, 2, [&](Vec3 p, float t) { return Vec3(pose(t) * Vec4(p, 1.0f)); });
    deforming.place(deforming.add_mesh(mesh), emitter(Rgb(3.0f), Rgb(0.0f)), Mat4(1.0f));
    check_irradiance(std::move(deforming), irradiance);
}

TEST_CASE("a shutter of the sun: something between for a part of the time", "[closed-form][motion]")
{
    // A blind covers the patch until three quarters of the time are over.
    SceneBuilder builder = lambertian_floor();
    builder.light(DirectionalLightDesc{.direction = {0.0f, -1.0f, 0.0f}, .illuminance = Rgb(2.0f)});
    builder.quad({-2, 1, -2}, {2, 1, -2}, {2, 1, 2}, {-2, 1, 2}, lambertian(Rgb(0.0f)));
    move_last(builder, 2, [](float t) { return translation({4.0f * t - 1.0f, 0.0f, 0.0f}); });
    check_irradiance(
        std::move(builder), [](double t) { return t > 0.75 ? 2.0 : 0.0; }, 0.03);
}

}  // namespace bdpt::test::closed_form_motion_test
