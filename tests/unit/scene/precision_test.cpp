#include "scene/checks/validate.h"

#include <bdpt/error.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/render.h>
#include <bdpt/scene.h>

#include "catch.hpp"
#include "scene/world.h"
#include "scene_builder.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::precision_test {
namespace {

using test::SceneBuilder;

std::vector<std::string> warnings_of(const SceneDesc& desc)
{
    return precision_warnings(desc, SceneGeometry(desc));
}

/// A square at distance `size` that is twice as large, seen from the origin.
SceneBuilder wall(float size, const MaterialDesc& material)
{
    SceneBuilder builder;
    builder.quad({-size, -size, -size}, {size, -size, -size}, {size, size, -size},
                 {-size, size, -size}, material);
    return builder;
}

Rgb center_pixel(SceneDesc desc, IntegratorKind integrator)
{
    const Scene scene(std::move(desc));
    RenderOptions options;
    options.film.width = 1;
    options.film.height = 1;
    options.sampling.samples = {0, 16};
    options.integrator = integrator;
    return render(scene, test::camera_at({0, 0, 0}, {0, 0, -1}, 0.5f), options)
        .film.develop()
        .at(0, 0);
}

/// A room of several materials, whose lengths are multiplied by `scale`, and the light from places
/// with them: a lamp, a bulb, a lantern, a sun and a sky. Every radiance is the same at any scale.
SceneDesc room_of_size(float scale)
{
    SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.7f)), test::plastic(Rgb(0.6f), 0.3f));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    builder.sphere({0.4f, -0.7f, 0.4f}, 0.3f, test::glass(0.0f), 16);
    MaterialDesc sheet = test::lambertian({0.4f, 0.8f, 0.5f});
    sheet.diffuse_transmission.factor = 0.5f;
    builder.sphere({-0.4f, -0.3f, 0.0f}, 0.4f, sheet, 12);
    for (InstanceDesc& instance : builder.desc.instances) {
        // The transforms of instances cannot scale that much.
        for (Vec3& p : builder.desc.meshes[static_cast<std::size_t>(instance.mesh)].positions) {
            p = scale * Vec3(instance.world_from_object * Vec4(p, 1.0f));
        }
        instance.world_from_object = Mat4(1.0f);
    }
    const Rgb intensity = scale * scale * Rgb(0.3f);
    builder.light(
        PointLightDesc{.position = scale * Vec3(-0.5f, 0.0f, 0.5f), .intensity = intensity});
    builder.light(PointLightDesc{.position = scale * Vec3(0.6f, 0.3f, 0.2f),
                                 .intensity = intensity,
                                 .radius = 0.125f * scale});
    builder.light(DirectionalLightDesc{.direction = {0.1f, -1.0f, -0.3f}, .illuminance = Rgb(2)});
    builder.light(EnvironmentLightDesc{
        .radiance = Image{.width = 2, .height = 2, .pixels = {Rgb(1), Rgb(2), Rgb(0), Rgb(0.5f)}}});
    return std::move(builder.desc);
}

/// Returns the image of that room through a lens, by a few samples.
Image image_of_size(const Scene& scene, float scale, const RenderOptions& options)
{
    CameraDesc camera = test::with_lens(test::room_camera(), 0.05f * scale, 3.4f * scale);
    camera.world_from_camera[3] *= Vec4(Vec3(scale), 1.0f);
    return render(scene, camera, options).film.develop();
}

}  // namespace

TEST_CASE("surfaces are as bright at any scale", "[precision]")
{
    // From 1e10 m on the square of the length of the normal of the area is infinite, below 1e-10 m
    // it is zero.
    for (const float size : {1e-12f, 1e-9f, 1.0f, 1e8f, 3e9f, 1e10f, 1e12f, 9e14f}) {
        CAPTURE(size);
        const World world(wall(size, test::emitter(Rgb(1.0f))).desc);
        const auto hit = world.intersect({.p = {0, 0, 0}}, {0, 0, -1}, {});
        REQUIRE(hit.has_value());
        CHECK(hit->end.ng == Vec3(0, 0, 1));
        CHECK(hit->emission == Rgb(1.0f));
        for (const IntegratorKind integrator : {IntegratorKind::pt, IntegratorKind::bdpt}) {
            CHECK(center_pixel(wall(size, test::emitter(Rgb(1.0f))).desc, integrator).g ==
                  Approx(1.0f).epsilon(0.01));
        }
    }
}

