// The shadow on the ground where its form is known, and where there is none.

#include <bdpt/error.h>
#include <bdpt/render.h>

#include "catch.hpp"
#include "ground_views.h"
#include "moving_scenes.h"
#include "scene_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace bdpt::test::ground_shadow_test {
namespace {

constexpr int side = 32;

/// One metre wide, to the left of the middle and one metre high.
SceneBuilder square(const MaterialDesc& material)
{
    SceneBuilder builder;
    builder.quad({-1.5f, 1.0f, 0.5f}, {-0.5f, 1.0f, 0.5f}, {-0.5f, 1.0f, -0.5f},
                 {-1.5f, 1.0f, -0.5f}, material);
    return builder;
}

/// Shines down and to the right, as steep as wide.
DirectionalLightDesc low_sun()
{
    return {.direction = {1.0f, -1.0f, 0.0f}, .illuminance = Rgb(3.0f)};
}

bool is_between(int value, int first, int end)
{
    return value >= first && value < end;
}

void check_clear(const Shadow& shadow)
{
    CHECK(std::all_of(shadow.opacity.begin(), shadow.opacity.end(),
                      [](float opacity) { return opacity == 0.0f; }));
}

/// All kinds of lights that are nothing to be in the way of others, around a ground at y = 0.
SceneBuilder all_lights()
{
    SceneBuilder builder;
    builder.light(sunny_sky());
    builder.light(low_sun());
    builder.light(PointLightDesc{.position = {1.0f, 2.0f, 0.5f}, .intensity = Rgb(5.0f)});
    builder.light(SpotLightDesc{
        .position = {0.0f, 3.0f, 0.0f}, .direction = {0.0f, -1.0f, 0.2f}, .intensity = Rgb(9.0f)});
    return builder;
}

}  // namespace

TEST_CASE("under a sun the shadow of a square is a square", "[ground]")
{
    SceneBuilder builder = square(lambertian(Rgb(0.5f)));
    builder.light(low_sun());
    const Shadow shadow = compute_shadow(builder.desc, camera_above(), ground_options(side, 16));
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const bool row = is_between(y, 12, 20);
            const auto i = static_cast<std::size_t>(y * side + x);
            CAPTURE(x, y);
            // The square itself at 4 to 12, its shadow one metre, eight pixels, to the right.
            REQUIRE(shadow.opacity[i] == (row && is_between(x, 12, 20) ? 1.0f : 0.0f));
            REQUIRE(shadow.alpha[i] == (row && is_between(x, 4, 20) ? 1.0f : 0.0f));
        }
    }
}

TEST_CASE("a part of a pixel in shadow, or beside the ground, counts as that", "[ground]")
{
    SceneBuilder builder = square(lambertian(Rgb(0.5f)));
    builder.light(low_sun());
    // Five pixels for four metres: the shadow from -0.5 to 0.5 m is 1.25 pixels wide.
    const Shadow shadow = compute_shadow(builder.desc, camera_above(), ground_options(5, 4096));
    const double row[]{0.0, 0.125, 1.0, 0.125, 0.0};
    for (std::size_t x = 0; x < 5; ++x) {
        CHECK(shadow.opacity[2 * 5 + x] == Approx(row[x]).margin(0.003));
        CHECK(shadow.opacity[5 + x] == Approx(0.125 * row[x]).margin(0.003));
    }
    // The square hides ground from -1.5 to -0.5 m: the rest of that pixel is without shadow.
    CHECK(shadow.alpha[2 * 5 + 1] == Approx(0.875 + 0.125).margin(0.003));
    CHECK(shadow.alpha[2 * 5] == Approx(0.375).margin(0.003));
}

