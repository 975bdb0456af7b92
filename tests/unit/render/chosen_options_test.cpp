// The integrator that chooses.

#include "catch.hpp"
#include "room.h"
#include "scene_builder.h"

#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>

#include <cmath>
#include <utility>
#include <vector>

namespace bdpt::test::chosen_options_test {
namespace {

RenderOptions small()
{
    RenderOptions options;
    options.film.width = 31;
    options.film.height = 23;
    options.sampling.samples = {.begin = 0, .end = 3};
    options.sampling.planned_samples = 0;  // as many as anyone has time for
    options.transport.max_depth = 5;
    return options;
}

bool same_choice(const RenderOptions& a, const RenderOptions& b)
{
    return a.integrator == b.integrator &&
           a.bidirectional.light_paths == b.bidirectional.light_paths &&
           a.bidirectional.connections == b.bidirectional.connections &&
           a.bidirectional.connection_rays == b.bidirectional.connection_rays &&
           a.bidirectional.disabled == b.bidirectional.disabled;
}

RenderOptions choice(const Scene& scene, const RenderOptions& options)
{
    return chosen_options(scene, room_camera(), options);
}

/// Diffuse walls, and a lamp that shines at the ceiling.
Scene hidden_lamp()
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.6f)), lambertian(Rgb(0.6f)));
    builder.ceiling(lambertian(Rgb(0.8f)));
    builder.quad({-0.3f, 0.4f, 0.3f}, {0.3f, 0.4f, 0.3f}, {0.3f, 0.4f, -0.3f}, {-0.3f, 0.4f, -0.3f},
                 emitter(Rgb(8.0f)));
    return Scene(std::move(builder.desc));
}

}  // namespace

TEST_CASE("auto is the default and gives the bits of what it chose", "[auto]")
{
    const bool hidden = GENERATE(false, true);
    const Scene scene = hidden ? hidden_lamp() : room();
    REQUIRE(small().integrator == IntegratorKind::automatic);
    const RenderResult result = render(scene, room_camera(), small());
    const RenderOptions chosen = choice(scene, small());
    CHECK((chosen.integrator == IntegratorKind::mis || chosen.integrator == IntegratorKind::bdpt));
    RenderOptions by_hand = small();
    by_hand.integrator = chosen.integrator;
    by_hand.bidirectional.light_paths = chosen.bidirectional.light_paths;
    by_hand.bidirectional.connections = chosen.bidirectional.connections;
    by_hand.bidirectional.connection_rays = chosen.bidirectional.connection_rays;
    CAPTURE(hidden, chosen.bidirectional.connection_rays);
    by_hand.bidirectional.disabled = chosen.bidirectional.disabled;
    const RenderResult same = render(scene, room_camera(), by_hand);
    CHECK(same.film == result.film);
    CHECK(same.stats == result.stats);
    CHECK(result.identity == identity(scene, room_camera(), by_hand));
}

TEST_CASE("auto chooses the same for every part of an image", "[auto]")
{
    const Scene scene = hidden_lamp();
    const RenderOptions whole = choice(scene, small());
    RenderOptions part = small();
    part.sampling.samples = {.begin = 100, .end = 164};
    part.sampling.seed = 9;
    part.system.threads = 3;
    part.system.tile_size = 5;
    part.bidirectional.light_paths = 3.0;
    part.film.aovs = AovSet{Aov::depth};
    CHECK(same_choice(choice(scene, part), whole));
    CHECK(choice(scene, part).sampling.seed == 9);
}

TEST_CASE("auto chooses for a crop as for an image of its own", "[auto]")
{
    const Scene scene = hidden_lamp();
    CameraDesc camera = room_camera();
    RenderOptions options = small();
    options.film.width = 96;
    options.film.height = 64;
    RenderOptions part = options;
    part.film.crop = PixelRect{.x0 = 48, .y0 = 0, .x1 = 96, .y1 = 16};
    const RenderOptions chosen = chosen_options(scene, camera, part);
    CHECK(chosen.film.crop == part.film.crop);

    // The same view on a film of its own: a quarter as high, to the right, and upwards.
    RenderOptions own = options;
    own.film.width = 48;
    own.film.height = 16;
    const float half_height = std::tan(0.5f * camera.vertical_fov) / 4.0f;
    camera.vertical_fov = 2.0f * std::atan(half_height);
    camera.shift = Vec2(0.5f, 1.5f);
    const RenderOptions expected = chosen_options(scene, camera, own);
    REQUIRE(expected.integrator == IntegratorKind::bdpt);
    CHECK(chosen.integrator == IntegratorKind::bdpt);
    CHECK(chosen.bidirectional.connections == expected.bidirectional.connections);
    CHECK_THAT(chosen.bidirectional.light_paths,
               Catch::Matchers::WithinRel(expected.bidirectional.light_paths / 8.0, 1e-9));
    REQUIRE(static_cast<bool>(chosen.sampling.rates) == static_cast<bool>(expected.sampling.rates));

    // Both have the same brightness, and about the same rays.
    const RenderResult crop = render(scene, room_camera(), chosen);
    const RenderResult alone = render(scene, camera, expected);
    const auto rays = [](const RenderResult& result) {
        return static_cast<double>(result.stats.rays.camera + result.stats.rays.light +
                                   result.stats.rays.shadow);
    };
    CHECK(rays(crop) < 1.1 * rays(alone));
}

