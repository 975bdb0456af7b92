#include "scene/world.h"

#include "catch.hpp"
#include "moving_scenes.h"
#include "scene_builder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <ctime>
#include <utility>
#include <vector>

namespace bdpt::world_test {
namespace {

using test::SceneBuilder;

MaterialDesc tinted_glass()
{
    MaterialDesc material = test::glass(0.0f);
    material.attenuation_color = {0.5f, 0.25f, 1.0f};
    material.attenuation_distance = 2.0f;
    return material;
}

}  // namespace

TEST_CASE("materials cost nothing before rays hit them, whatever their indices", "[world]")
{
    SceneBuilder builder;
    const MeshId triangle = builder.sphere_mesh(4);
    for (int i = 0; i < 2000; ++i) {
        MaterialDesc glass = test::glass(0.3f);
        glass.ior = 1.1f + 0.0004f * static_cast<float>(i);
        glass.dispersion = 0.2f;
        builder.place(triangle, glass, Mat4(1.0f));
    }
    const std::clock_t start = std::clock();
    const World world(std::move(builder.desc));
    // Three tables for each would take minutes.
    CHECK((std::clock() - start) / CLOCKS_PER_SEC < 20);
    CHECK(world.disperses());
}

TEST_CASE("Beer-Lambert: the attenuation colour is left after the attenuation distance", "[world]")
{
    SceneBuilder builder;
    builder.sphere({0, 0, 0}, 1.0f, tinted_glass(), 128);
    const World world(std::move(builder.desc));
    const auto front = world.intersect({.p = {0, 0, 5}}, {0, 0, -1}, {});
    const auto back = world.intersect({.p = {0, 0, -5}}, {0, 0, 1}, {});
    REQUIRE(front.has_value());
    REQUIRE(back.has_value());
    const Rgb inside = world.transmittance(front->end, back->end, {});
    CHECK(inside.r == Approx(0.5f).epsilon(0.01));
    CHECK(inside.g == Approx(0.25f).epsilon(0.01));
    CHECK(inside.b == Approx(1.0f));
    CHECK(world.transmittance(back->end, front->end, {}) == inside);
    // Outside there is nothing to absorb, and the sphere hides what is behind it.
    CHECK(world.transmittance({.p = {0, 0, 5}}, front->end, {}) == Rgb(1.0f));
    CHECK(world.transmittance({.p = {0, 0, 5}}, back->end, {}) == Rgb(0.0f));
    CHECK(world.transmittance_to_infinity(front->end, {0, 0, 1}, {}) == Rgb(1.0f));
    CHECK(world.transmittance_to_infinity(front->end, {0, 0, -1}, {}) == Rgb(0.0f));
}

TEST_CASE("emission is seen from the front, or from both sides", "[world]")
{
    for (const bool double_sided : {false, true}) {
        SceneBuilder builder;
        MaterialDesc material = test::emitter(Rgb(7.0f));
        material.double_sided = double_sided;
        builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, material);
        const World world(std::move(builder.desc));
        const auto front = world.intersect({.p = {0.1f, 0.2f, 3}}, {0, 0, -1}, {});
        const auto back = world.intersect({.p = {0.1f, 0.2f, -3}}, {0, 0, 1}, {});
        REQUIRE(front.has_value());
        REQUIRE(back.has_value());
        CHECK(front->emission == Rgb(7.0f));
        CHECK(back->emission == (double_sided ? Rgb(7.0f) : Rgb(0.0f)));
        CHECK(front->light.has_value());
        CHECK(world.counts().emissive_triangles == 2);
    }
}

TEST_CASE("lights are chosen by power, and dark ones never", "[world]")
{
    SceneBuilder builder;
    builder.light(PointLightDesc{.intensity = Rgb(3.0f)});
    builder.light(PointLightDesc{.intensity = Rgb(0.0f)});
    builder.light(PointLightDesc{.intensity = Rgb(1.0f)});
    const World world(std::move(builder.desc));
    CHECK(world.lights().emission_probability(LightId{0}) == Approx(0.75f));
    CHECK(world.lights().emission_probability(LightId{1}) == 0.0f);
    CHECK(world.lights().context_probability(LightId{2}, LightSampleContext{},
                                             LightSampling::power) == Approx(0.25f));
    for (int i = 0; i < 100; ++i) {
        const auto choice =
            world.lights().choose_for_emission({(static_cast<float>(i) + 0.5f) / 100.0f, 0.5f});
        REQUIRE(choice.has_value());
        CHECK(choice->id != LightId{1});
        CHECK(choice->probability == world.lights().emission_probability(choice->id));
    }
}