TEST_CASE("shadows on the ground are blurred as things and lights move", "[ground]")
{
    // By one metre along z while the shutter is open: the square, or the sun, which then is ever
    // lower.
    const bool sun_turns = GENERATE(false, true);
    SceneBuilder builder = square(lambertian(Rgb(0.5f)));
    DirectionalLightDesc sun = low_sun();
    if (sun_turns) {
        sun.later_directions = make_motion<Vec3>(1, [](float t) { return Vec3(1.0f, -1.0f, t); });
    } else {
        move_last(builder, 1, [](float t) { return translation({0.0f, 0.0f, t}); });
    }
    builder.light(sun);
    const Shadow shadow = compute_shadow(builder.desc, camera_above(), ground_options(side, 1024));
    // What the sun brings until the time t, up to a factor.
    const auto light_until = [&](double t) {
        return sun_turns ? std::asinh(t / std::sqrt(2.0)) : t;
    };
    for (int y = 0; y < side; ++y) {
        const double z = (y + 0.5) / 8.0 - 2.0;
        const double begin = std::clamp(z - 0.5, 0.0, 1.0);
        const double end = std::clamp(z + 0.5, 0.0, 1.0);
        const double expected = (light_until(end) - light_until(begin)) / light_until(1.0);
        CAPTURE(y, sun_turns);
        for (int x = 12; x < 20; ++x) {
            CHECK(shadow.opacity[static_cast<std::size_t>(y * side + x)] ==
                  Approx(expected).margin(0.02));
        }
    }
}

TEST_CASE("a disk hides the square of the sine of a sky", "[ground]")
{
    // As seen from below its centre: the cosine makes the even sky an even disk.
    const float height = GENERATE(0.5f, 1.0f, 2.0f);
    SceneBuilder builder;
    builder.place(builder.add_mesh(disk_above(height, 1.0f, 256)), lambertian(Rgb(0.5f)),
                  Mat4(1.0f));
    builder.light(even_sky(Rgb(0.2f, 0.4f, 0.1f)));
    const CameraDesc beside = camera_at({3.0f, 0.3f * height, 0.0f}, {0.0f, 0.0f, 0.0f}, 1e-3f);
    const auto sampling = GENERATE(EnvironmentSampling::plain, EnvironmentSampling::compensated);
    RenderOptions options = ground_options(8, 64);
    options.sampling.environment = sampling;
    const Shadow shadow = compute_shadow(builder.desc, beside, options);
    const auto expected = 1.0 / (1.0 + static_cast<double>(height * height));
    CHECK(compute_mean(shadow.opacity) == Approx(expected).margin(0.004));
}

TEST_CASE("sky and sun shade the ground by their shares of its light", "[ground]")
{
    // Half of the sky is hidden, the sun is not. Each brings pi.
    SceneBuilder builder;
    builder.place(builder.add_mesh(disk_above(1.0f, 1.0f, 256)), lambertian(Rgb(0.5f)), Mat4(1.0f));
    builder.light(even_sky());
    builder.light(DirectionalLightDesc{.direction = {3.0f, -1.0f, 0.0f},
                                       .illuminance = Rgb(3.14159265f * std::sqrt(10.0f))});
    const CameraDesc beside = camera_at({3.0f, 0.3f, 0.0f}, {0.0f, 0.0f, 0.0f}, 1e-3f);
    const Shadow shadow = compute_shadow(builder.desc, beside, ground_options(8, 256));
    CHECK(compute_mean(shadow.opacity) == Approx(0.25).margin(0.004));
}

TEST_CASE("a mask cuts shadows, a veil lets its share through", "[ground]")
{
    MaterialDesc veil = lambertian(Rgb(0.5f));
    veil.alpha_mode = AlphaMode::blend;
    veil.base_color.w = 0.25f;
    // Straight above, so that camera rays and shadow rays cross the same two triangles.
    SceneBuilder builder;
    builder.quad({-9.0f, 1.0f, 9.0f}, {9.0f, 1.0f, 9.0f}, {9.0f, 1.0f, -9.0f}, {-9.0f, 1.0f, -9.0f},
                 veil);
    builder.light(DirectionalLightDesc{.direction = {0.0f, -1.0f, 0.0f}, .illuminance = Rgb(1.0f)});
    const RenderOptions options = ground_options(side, 64);
    const Shadow seen = compute_shadow(builder.desc, camera_above(), options);
    CHECK(compute_mean(seen.opacity) == Approx(0.75 * 0.25).margin(0.005));
    CHECK(compute_mean(seen.alpha) == Approx(0.25 + 0.75 * 0.25).margin(0.005));
    builder.desc.materials[0].alpha_mode = AlphaMode::mask;
    check_clear(compute_shadow(builder.desc, camera_above(), options));
}