TEST_CASE("auto traces light paths where they pay", "[auto]")
{
    const RenderOptions hidden = choice(hidden_lamp(), small());
    CHECK(hidden.integrator == IntegratorKind::bdpt);
    CHECK(hidden.bidirectional.connections.value_or(0.0) >= 1.0);

    SceneBuilder open;
    open.quad({-9, -1, 9}, {9, -1, 9}, {9, -1, -9}, {-9, -1, -9}, lambertian(Rgb(0.5f)));
    open.light(DirectionalLightDesc{.direction = {0.3f, -1.0f, 0.2f}, .illuminance = Rgb(3.0f)});
    CHECK(choice(Scene(std::move(open.desc)), small()).integrator == IntegratorKind::mis);
}

TEST_CASE("auto splats caustics of lights without a size where few samples are planned", "[auto]")
{
    RenderOptions options = small();
    options.sampling.planned_samples = 1;
    const auto splats = [&](const MaterialDesc& material, const LightDesc& light) {
        SceneBuilder builder;
        builder.walls(lambertian(Rgb(0.6f)), lambertian(Rgb(0.6f)));
        builder.sphere({0.0f, -0.4f, 0.0f}, 0.4f, material).light(light);
        return choice(Scene(std::move(builder.desc)), options).integrator == IntegratorKind::bdpt;
    };
    PointLightDesc lamp;
    lamp.position = {0.0f, 0.8f, 0.0f};
    CHECK(splats(glass(0.0f), lamp));
    CHECK(splats(metal(Rgb(0.9f), 0.05f), DirectionalLightDesc{}));
    CHECK_FALSE(splats(lambertian(Rgb(0.5f)), lamp));
    lamp.radius = 0.1f;
    CHECK_FALSE(splats(glass(0.0f), lamp));
}

TEST_CASE("auto takes path tracing where few samples are planned", "[auto]")
{
    RenderOptions options = small();
    options.film.width = 64;
    options.film.height = 64;
    const Scene scene = hidden_lamp();
    for (const auto& [samples, kind] :
         {std::pair(9, IntegratorKind::mis), std::pair(11, IntegratorKind::bdpt),
          std::pair(0, IntegratorKind::bdpt)}) {
        CAPTURE(samples);
        options.sampling.planned_samples = samples;
        CHECK(choice(scene, options).integrator == kind);
        // A crop counts as an image of its own.
        options.film.height = 128;
        options.film.crop = PixelRect{.x0 = 0, .y0 = 32, .x1 = 64, .y1 = 96};
        CHECK(choice(scene, options).integrator == kind);
        options.film.height = 64;
        options.film.crop.reset();
    }
}

TEST_CASE("auto tells of light that only vcm finds", "[auto]")
{
    // The sun shines by way of the mirror floor at a ball, which is seen in the floor: two mirrors
    // and no light with a surface, so no strategy (s, t) makes the path.
    const auto over_mirror = [](const LightDesc& light) {
        SceneBuilder builder;
        builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, metal(Rgb(0.9f), 0.0f));
        builder.sphere({0.0f, -0.3f, 0.0f}, 0.5f, lambertian(Rgb(0.8f)));
        builder.light(light);
        return Scene(std::move(builder.desc));
    };
    const CameraDesc camera = camera_at({0.0f, 1.2f, 2.6f}, {0.0f, -0.6f, 0.0f}, 0.7f);
    RenderOptions options = small();
    options.film.width = 640;
    options.film.height = 480;
    const Scene sunny = over_mirror(
        DirectionalLightDesc{.direction = {0.0f, -1.0f, -0.6f}, .illuminance = Rgb(3.0f)});
    const IntegratorChoice chosen = choose_integrator(sunny, camera, options);
    CHECK(same_choice(chosen.options, chosen_options(sunny, camera, options)));
    const auto mean = [&](RenderOptions how) {
        how.film.width = 64;
        how.film.height = 48;
        how.sampling.samples = {.begin = 0, .end = 64};
        const Image image = render(sunny, camera, how).film.develop();
        double sum = 0.0;
        for (const Rgb& c : image.pixels) {
            sum += static_cast<double>(c.g);
        }
        return sum;
    };
    RenderOptions merging = options;
    merging.integrator = IntegratorKind::vcm;
    const double missing = 1.0 - mean(chosen.options) / mean(merging);
    CHECK(missing > 0.03);
    CHECK(chosen.unseen_light == Approx(missing).epsilon(0.3));
    // A lamp with a surface is hit by camera paths.
    const Scene lamp = over_mirror(
        PointLightDesc{.position = {0.0f, 3.0f, 2.0f}, .intensity = Rgb(30.0f), .radius = 0.3f});
    CHECK(choose_integrator(lamp, camera, options).unseen_light == 0.0);
    RenderOptions named = options;
    named.integrator = IntegratorKind::bdpt;
    CHECK(choose_integrator(sunny, camera, named).unseen_light == 0.0);
}