TEST_CASE("a scene without light or surfaces has none, and bounds of zero", "[world]")
{
    const World world(SceneDesc{});
    CHECK_FALSE(world.lights().choose_for_emission({0.5f, 0.5f}).has_value());
    CHECK_FALSE(world.lights().environment().has_value());
    CHECK_FALSE(world.intersect({}, {0, 0, 1}, {}).has_value());
    CHECK(world.bounds().max == Vec3(0.0f));
}

TEST_CASE("the detail of a mip-mapped texture depends on point and camera, not on the ray",
          "[world]")
{
    // Columns of 0 and 255 in turn, on a wall of 2 x 2 m.
    constexpr int size = 64;
    TexelImage stripes{.width = size, .height = size, .bytes = {}, .channels = 1};
    for (int i = 0; i < size * size; ++i) {
        stripes.bytes.push_back(i % 2 == 0 ? 0 : 255);
    }
    MaterialDesc material = test::lambertian(Rgb(1.0f));
    material.base_color_texture = TextureRef{};
    SceneBuilder builder;
    builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, material);
    builder.desc.images.push_back(stripes);
    const World plain(builder.desc);
    builder.desc.texture_filter = TextureFilter::mip_mapped;
    const World mipped(std::move(builder.desc));

    const float x = 0.5f * 2.0f / size;  // the middle of a black column
    const auto seen = [&](const World& world, Vec3 from, float pixel) {
        const PixelCone cone{.eye = {0, 0, 5}, .spread = pixel / 5.0f};
        const Vec3 direction = normalize(Vec3(x, 0.01f, 0) - from);
        const auto hit = world.first_hit({.p = from}, direction, {});
        REQUIRE(hit.has_value());
        return world.surface_at(*hit, direction, {}, cone).bsdf.base_color().r;
    };
    for (const Vec3 from : {Vec3(0, 0, 5), Vec3(0.4f, 0.3f, -1), Vec3(2, 0, 0.3f)}) {
        CHECK(seen(plain, from, 1.0f) == Approx(0.0f).margin(0.01));
        CHECK(seen(mipped, from, 0.0f) == Approx(0.0f).margin(0.01));
        CHECK(seen(mipped, from, 0.1f) == Approx(0.0f).margin(0.01));  // 3.2 texels wide
        CHECK(seen(mipped, from, 0.15f) == Approx(0.5f).margin(0.01));
    }
    const auto far = mipped.intersect({.p = {x, 0.01f, 5}}, {0, 0, -1}, {});
    CHECK(far->bsdf.base_color().r == Approx(0.0f).margin(0.01));  // without a camera, all detail
}

TEST_CASE("the bounds hold all that moves, from the first step to the last", "[world][motion]")
{
    // A square that travels, one that deforms, and both at once; out and back, then away.
    const auto at = [](float t) { return t < 0.5f ? Vec3(-8 * t, 0, 0) : Vec3(0, 0, 10 * t); };
    for (const bool by_instance : {false, true}) {
        for (const bool by_vertices : {false, true}) {
            SceneBuilder builder;
            builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0},
                         test::lambertian(Rgb(0.5f)));
            if (by_instance) {
                test::move_last(builder, 4, [&](float t) { return test::translation(at(t)); });
            }
            if (by_vertices) {
                test::deform(builder.desc.meshes[0], 4, [&](Vec3 p, float t) { return p + at(t); });
            }
            const float times = (by_instance ? 1.0f : 0.0f) + (by_vertices ? 1.0f : 0.0f);
            const Bounds bounds = Scene(std::move(builder.desc)).bounds();
            CAPTURE(by_instance, by_vertices);
            CHECK(bounds.min == Vec3(-1.0f - 2.0f * times, -1, 0));
            CHECK(bounds.max == Vec3(1, 1, 10.0f * times));
        }
    }
}

