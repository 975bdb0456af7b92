#include <bdpt/error.h>
#include <bdpt/render.h>

#include "catch.hpp"
#include "room.h"
#include "scene_builder.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::test::render_result_test {
namespace {

RenderOptions options()
{
    RenderOptions result;
    result.integrator = IntegratorKind::bdpt;
    result.film.width = 19;
    result.film.height = 14;
    result.sampling.samples = {.begin = 0, .end = 16};
    result.transport.max_depth = 5;
    result.film.clamp = 20.0f;
    return result;
}

/// All ways to transport light that keep books of their own.
std::vector<RenderOptions> kinds()
{
    std::vector<RenderOptions> result;
    for (const IntegratorKind kind :
         {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt, IntegratorKind::lt}) {
        result.push_back(options());
        result.back().integrator = kind;
    }
    result.back().film.aovs = {Aov::albedo, Aov::depth, Aov::alpha, Aov::shadow, Aov::opacity};
    result.push_back(options());
    result.back().bidirectional.light_paths = 0.3;
    result.push_back(options());
    result.back().bidirectional.strategy_depth = 3;
    return result;
}

RenderResult part_of(const Scene& scene, RenderOptions options, SampleRange samples, int threads)
{
    options.sampling.samples = samples;
    options.system.threads = threads;
    options.system.tile_size = 3 + threads;
    return render(scene, room_camera(), options);
}

/// The message of the `Error` that `call` throws.
std::string message_of(const std::function<void()>& call)
{
    try {
        call();
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        return error.what();
    }
    FAIL("no error");
    return {};
}

TEST_CASE("parts of a render, merged in any order, are the render", "[part]")
{
    const Scene scene = room();
    std::mt19937 engine(3);
    for (const RenderOptions& o : kinds()) {
        const RenderResult whole = render(scene, room_camera(), o);
        std::vector<RenderResult> parts;
        for (int i = 0; i < 8; ++i) {
            parts.push_back(part_of(scene, o, {.begin = 2 * i, .end = 2 * i + 2}, 1 + i % 3));
        }
        std::shuffle(parts.begin(), parts.end(), engine);
        RenderResult sum = std::move(parts.back());
        parts.pop_back();
        for (const RenderResult& part : parts) {
            merge(sum, part);
        }
        CHECK(sum.samples.text() == "0:16");
        CHECK(sum.film == whole.film);
        CHECK(sum.image().pixels == whole.film.develop().pixels);
        CHECK(sum.aovs == whole.aovs);
        CHECK(sum.strategies == whole.strategies);
        CHECK(sum.stats.paths == whole.stats.paths);
        CHECK(sum.cpu_seconds > 0.0);
        CHECK(sum.seconds > parts.front().seconds);
    }
}

TEST_CASE("a render goes on where a part ends, and fills its gaps", "[part]")
{
    const Scene scene = room();
    for (const RenderOptions& o : kinds()) {
        const RenderResult whole = render(scene, room_camera(), o);
        RenderResult part = part_of(scene, o, {.begin = 3, .end = 5}, 2);
        merge(part, part_of(scene, o, {.begin = 9, .end = 10}, 1));
        std::vector<std::int64_t> counts;
        RenderControl control;
        control.on_part = [&](const RenderResult& now) {
            CHECK(now.film.sample_count() == now.samples.count());
            counts.push_back(now.samples.count());
        };
        const double cpu_seconds = part.cpu_seconds;
        const double seconds = part.seconds;
        const RenderResult result =
            continue_render(scene, room_camera(), o, std::move(part), control);
        CHECK(result.samples.text() == "0:16");
        CHECK(result.film == whole.film);
        CHECK(result.aovs == whole.aovs);
        CHECK(result.strategies == whole.strategies);
        CHECK(result.stats.paths == whole.stats.paths);
        CHECK(result.cpu_seconds > cpu_seconds);
        CHECK(result.seconds > seconds);
        REQUIRE(counts.size() >= 3);  // before, between and behind what there was
        CHECK(counts.front() > 3);
        CHECK(counts.back() == 16);
    }
}

TEST_CASE("what is there is not rendered again", "[part]")
{
    const Scene scene = room();
    RenderResult part = part_of(scene, options(), {.begin = 0, .end = 16}, 2);
    RenderControl control;
    control.on_progress = [](const Progress&) { FAIL("there is nothing to do"); };
    RenderOptions fewer = options();
    fewer.sampling.samples = {.begin = 2, .end = 9};
    const RenderResult result =
        continue_render(scene, room_camera(), fewer, std::move(part), control);
    CHECK(result.samples.text() == "0:16");
}

TEST_CASE("a stop leaves a part that can be gone on with", "[part]")
{
    const Scene scene = room();
    const RenderResult whole = render(scene, room_camera(), options());
    RenderResult part;
    int calls = 0;
    while (part.samples.count() < 16) {
        std::stop_source stop;
        stop.request_stop();
        RenderControl control;
        control.stop = stop.get_token();
        part = continue_render(scene, room_camera(), options(), std::move(part), control);
        CHECK(part.samples.count() == ++calls);
    }
    CHECK(part.film == whole.film);
}

TEST_CASE("samples that both parts have are refused", "[part]")
{
    const Scene scene = room();
    RenderResult part = part_of(scene, options(), {.begin = 0, .end = 4}, 1);
    const RenderResult other = part_of(scene, options(), {.begin = 3, .end = 6}, 1);
    CHECK(message_of([&] { merge(part, other); }).find("3:4") != std::string::npos);
    CHECK(part.samples.text() == "0:4");
    CHECK(part.film.sample_count() == 4);
}

TEST_CASE("another scene, camera or option is refused by name", "[part]")
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), lambertian(Rgb(0.6f)));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    builder.desc.images.push_back({.width = 1, .height = 1, .bytes = {1, 2, 3, 4}});
    builder.desc.materials[0].base_color_texture = TextureRef{};
    const SceneDesc desc = builder.desc;
    const auto go_on = [&](const std::function<void(SceneDesc&)>& change_scene,
                           const std::function<void(CameraDesc&)>& change_camera,
                           const std::function<void(RenderOptions&)>& change_options) {
        RenderOptions o = options();
        o.sampling.samples = {.begin = 0, .end = 1};
        RenderResult part = render(Scene(desc), room_camera(), o);
        SceneDesc other = desc;
        change_scene(other);
        CameraDesc camera = room_camera();
        change_camera(camera);
        o.sampling.samples = {.begin = 0, .end = 2};
        change_options(o);
        static_cast<void>(continue_render(Scene(other), camera, o, std::move(part)));
    };
    const auto no_scene = [](SceneDesc&) {};
    const auto no_camera = [](CameraDesc&) {};
    const auto no_option = [](RenderOptions&) {};
    const auto check = [](const std::string& message, const std::string& name) {
        CAPTURE(message, name);
        CHECK(message.find("another render: " + name) != std::string::npos);
        CHECK(message.find(';') == std::string::npos);
    };
    const auto scene = [&](const char* name, const std::function<void(SceneDesc&)>& change) {
        check(message_of([&] { go_on(change, no_camera, no_option); }), name);
    };
    scene("scene: images[0]", [](SceneDesc& s) { s.images[0].bytes[2] = 9; });
    scene("scene: materials[1]", [](SceneDesc& s) { s.materials[1].roughness = 0.3f; });
    scene("scene: materials[0]", [](SceneDesc& s) { s.materials[0].clearcoat.factor = 0.3f; });
    scene("scene: materials[0]",
          [](SceneDesc& s) { s.materials[0].base_color_texture->uv_set = 1; });
    scene("scene: meshes[0]", [](SceneDesc& s) { s.meshes[0].positions[0].x -= 0.01f; });
    scene("scene: instances[1]",
          [](SceneDesc& s) { s.instances[1].world_from_object[3].y = 1.0f; });
    scene("scene: lights[0] (missing in it)",
          [](SceneDesc& s) { s.lights.emplace_back(PointLightDesc{}); });
    scene("scene: texture filter",
          [](SceneDesc& s) { s.texture_filter = TextureFilter::mip_mapped; });
    scene("scene: contacts", [](SceneDesc& s) { s.contacts = ContactKind::air; });
    scene("scene: origin", [](SceneDesc& s) { s.origin.x = 1.0; });

    check(message_of([&] {
              go_on(
                  no_scene, [](CameraDesc& c) { c.lens_radius = 0.25f; }, no_option);
          }),
          "camera: lens radius (0, not 0.25)");
    check(message_of([&] {
              go_on(
                  no_scene, [](CameraDesc& c) { c.world_from_camera[3].x += 0.01f; }, no_option);
          }),
          "camera: transform");

    const auto option = [&](const char* name, const std::function<void(RenderOptions&)>& change) {
        check(message_of([&] { go_on(no_scene, no_camera, change); }), name);
    };
    option("option: max_depth (5, not 6)", [](RenderOptions& o) { o.transport.max_depth = 6; });
    option("option: integrator (bdpt, not mis)",
           [](RenderOptions& o) { o.integrator = IntegratorKind::mis; });
    option("option: seed (0, not 1)", [](RenderOptions& o) { o.sampling.seed = 1; });
    option("option: width (19, not 20)", [](RenderOptions& o) { o.film.width = 20; });
    option("option: crop (none, not 0,0,19,13)",
           [](RenderOptions& o) { o.film.crop = PixelRect{.x0 = 0, .y0 = 0, .x1 = 19, .y1 = 13}; });
    option("option: filter (box, not tent)",
           [](RenderOptions& o) { o.film.filter.kind = FilterKind::tent; });
    option("option: background (environment, not none)",
           [](RenderOptions& o) { o.transport.background = Background::none; });
    option("option: ground_height (none, not 0.5)",
           [](RenderOptions& o) { o.film.ground_height = 0.5f; });
    option("option: aov (none, not albedo)", [](RenderOptions& o) { o.film.aovs = {Aov::albedo}; });
    option("option: connection_rays (0, not 2)",
           [](RenderOptions& o) { o.bidirectional.connection_rays = 2.0; });
    option("option: connections (none, not 3)",
           [](RenderOptions& o) { o.bidirectional.connections = 3.0; });
    option("option: disable (none, not s1t2)",
           [](RenderOptions& o) { o.bidirectional.disabled = {{.s = 1, .t = 2}}; });

    // What changes no bit is no difference.
    CHECK_NOTHROW(go_on([](SceneDesc& s) { s.meshes[0].name = "renamed"; },
                        [](CameraDesc& c) { c.name = "renamed"; },
                        [](RenderOptions& o) {
                            o.system = {.tile_size = 7, .threads = 3};
                            o.bidirectional.strategy_memory = 5'000'000;
                            o.bidirectional.light_path_memory = 5'000'000;
                        }));
}