TEST_CASE("the pilot of auto proposes rates for an object before an empty background", "[auto]")
{
    SceneBuilder builder;
    builder.sphere({0.0f, 0.0f, 0.0f}, 0.4f, lambertian(Rgb(0.7f)));
    builder.light(
        PointLightDesc{.position = {1.0f, 2.0f, 2.0f}, .intensity = Rgb(30.0f), .radius = 0.5f});
    const Scene ball(std::move(builder.desc));
    const CameraDesc camera = camera_at({0.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 0.7f);
    RenderOptions options = small();
    options.film.width = 96;
    options.film.height = 64;
    const IntegratorChoice chosen = choose_integrator(ball, camera, options);
    REQUIRE(chosen.rates != nullptr);
    CHECK(chosen.options.sampling.rates == nullptr);
    CHECK(chosen.rates->width() == 96);
    CHECK(chosen.rates->height() == 64);
    CHECK(chosen.rates->rate(4, 4) < chosen.rates->rate(48, 32));
    // Rates, like the integrator, depend on scene, camera, size and crop alone.
    RenderOptions other = options;
    other.sampling.seed = 7;
    other.sampling.samples = {.begin = 8, .end = 24};
    other.system.threads = 1;
    other.system.tile_size = 5;
    CHECK(*choose_integrator(ball, camera, other).rates == *chosen.rates);
    other.film.crop = PixelRect{.x0 = 0, .y0 = 16, .x1 = 96, .y1 = 64};
    const auto cropped = choose_integrator(ball, camera, other).rates;
    REQUIRE(cropped != nullptr);
    CHECK(cropped->width() == 96);
    CHECK(cropped->height() == 64);
    CHECK(cropped->rate(4, 60) < cropped->rate(48, 32));
    CHECK(cropped->rate(48, 8) == 1.0f);  // outside
    options.integrator = chosen.options.integrator;
    CHECK(choose_integrator(ball, camera, options).rates == nullptr);
    // A room has light everywhere.
    CHECK(choose_integrator(room(), room_camera(), small()).rates == nullptr);
}

TEST_CASE("auto renders scenes without light or surfaces by path tracing", "[auto]")
{
    CHECK(choice(Scene(SceneDesc{}), small()).integrator == IntegratorKind::mis);
    SceneBuilder dark;
    dark.walls(lambertian(Rgb(0.5f)), lambertian(Rgb(0.5f)));
    CHECK(choice(Scene(std::move(dark.desc)), small()).integrator == IntegratorKind::mis);
    SceneBuilder black;
    black.walls(lambertian(Rgb(0.0f)), lambertian(Rgb(0.0f)));
    black.light(PointLightDesc{.position = {0.0f, 0.9f, 0.0f}});
    CHECK(choice(Scene(std::move(black.desc)), small()).integrator == IntegratorKind::mis);
}

TEST_CASE("what only bdpt knows is rendered by bdpt", "[auto]")
{
    const Scene scene = room();
    const auto is_bdpt = [&](auto change) {
        RenderOptions options = small();
        change(options);
        const RenderOptions chosen = choice(scene, options);
        return chosen.integrator == IntegratorKind::bdpt &&
               chosen.bidirectional.light_paths == 1.0 &&
               !chosen.bidirectional.connections.has_value();
    };
    CHECK(is_bdpt([](RenderOptions& o) { o.bidirectional.disabled = {{.s = 0, .t = 3}}; }));
    CHECK(is_bdpt([](RenderOptions& o) { o.bidirectional.strategy_depth = 3; }));
    CHECK(is_bdpt([](RenderOptions& o) { o.bidirectional.max_camera_depth = 2; }));
    CHECK(is_bdpt([](RenderOptions& o) { o.bidirectional.max_light_depth = 2; }));
    CHECK(is_bdpt([](RenderOptions& o) { o.transport.heuristic = Heuristic::cutoff; }));
}

TEST_CASE("an integrator that is named stays", "[auto]")
{
    const Scene scene = room();
    for (const IntegratorKind kind : {IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::mis,
                                      IntegratorKind::lt, IntegratorKind::bdpt}) {
        RenderOptions options = small();
        options.integrator = kind;
        options.bidirectional.light_paths = 2.0;
        CHECK(same_choice(choice(scene, options), options));
    }
}

TEST_CASE("light paths that nobody connects to are not kept in memory", "[light-paths]")
{
    const Scene scene = room();
    RenderOptions options = small();
    options.integrator = IntegratorKind::bdpt;
    options.bidirectional.light_paths = 2.0;
    options.bidirectional.connections = 0.0;
    options.bidirectional.light_path_memory = 0;
    const RenderResult result = render(scene, room_camera(), options);
    CHECK(result.stats.paths.light == 2 * result.stats.paths.camera);
    CHECK(result.stats.rays.shadow_interior == 0);
    CHECK(result.stats.rays.shadow_to_lens > 0);
}

}  // namespace bdpt::test::chosen_options_test
