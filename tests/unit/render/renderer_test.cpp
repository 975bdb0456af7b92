#include <bdpt/renderer.h>

#include <bdpt/error.h>
#include <bdpt/noise.h>

#include "catch.hpp"
#include "room.h"
#include "scene_builder.h"

#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <utility>

namespace bdpt::test::renderer_test {
namespace {

RenderOptions options(IntegratorKind integrator)
{
    RenderOptions result;
    result.integrator = integrator;
    result.film.width = 19;
    result.film.height = 14;
    result.film.aovs = {Aov::depth};
    result.sampling.samples = {.begin = 0, .end = 16};
    result.transport.max_depth = 5;
    return result;
}

bool same_bits(const RenderResult& a, const RenderResult& b)
{
    return a.samples == b.samples && a.identity == b.identity &&
           a.film.develop().pixels == b.film.develop().pixels &&
           a.aovs.develop(a.film).at(0).values == b.aovs.develop(b.film).at(0).values &&
           a.stats.paths.camera == b.stats.paths.camera &&
           a.stats.paths.light == b.stats.paths.light;
}

std::string message_of(const std::function<void()>& call)
{
    try {
        call();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST_CASE("a pass that is abandoned leaves nothing behind", "[render]")
{
    const Scene scene = room();
    for (const IntegratorKind kind :
         {IntegratorKind::mis, IntegratorKind::bdpt, IntegratorKind::vcm}) {
        RenderOptions asked = options(kind);
        asked.system.tile_size = 4;
        asked.bidirectional.light_paths = 0.5;  // which all pixels share
        const RenderResult whole = render(scene, room_camera(), asked);
        Renderer renderer(scene, room_camera(), asked);
        renderer.render(4);
        // In the middle of a pass: paths are told of while tiles are rendered.
        std::stop_source abandon;
        RenderControl control;
        control.abandon = abandon.get_token();
        std::atomic<int> paths{0};
        control.on_path = [&](const PathContribution&) {
            ++paths;
            abandon.request_stop();
        };
        renderer.render(8, control);
        CHECK(paths > 0);
        CHECK(renderer.samples() == 0);
        CHECK(renderer.result().film.sample_count() == 0);
        renderer.finish();
        CHECK(same_bits(renderer.result(), whole));
        CHECK(render(scene, room_camera(), asked, control).film.sample_count() == 0);
    }
}

TEST_CASE("a render that is held has the bits of one at once, however it grows", "[render]")
{
    const Scene scene = room();
    for (const IntegratorKind kind : {IntegratorKind::mis, IntegratorKind::automatic,
                                      IntegratorKind::bdpt, IntegratorKind::vcm}) {
        const RenderOptions asked = options(kind);
        const RenderResult whole = render(scene, room_camera(), asked);
        Renderer renderer(scene, room_camera(), asked);
        CHECK(renderer.options().integrator ==
              chosen_options(scene, room_camera(), asked).integrator);
        CHECK(renderer.options().integrator != IntegratorKind::automatic);
        CHECK(renderer.samples() == 0);
        CHECK(std::isinf(renderer.noise()));
        CHECK(renderer.image().pixels.size() == 19 * 14);
        for (const std::int64_t more : {1, 5, 2}) {
            renderer.render(more);
        }
        CHECK(renderer.samples() == 8);
        CHECK(renderer.noise() == estimate_noise(renderer.result().film));
        renderer.finish();
        CHECK(same_bits(renderer.result(), whole));
        CHECK(renderer.image().pixels == whole.film.develop().pixels);
        renderer.finish();  // nothing is missing
        CHECK(renderer.samples() == 16);
        CHECK(renderer.seconds() > 0.0);
    }
}

TEST_CASE("a render that is held goes on beyond the samples of its options", "[render]")
{
    const Scene scene = room();
    RenderOptions asked = options(IntegratorKind::mis);
    asked.sampling.samples = {.begin = 4, .end = 5};
    Renderer renderer(scene, room_camera(), asked);
    renderer.render(12);
    asked.sampling.samples = {.begin = 4, .end = 16};
    CHECK(same_bits(renderer.result(), render(scene, room_camera(), asked)));
}

TEST_CASE("samples from elsewhere are added to a render that is held, and gaps are filled",
          "[render]")
{
    const Scene scene = room();
    RenderOptions asked = options(IntegratorKind::bdpt);
    const RenderResult whole = render(scene, room_camera(), asked);
    asked.sampling.samples = {.begin = 3, .end = 9};
    const RenderResult elsewhere = render(scene, room_camera(), asked);
    asked.sampling.samples = {.begin = 0, .end = 16};
    Renderer renderer(scene, room_camera(), asked);
    renderer.render(1);
    renderer += elsewhere;
    CHECK(renderer.result().samples == SampleSet::parse("0:1,3:9"));
    CHECK(message_of([&] { renderer += elsewhere; }).find("both have the samples 3:9") !=
          std::string::npos);
    renderer.render(4);
    CHECK(renderer.result().samples == SampleSet::parse("0:11"));
    renderer.render(5);
    CHECK(same_bits(renderer.result(), whole));

    asked.transport.max_depth = 4;
    Renderer other(scene, room_camera(), asked);
    CHECK(message_of([&] { other += elsewhere; }).find("option: max_depth (5, not 4)") !=
          std::string::npos);
    CHECK(other.samples() == 0);
}

TEST_CASE("what a render that is held gives away is gone, and it begins anew", "[render]")
{
    const Scene scene = room();
    Renderer first(scene, room_camera(), options(IntegratorKind::mis));
    first.render(3);
    Renderer renderer = std::move(first);
    const RenderResult taken = renderer.take();
    CHECK(taken.samples.count() == 3);
    CHECK(renderer.samples() == 0);
    renderer.render(3);
    CHECK(same_bits(renderer.result(), taken));
}

TEST_CASE("a render that is held is stopped and refused like others", "[render]")
{
    const Scene scene = room();
    Renderer renderer(scene, room_camera(), options(IntegratorKind::mis));
    for (const std::int64_t wrong : {0, -3}) {
        CHECK(message_of([&] { renderer.render(wrong); }) ==
              "number of samples to render is " + std::to_string(wrong) + ", not above 0");
    }
    std::stop_source stop;
    stop.request_stop();
    RenderControl control;
    control.stop = stop.get_token();
    renderer.render(1000, control);
    CHECK(renderer.samples() > 0);
    CHECK(renderer.samples() < 1000);
    RenderOptions wrong = options(IntegratorKind::mis);
    wrong.transport.max_depth = 0;
    CHECK(message_of([&] { Renderer(scene, room_camera(), wrong); }) ==
          "max_depth is 0, not in [1, 4096]");
}

}  // namespace
}  // namespace bdpt::test::renderer_test