TEST_CASE("where nothing is in the way the ground is clear to the bit", "[ground]")
{
    SceneBuilder builder = all_lights();
    // All surfaces are below the ground, and beside what is seen; one of them shines.
    builder.sphere({5.0f, -3.0f, 0.0f}, 1.0f, emitter(Rgb(9.0f)), 12);
    builder.sphere({-5.0f, -3.0f, 0.0f}, 1.0f, lambertian(Rgb(0.5f)), 12);
    const Scene scene(builder.desc);
    RenderOptions options = ground_options(side, 8);
    const RenderResult clear = render(scene, camera_above(), options);
    check_clear(compute_shadow(clear));
    // Nothing stands above the ground, so that no shadow ray is needed.
    CHECK(clear.stats.rays.aov == 8U * side * side);
    // Somewhat lower all of them are above it.
    options.film.ground_height = -4.5f;
    CHECK(compute_mean(compute_shadow(render(scene, camera_above(), options)).opacity) > 1e-4);
}

TEST_CASE("what shines does not shade the ground from itself", "[ground]")
{
    MaterialDesc bulb = emitter(Rgb(4.0f));
    bulb.double_sided = true;  // the inside shines down, too, and is never seen
    SceneBuilder builder;
    builder.sphere({0.0f, 1.5f, 0.0f}, 0.4f, bulb, 16);
    const CameraDesc view = camera_at({4.0f, 2.0f, 4.0f}, {0.0f, 0.0f, 0.0f}, 0.5f);
    const RenderOptions options = ground_options(side, 16);
    check_clear(compute_shadow(builder.desc, view, options));
    // But from other lights it does, and others shade it.
    SceneBuilder sunny = builder;
    sunny.light(DirectionalLightDesc{.direction = {0.0f, -1.0f, 0.0f}, .illuminance = Rgb(50.0f)});
    CHECK(compute_mean(compute_shadow(sunny.desc, view, options).opacity) > 0.01);
    builder.quad({-9.0f, 1.0f, 9.0f}, {9.0f, 1.0f, 9.0f}, {9.0f, 1.0f, -9.0f}, {-9.0f, 1.0f, -9.0f},
                 lambertian(Rgb(0.5f)));
    const CameraDesc beneath = camera_at({4.0f, 0.8f, 4.0f}, {0.0f, 0.0f, 0.0f}, 0.1f);
    const Shadow all = compute_shadow(builder.desc, beneath, options);
    CHECK(*std::min_element(all.opacity.begin(), all.opacity.end()) == 1.0f);
}