TEST_CASE("every integrator renders the same image at any scale", "[precision]")
{
    // Powers of two, so that nothing is rounded in another way: from 1e-10 to 1e12.
    const float scale = std::ldexp(1.0f, GENERATE(-33, -16, 23, 40));
    const Scene usual(room_of_size(1.0f));
    const Scene scaled(room_of_size(scale));
    RenderOptions options;
    options.film.width = 24;
    options.film.height = 18;
    options.sampling.samples = {0, 4};
    options.transport.max_depth = 5;
    options.sampling.light_samples = 2;
    const auto check = [&](const std::string& how) {
        const Image expected = image_of_size(usual, 1.0f, options);
        const Image image = image_of_size(scaled, scale, options);
        Rgb sum(0.0f);
        Rgb difference(0.0f);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            sum += expected.pixels[i];
            difference += abs(image.pixels[i] - expected.pixels[i]);
        }
        CAPTURE(how, scale);
        CHECK(difference.g <= 1e-3f * sum.g);
    };
    for (const IntegratorKind integrator :
         {IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::mis, IntegratorKind::lt,
          IntegratorKind::bdpt, IntegratorKind::vcm}) {
        options.integrator = integrator;
        check(std::string(to_name(integrator)));
    }
    options.integrator = IntegratorKind::bdpt;
    options.bidirectional.light_paths = 0.25;
    options.bidirectional.connections = 8.0;
    options.bidirectional.connection_rays = 4.0;
    check("chosen connections");
}

TEST_CASE("a camera beyond the reach of rays is refused, where it would see nothing", "[precision]")
{
    // In the space of the shared mesh 1 m is 1e9 units.
    SceneBuilder builder = wall(1e7f, test::emitter(Rgb(1.0f)));
    const MeshId small = builder.add_mesh(builder.desc.meshes[0]);
    for (int use = 0; use < 2; ++use) {
        builder.place(small, test::lambertian(Rgb(0.5f)), glm::scale(Mat4(1.0f), Vec3(1e-9f)));
    }
    const Scene scene(std::move(builder.desc));
    const auto refusal = [&scene](float z) -> std::string {
        CameraDesc camera = test::camera_at({0, 0, 0}, {0, 0, -1}, 0.5f);
        camera.name = "far";
        camera.motion = {camera.world_from_camera};
        camera.motion[0][3].z = z;
        RenderOptions options;
        options.integrator = IntegratorKind::bdpt;
        options.film.width = 1;
        options.film.height = 1;
        options.sampling.samples = {0, 1};
        try {
            (void)render(scene, camera, options);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::invalid_input);
            return error.what();
        }
        return "";
    };
    CHECK(refusal(7e8f).empty());
    CHECK(refusal(1e9f).find("camera \"far\": is 1e+09 m from the origin, but 8e+08 m is the most "
                             "in this scene") == 0);
}

TEST_CASE("what is small for its distance is named", "[precision]")
{
    SceneBuilder builder = wall(1.0f, test::lambertian(Rgb(0.5f)));
    CHECK(warnings_of(builder.desc).empty());
    builder.desc.instances[0].name = "house";
    builder.desc.instances[0].world_from_object =
        glm::translate(Mat4(1.0f), Vec3(1e8f, 0.0f, 0.0f));
    const std::vector<std::string> warnings = warnings_of(builder.desc);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find("instance 0 \"house\": is 2 m large, but its points have a precision of "
                           "7") == 0);
    CHECK(warnings[0].find("1e+08 m from the origin") != std::string::npos);
    builder.light(PointLightDesc{});
    CHECK(Scene(builder.desc).warnings() == warnings);
    CHECK(warnings_of(wall(1e8f, test::lambertian(Rgb(0.5f))).desc).empty());
}

TEST_CASE("what extends too far to be shaded exactly is named", "[precision]")
{
    CHECK(warnings_of(wall(9e11f, test::lambertian(Rgb(0.5f))).desc).empty());
    const auto warnings = warnings_of(wall(7e13f, test::lambertian(Rgb(0.5f))).desc);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0] ==
          "instance 0: extends 7e+13 m from the origin: beyond 1e+12 m the image "
          "may be wrong");
}

TEST_CASE("a lamp that is too near to a vast plane is named", "[precision]")
{
    const auto with_lamp = [](float size, float height) {
        SceneBuilder builder;
        builder.quad({-size, 0, size}, {size, 0, size}, {size, 0, -size}, {-size, 0, -size},
                     test::lambertian(Rgb(0.5f)));
        builder.light(PointLightDesc{.name = "lamp", .position = {0.0f, height, 0.0f}});
        return warnings_of(builder.desc);
    };
    CHECK(with_lamp(1e4f, 2.0f).empty());
    CHECK(with_lamp(1e8f, 200.0f).empty());
    const std::vector<std::string> warnings = with_lamp(1e8f, 2.0f);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].find("instance 0: its points have a precision of 7") == 0);
    CHECK(warnings[0].find("but point light 0 \"lamp\" is nearer") != std::string::npos);
}

}  // namespace bdpt::precision_test
