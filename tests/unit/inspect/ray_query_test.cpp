#include <bdpt/error.h>
#include <bdpt/scene.h>
#include <bdpt/tools/ray_query.h>
#include <bdpt/tools/scene_builder.h>

#include "catch.hpp"

#include <glm/geometric.hpp>

#include <limits>
#include <string>

namespace bdpt::ray_query_test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// A floor at y = 0, a ball on it, a pane that is wholly transparent on its left, and a lamp.
Scene stage()
{
    SceneBuilder builder;
    const MaterialId grey = builder.add(MaterialDesc{});
    MaterialDesc glazed;
    glazed.alpha_mode = AlphaMode::blend;
    glazed.base_color_texture = TextureRef{
        .image = builder.add(TexelImage{
            .width = 4,
            .height = 1,
            .bytes = {255, 255, 255, 0, 255, 255, 255, 0, 255, 255, 255, 1, 255, 255, 255, 1},
            .channels = 4,
            .type = TexelType::unorm8}),
        .wrap_u = Wrap::clamp_to_edge};
    const MaterialId pane = builder.add(glazed);
    builder.place(builder.add(quad_mesh({-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5})), grey)
        .name = "floor";
    Mat4 raised(1.0f);
    raised[3] = {0.0f, 1.0f, 0.0f, 1.0f};
    InstanceDesc& ball = builder.place(builder.add(sphere_mesh(0.5f, 128)), grey, raised);
    ball.name = "ball";
    Mat4 later = raised;
    later[3].x = 2.0f;
    ball.motion = {raised, later};
    builder.place(builder.add(quad_mesh({-1, 1, 3}, {1, 1, 3}, {1, 2, 3}, {-1, 2, 3})), pane).name =
        "pane";
    builder.add(PointLightDesc{
        .name = "bulb", .position = {0.0f, 4.0f, 0.0f}, .intensity = Rgb(1.0f), .radius = 0.25f});
    return Scene(builder.take());
}

}  // namespace

TEST_CASE("a ray query tells what it meets", "[ray_query]")
{
    const Scene scene = stage();
    const auto floor = first_hit(scene, {2.5f, 3.0f, -2.5f}, {0.0f, -7.0f, 0.0f});
    REQUIRE(floor);
    CHECK(scene.description().instances[floor->instance.value()].name == "floor");
    CHECK(floor->distance == Approx(3.0f));
    CHECK(glm::distance(floor->position, Vec3(2.5f, 0.0f, -2.5f)) < 1e-5f);
    CHECK(floor->geometric_normal == Vec3(0.0f, 1.0f, 0.0f));
    CHECK(floor->shading_normal == Vec3(0.0f, 1.0f, 0.0f));
    CHECK(floor->is_front);
    CHECK(floor->uv.x == Approx(0.75f));
    CHECK(floor->uv.y == Approx(0.25f));
    const auto from_below = first_hit(scene, {2.5f, -3.0f, -2.5f}, {0.0f, 1.0f, 0.0f});
    REQUIRE(from_below);
    CHECK_FALSE(from_below->is_front);
    CHECK(from_below->geometric_normal == Vec3(0.0f, 1.0f, 0.0f));
    CHECK(from_below->shading_normal == Vec3(0.0f, 1.0f, 0.0f));

    const auto ball = first_hit(scene, {0.3f, 1.0f, -4.0f}, {0.0f, 0.0f, 1.0f});
    REQUIRE(ball);
    CHECK(scene.description().instances[ball->instance.value()].name == "ball");
    CHECK(ball->distance == Approx(4.0f - 0.4f).epsilon(1e-3));
    CHECK(ball->shading_normal.x == Approx(0.6f).margin(0.02));
    CHECK_FALSE(first_hit(scene, {0.3f, 1.0f, -4.0f}, {0.0f, 0.0f, -1.0f}));

    const auto bulb = first_hit(scene, {0.0f, 4.0f, 4.0f}, {0.0f, 0.0f, -1.0f});
    REQUIRE(bulb);
    CHECK_FALSE(bulb->instance);
    CHECK(bulb->distance == Approx(3.75f));
}

TEST_CASE("a ray query sees the scene at its time", "[ray_query]")
{
    const Scene scene = stage();
    const Vec3 behind(2.0f, 1.0f, -4.0f);
    CHECK_FALSE(first_hit(scene, behind, {0.0f, 0.0f, 1.0f}, 0.0f));
    CHECK(first_hit(scene, behind, {0.0f, 0.0f, 1.0f}, 1.0f));
    CHECK(is_visible(scene, behind, {2.0f, 1.0f, 4.0f}, 0.0f));
    CHECK_FALSE(is_visible(scene, behind, {2.0f, 1.0f, 4.0f}, 1.0f));
}

TEST_CASE("a ray query passes what is wholly transparent, and nothing else", "[ray_query]")
{
    const Scene scene = stage();
    const auto met = [&](float x) {
        const auto hit = first_hit(scene, {x, 1.75f, 4.0f}, {0.0f, 0.0f, -1.0f});
        return hit ? scene.description().instances[hit->instance.value()].name : std::string();
    };
    CHECK(met(-0.5f).empty());
    CHECK(met(0.5f) == "pane");  // it takes 0.4 % of the light away
    CHECK(is_visible(scene, {-0.5f, 1.75f, 4.0f}, {-0.5f, 1.75f, -4.0f}));
    CHECK_FALSE(is_visible(scene, {0.5f, 1.75f, 4.0f}, {0.5f, 1.75f, -4.0f}));
}

TEST_CASE("visibility ends at both points", "[ray_query]")
{
    const Scene scene = stage();
    CHECK(is_visible(scene, {0.0f, 1.0f, -4.0f}, {0.0f, 1.0f, -0.6f}));  // before the ball
    CHECK_FALSE(is_visible(scene, {0.0f, 1.0f, -4.0f}, {0.0f, 1.0f, 2.0f}));
    CHECK_FALSE(is_visible(scene, {0.0f, 1.0f, 2.0f}, {0.0f, 1.0f, -4.0f}));
    CHECK(is_visible(scene, {1.0f, 1.0f, 1.0f}, {1.0f, 1.0f, 1.0f}));
}

TEST_CASE("ray queries refuse what is no ray", "[ray_query]")
{
    const Scene scene = stage();
    const Vec3 up(0.0f, 1.0f, 0.0f);
    CHECK_THROWS_AS(first_hit(scene, {nan, 0.0f, 0.0f}, up), Error);
    CHECK_THROWS_AS(first_hit(scene, {3e30f, 0.0f, 0.0f}, up), Error);
    CHECK_THROWS_AS(first_hit(scene, up, Vec3(0.0f)), Error);
    CHECK_THROWS_AS(first_hit(scene, up, {0.0f, nan, 0.0f}), Error);
    CHECK_THROWS_AS(first_hit(scene, up, up, 1.5f), Error);
    CHECK_THROWS_AS(first_hit(scene, up, up, nan), Error);
    CHECK_THROWS_AS(is_visible(scene, up, {0.0f, nan, 0.0f}), Error);
}

}  // namespace bdpt::ray_query_test