TEST_CASE("a leaf does not shade the ground from light that the lamp itself hides", "[ground]")
{
    // Only the upper of two plates shines down, and the lower one is in its way.
    const MaterialDesc leaf = lambertian(Rgb(0.5f));
    MeshDesc plates;
    plates.positions = {{-1, 2, 1}, {1, 2, 1}, {1, 2, -1}, {-1, 2, -1},
                        {-3, 1, 3}, {3, 1, 3}, {3, 1, -3}, {-3, 1, -3}};
    plates.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
    SceneBuilder builder;
    builder.place(builder.add_mesh(plates), emitter(Rgb(4.0f)), Mat4(1.0f));
    const CameraDesc beside = camera_at({0.5f, 0.4f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.1f);
    const RenderOptions options = ground_options(8, 16);
    check_clear(compute_shadow(builder.desc, beside, options));
    builder.quad({-0.5f, 0.8f, 0.5f}, {0.5f, 0.8f, 0.5f}, {0.5f, 0.8f, -0.5f}, {-0.5f, 0.8f, -0.5f},
                 leaf);
    check_clear(compute_shadow(builder.desc, beside, options));
}

TEST_CASE("the ground is seen from above only, and as far as rays reach", "[ground]")
{
    SceneBuilder builder = square(lambertian(Rgb(0.5f)));
    builder.light(sunny_sky());
    const RenderOptions options = ground_options(side, 4);
    const auto check = [&](const CameraDesc& camera, double least, double most) {
        const Shadow shadow = compute_shadow(builder.desc, camera, options);
        for (std::size_t i = 0; i < shadow.opacity.size(); ++i) {
            REQUIRE(shadow.opacity[i] >= 0.0f);  // and no NaN
            REQUIRE(shadow.alpha[i] <= 1.0f);
        }
        CHECK(compute_mean(shadow.opacity) >= least);
        CHECK(compute_mean(shadow.opacity) <= most);
    };
    const CameraDesc above = camera_at({0.0f, 2.0f, 6.0f}, {0.0f, 0.0f, 0.0f}, 0.6f);
    check(above, 0.01, 1.0);
    check(camera_at({0.0f, -2.0f, 6.0f}, {0.0f, 0.0f, 0.0f}, 0.6f), 0.0, 0.0);   // from below
    check(camera_at({0.0f, -2.0f, 6.0f}, {0.0f, -4.0f, 0.0f}, 0.6f), 0.0, 0.0);  // and downwards
    check(camera_at({0.0f, 2.0f, 6.0f}, {0.0f, 4.0f, 0.0f}, 0.3f), 0.0, 0.0);    // upwards
    const CameraDesc level = camera_at({0.0f, 1e-3f, 6.0f}, {0.0f, 1e-3f, 0.0f}, 0.6f);
    check(level, 0.0, 0.6);                     // the horizon in the middle
    check(in_parallel(level, 3.0f), 0.0, 0.0);  // edge-on
    check(in_parallel(above, 3.0f), 0.01, 1.0);
    check(with_lens(above, 0.2f, 6.0f), 0.01, 1.0);
    check(camera_at({0.0f, 0.0f, 6.0f}, {0.0f, 0.0f, 0.0f}, 0.6f), 0.0, 0.0);  // in it
}

TEST_CASE("ground beyond the reach of rays is not looked at", "[ground]")
{
    SceneBuilder builder = square(lambertian(Rgb(0.5f)));
    builder.light(low_sun());
    const Scene scene(builder.desc);
    const auto hits = [&](Vec3 to) {
        const CameraDesc far_up = camera_at({0.0f, 9e14f, 0.0f}, to, 1e-5f);
        const AovFilm aovs = render(scene, far_up, ground_options(8, 4)).aovs;
        const std::vector<std::string> names = aovs.plane_names();
        const auto plane = std::find(names.begin(), names.end(), "ground.hits");
        std::array<ExactSum::Words, 8> row;
        aovs.read_row(static_cast<std::size_t>(plane - names.begin()), 4, row);
        return row[4].low;
    };
    CHECK(hits({9e14f, 0.0f, 0.0f}) == 4U);
    CHECK(hits({9e14f, 8.999e14f, 0.0f}) == 0U);
}

TEST_CASE("light that is no number counts neither way", "[ground]")
{
    // So strong and near that its irradiance is beyond floats, with a shade right below.
    SceneBuilder builder;
    builder.light(PointLightDesc{.position = {0.0f, 1e-3f, 0.0f}, .intensity = Rgb(5e34f)});
    builder.quad({-5e-3f, 5e-4f, 5e-3f}, {5e-3f, 5e-4f, 5e-3f}, {5e-3f, 5e-4f, -5e-3f},
                 {-5e-3f, 5e-4f, -5e-3f}, lambertian(Rgb(0.5f)));
    const Shadow shadow =
        compute_shadow(builder.desc, in_parallel(camera_above(), 0.02f), ground_options(side, 4));
    for (const float opacity : shadow.opacity) {
        REQUIRE(opacity >= 0.0f);
        REQUIRE(opacity <= 1.0f);
    }
}

TEST_CASE("a veil that lies on the ground does not shade it", "[ground]")
{
    MaterialDesc veil = lambertian(Rgb(0.5f));
    veil.alpha_mode = AlphaMode::blend;
    veil.base_color.w = 0.5f;
    MeshDesc mesh;
    mesh.positions = {{-9, 0.3f, 9}, {9, 0.3f, 9}, {9, 0.3f, -9}, {-9, 0.3f, -9}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    SceneBuilder builder;
    const MeshId id = builder.add_mesh(mesh);
    const Mat4 turn = glm::rotate(Mat4(1.0f), 0.7f, Vec3(0.0f, 1.0f, 0.0f));
    builder.place(id, veil, translation({0.1f, 0.7f, 0.2f}) * turn);
    builder.place(id, veil, translation({30.0f, 0.7f, 0.0f}) * turn);  // rays go to its space
    builder.light(low_sun());
    RenderOptions options = ground_options(side, 16);
    options.film.ground_height.reset();
    const Shadow shadow = compute_shadow(builder.desc, camera_above(), options);
    CHECK(compute_mean(shadow.alpha) == Approx(0.5).margin(0.01));
    check_clear(shadow);
}

TEST_CASE("without light there is no shadow, nor without surfaces", "[ground]")
{
    const RenderOptions options = ground_options(side, 4);
    check_clear(compute_shadow(SceneDesc{}, camera_above(), options));
    check_clear(compute_shadow(square(lambertian(Rgb(0.5f))).desc, camera_above(), options));
    check_clear(compute_shadow(all_lights().desc, camera_above(), options));
    SceneBuilder globe;
    globe.light(
        PointLightDesc{.position = {-1.0f, 3.0f, 0.5f}, .intensity = Rgb(5.0f), .radius = 0.3f});
    check_clear(compute_shadow(globe.desc, camera_above(), options));
    // Lamps that are spheres shade what others light.
    globe.light(low_sun());
    CHECK(compute_mean(compute_shadow(globe.desc, camera_above(), options).opacity) > 0.0);
    SceneBuilder lit_from_below = square(lambertian(Rgb(0.5f)));
    lit_from_below.light(PointLightDesc{.position = {0.0f, -1.0f, 0.0f}, .intensity = Rgb(5.0f)});
    lit_from_below.light(
        DirectionalLightDesc{.direction = {0.0f, 1.0f, 0.0f}, .illuminance = Rgb(5.0f)});
    check_clear(compute_shadow(lit_from_below.desc, camera_above(), options));
    // Light that starts in the ground is no number there.
    SceneBuilder in_it = square(lambertian(Rgb(0.5f)));
    in_it.light(PointLightDesc{.position = {0.0f, 0.0f, 0.0f}, .intensity = Rgb(5.0f)});
    check_clear(compute_shadow(in_it.desc, camera_above(), options));
}

TEST_CASE("the ground is at the lowest point, at any time, unless its height is given", "[ground]")
{
    // Upright, from y = 1 to 2, and sinking by one metre while the shutter is open.
    SceneBuilder builder;
    builder.quad({-0.5f, 1.0f, 0.0f}, {0.5f, 1.0f, 0.0f}, {0.5f, 2.0f, 0.0f}, {-0.5f, 2.0f, 0.0f},
                 lambertian(Rgb(0.5f)));
    builder.light(DirectionalLightDesc{.direction = {0.0f, -1.0f, 1.0f}, .illuminance = Rgb(1.0f)});
    RenderOptions options = ground_options(side, 4);
    options.film.ground_height.reset();
    const auto image = [&] {
        return compute_shadow(builder.desc, camera_above(), options).opacity;
    };
    const std::vector<float> standing = image();
    CHECK(compute_mean(standing) > 0.05);
    options.film.ground_height = 1.0f;
    CHECK(image() == standing);
    options.film.ground_height = 0.5f;
    CHECK(image() != standing);
    move_last(builder, 1, [](float t) { return translation({0.0f, -t, 0.0f}); });
    const std::vector<float> sinking = image();
    options.film.ground_height = 0.0f;
    const std::vector<float> sunk = image();
    CHECK(sunk != sinking);
    options.film.ground_height.reset();
    CHECK(image() == sunk);
}

TEST_CASE("heights of the ground that are none are refused", "[ground]")
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const float height : {std::nanf(""), infinity, -infinity, 2e15f}) {
        RenderOptions options = ground_options(4, 1);
        options.film.ground_height = height;
        try {
            static_cast<void>(compute_shadow(SceneDesc{}, camera_above(), options));
            FAIL("no error for " << height);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::usage);
            CHECK(std::string(error.what()).starts_with("ground_height is "));
        }
    }
}

}  // namespace bdpt::test::ground_shadow_test