TEST_CASE("a part that has the identity of a render and other films is refused", "[part]")
{
    const Scene scene = room();
    RenderOptions o = options();
    o.film.aovs = {Aov::albedo, Aov::object};
    o.bidirectional.strategy_depth = 3;
    const RenderResult sound = part_of(scene, o, {.begin = 0, .end = 2}, 1);
    const auto refused = [&](const std::function<void(RenderResult&)>& change) {
        RenderResult part = part_of(scene, o, {.begin = 0, .end = 2}, 1);
        change(part);
        return message_of(
            [&] { static_cast<void>(continue_render(scene, room_camera(), o, std::move(part))); });
    };
    const std::string message = "the part's films are not those of its render";
    const PixelRect& region = sound.film.region();
    CHECK(refused([&](RenderResult& part) {
              FilmLayout layout = part.film.layout();
              ++layout.width;
              part.film = Film(layout);
          }) == message);
    CHECK(refused([&](RenderResult& part) { part.aovs = AovFilm(region, AovSet{Aov::object}); }) ==
          message);
    CHECK(refused([&](RenderResult& part) {
              part.aovs = AovFilm(region, o.film.aovs, PixelCounts::own);
          }) == message);
    CHECK(refused([&](RenderResult& part) { part.ids = IdFilm(region, o.film.aovs, {}); }) ==
          message);
    CHECK(refused([&](RenderResult& part) { part.strategies = StrategyFilm(); }) == message);
}

}  // namespace
}  // namespace bdpt::test::render_result_test