TEST_CASE("the detail of a mip-mapped texture follows a surface that grows", "[world][motion]")
{
    // Columns of 0 and 255 in turn, 1 / 32 m wide when the shutter opens and 1 / 8 m when it
    // closes.
    constexpr int size = 64;
    TexelImage stripes{.width = size, .height = size, .bytes = {}, .channels = 1};
    for (int i = 0; i < size * size; ++i) {
        stripes.bytes.push_back(i % 2 == 0 ? 0 : 255);
    }
    MaterialDesc material = test::lambertian(Rgb(1.0f));
    material.base_color_texture = TextureRef{};
    for (const bool by_instance : {false, true}) {
        SceneBuilder builder;
        builder.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, material);
        const auto grown = [](float t) { return 1.0f + 3.0f * t; };
        if (by_instance) {
            test::move_last(builder, 1, [&](float t) {
                return glm::scale(Mat4(1.0f), Vec3(grown(t), grown(t), 1.0f));
            });
        } else {
            test::deform(builder.desc.meshes[0], 1, [&](Vec3 p, float t) { return grown(t) * p; });
        }
        builder.desc.images.push_back(stripes);
        builder.desc.texture_filter = TextureFilter::mip_mapped;
        const World world(std::move(builder.desc));
        for (const float time : {0.0f, 1.0f}) {
            const PixelCone cone{.eye = {0, 0, 5}, .spread = 0.15f / 5.0f};
            // The middle of a black column at that time.
            const Vec3 target(grown(time) / size, 0.01f, 0.0f);
            const Vec3 direction = normalize(target - Vec3(0, 0, 5));
            const SegmentKey segment{.value = 1, .time = time};
            const auto hit = world.first_hit({.p = {0, 0, 5}}, direction, segment);
            REQUIRE(hit.has_value());
            const SurfacePoint point = world.surface_at(*hit, direction, segment, cone);
            CAPTURE(by_instance, time);
            CHECK(point.bsdf.base_color().r == Approx(time == 0.0f ? 0.5f : 0.0f).margin(0.01));
        }
    }
}

TEST_CASE("surfaces are met, shaded and hidden as they are at the segment's time",
          "[world][motion]")
{
    // A square that goes up, and whose shading normals tilt.
    MeshDesc mesh;
    mesh.positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
    mesh.normals.assign(4, Vec3(0, 1, 0));
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    MeshPose high{mesh.positions, std::vector<Vec3>(4, normalize(Vec3(1, 2, 0))), {}};
    for (Vec3& p : high.positions) {
        p.y = 2.0f;
    }
    mesh.motion = {high};
    SceneBuilder builder;
    builder.place(builder.add_mesh(mesh), test::lambertian(Rgb(0.5f)), Mat4(1.0f));
    builder.light(PointLightDesc{.position = {0, 3, 0}, .radius = 0.5f, .motion = {{0, 7, 0}}});
    const World world(std::move(builder.desc));
    CHECK(world.moves());
    CHECK(world.bounds().min == Vec3(-1, 0, -1));
    CHECK(world.bounds().max == Vec3(1, 7.5f, 1));
    for (const float time : {0.0f, 0.25f, 0.75f}) {
        CAPTURE(time);
        const SegmentKey key{.value = 1, .time = time};
        const SegmentEnd eye{.p = {0.3f, 2.2f, 0.1f}};
        const auto hit = world.intersect(eye, {0, -1, 0}, key);
        REQUIRE(hit.has_value());
        CHECK(hit->end.p.y == Approx(2.0f * time).margin(1e-6));
        const Vec3 normal = (1.0f - time) * Vec3(0, 1, 0) + time * normalize(Vec3(1, 2, 0));
        CHECK(dot(hit->bsdf.shading_normal(), normalize(normal)) == Approx(1.0f));
        const auto ball = world.intersect({.p = {0, 2.1f, 0}}, {0, 1, 0}, key);
        REQUIRE(ball.has_value());
        CHECK(ball->end.p.y == Approx(2.5f + 4.0f * time));
        CHECK(ball->light.has_value());
        // A segment at y = 1 is crossed by nothing, one that goes through by the square.
        const SegmentEnd low{.p = {0, 1.0f, 0}};
        const SegmentEnd below{.p = {0, -1.0f, 0}};
        const bool between = 2.0f * time < 1.0f;
        CHECK((world.transmittance(low, below, key) == Rgb(0.0f)) == between);
        CHECK((world.transmittance_to_infinity(low, {0.6f, 0.8f, 0}, key) == Rgb(1.0f)) == between);
    }
}

}  // namespace bdpt::world_test
