#include <bdpt/error.h>
#include <bdpt/render.h>
#include <bdpt/scene.h>

#include "catch.hpp"
#include "scene/world.h"
#include "scene_builder.h"

#include <glm/gtc/matrix_transform.hpp>

#include <string>
#include <utility>

namespace bdpt::light_power_test {
namespace {

using test::SceneBuilder;

/// A floor, and above it a lamp of 2 x 2 m.
SceneBuilder lit_floor(float radiance)
{
    SceneBuilder builder;
    builder.quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, test::lambertian(Rgb(0.5f)));
    builder.lamp(1.5f, 1.0f, Rgb(radiance));
    builder.desc.instances[1].name = "lamp";
    return builder;
}

std::string refusal(SceneDesc desc)
{
    try {
        const Scene scene(std::move(desc));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        return error.what();
    }
    return "";
}

FilmDefects defects(SceneDesc desc, IntegratorKind integrator)
{
    const Scene scene(std::move(desc));
    const CameraDesc camera = test::camera_at({0.0f, 1.0f, 4.0f}, {0.0f, 0.5f, 0.0f}, 0.9f);
    RenderOptions options;
    options.film.width = 8;
    options.film.height = 8;
    options.sampling.samples = {0, 16};
    options.integrator = integrator;
    return render(scene, camera, options).film.defects();
}

}  // namespace

TEST_CASE("a light whose power leaves the range of floats is refused by name", "[light_power]")
{
    CHECK(refusal(lit_floor(3e38f).desc) ==
          "instance 1 \"lamp\": triangle 0 with an emission of 3e+38 nit shines with inf lm, but "
          "1e+36 lm is the most");
    SceneDesc scaled = lit_floor(1e20f).desc;
    scaled.instances[1].world_from_object = glm::scale(Mat4(1.0f), Vec3(1e10f));
    CHECK(refusal(scaled).find("instance 1 \"lamp\": triangle 0 with an emission of 1e+20 nit") ==
          0);
    SceneBuilder with_point = lit_floor(1.0f);
    with_point.light(PointLightDesc{.name = "star", .intensity = Rgb(3e38f)});
    CHECK(refusal(with_point.desc) ==
          "point light 0 \"star\": shines with inf lm, but 1e+36 lm is the most");
    SceneBuilder with_sun = lit_floor(1.0f);
    with_sun.light(DirectionalLightDesc{.illuminance = Rgb(3e37f)});
    CHECK(refusal(with_sun.desc).find("directional light 0: shines with ") == 0);
}

TEST_CASE("an emitter within glass has the material that surroundings give it", "[light_power]")
{
    SceneBuilder builder;
    builder.cube({0, 0, 0}, 1.0f, test::glass(0.0f));
    builder.cube({0, 0, 0}, 0.5f, test::emitter(Rgb(1e37f)));
    CHECK(refusal(builder.desc).find("instance 1: triangle 0 with an emission of 1e+37 nit") == 0);
}

TEST_CASE("what the greatest power brings is finite", "[light_power]")
{
    // pi * 2 m^2 for each of two triangles
    const SceneDesc desc = lit_floor(0.9f * max_light_power / 6.2832f).desc;
    for (const IntegratorKind integrator :
         {IntegratorKind::bdpt, IntegratorKind::mis, IntegratorKind::lt}) {
        const FilmDefects found = defects(desc, integrator);
        CHECK(found.invalid == 0);
        CHECK(found.saturated > 0);
    }
}

TEST_CASE("light so faint that its power is no float does no harm", "[light_power]")
{
    SceneBuilder builder = lit_floor(1e-38f);
    builder.desc.instances[1].world_from_object = glm::scale(Mat4(1.0f), Vec3(1e-7f));
    const World world(builder.desc);
    REQUIRE(world.lights().size() == 2);
    CHECK(world.lights().emission_probability(LightId{0}) == 0.0f);
    CHECK_FALSE(world.lights().choose_for_emission(Vec2(0.5f)).has_value());
}

}  // namespace bdpt::light_power_test
