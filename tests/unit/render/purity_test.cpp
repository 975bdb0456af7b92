#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <stdexcept>

namespace bdpt {
namespace {

using test::SceneBuilder;

Scene room()
{
    SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.7f)), test::plastic(Rgb(0.6f), 0.3f));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    // Two surfaces in the same place: which one is hit must not depend on the thread.
    builder.quad({-0.5f, -0.5f, 0.0f}, {0.5f, -0.5f, 0.0f}, {0.5f, 0.0f, 0.0f}, {-0.5f, 0.0f, 0.0f},
                 test::lambertian({0.8f, 0.1f, 0.1f}));
    builder.quad({-0.5f, -0.5f, 0.0f}, {0.5f, -0.5f, 0.0f}, {0.5f, 0.0f, 0.0f}, {-0.5f, 0.0f, 0.0f},
                 test::lambertian({0.1f, 0.1f, 0.8f}));
    builder.sphere({0.4f, -0.7f, 0.4f}, 0.3f, test::glass(0.0f), 16);
    builder.light(PointLightDesc{.position = {-0.5f, 0.0f, 0.5f}, .intensity = Rgb(0.3f)});
    return Scene(std::move(builder.desc));
}

RenderOptions options(IntegratorKind integrator)
{
    RenderOptions result;
    result.integrator = integrator;
    result.width = 37;
    result.height = 29;
    result.samples = {.begin = 0, .end = 8};
    result.max_depth = 5;
    result.seed = 11;
    return result;
}

Film film_of(const Scene& scene, const RenderOptions& options)
{
    return render(scene, test::room_camera(), options).film;
}

}  // namespace

TEST_CASE("the same bits for any threads and tiles", "[purity]")
{
    const Scene scene = room();
    for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::pt, IntegratorKind::mis}) {
        RenderOptions o = options(kind);
        o.threads = 1;
        const Film expected = film_of(scene, o);
        for (const int threads : {2, 8}) {
            o.threads = threads;
            CHECK(film_of(scene, o) == expected);
        }
        for (const int tile : {8, 64}) {
            o.tile_size = tile;
            CHECK(film_of(scene, o) == expected);
        }
        RenderOptions other = o;
        other.seed = 12;
        CHECK_FALSE(film_of(scene, other) == expected);
        other = o;
        other.sampler = SamplerKind::independent;
        CHECK_FALSE(film_of(scene, other) == expected);
    }
}

TEST_CASE("the same bits for a scene that is built again", "[purity]")
{
    CHECK(film_of(room(), options(IntegratorKind::bdpt)) ==
          film_of(room(), options(IntegratorKind::bdpt)));
}

TEST_CASE("a range rendered in parts and merged is the whole", "[purity]")
{
    const Scene scene = room();
    RenderOptions o = options(IntegratorKind::bdpt);
    o.sampler = GENERATE(SamplerKind::sobol, SamplerKind::independent);
    const Film whole = film_of(scene, o);
    o.samples = {.begin = 5, .end = 8};
    Film parts = film_of(scene, o);
    o.samples = {.begin = 0, .end = 1};
    parts.merge(film_of(scene, o));
    o.samples = {.begin = 1, .end = 5};
    parts.merge(film_of(scene, o));
    CHECK(parts == whole);
    CHECK(parts.defects().invalid == 0);
}

TEST_CASE("a stop ends the render after a whole pass", "[render]")
{
    const Scene scene = room();
    RenderOptions o = options(IntegratorKind::mis);
    o.samples = {.begin = 0, .end = 1000000};
    std::stop_source source;
    RenderControl control;
    control.stop = source.get_token();
    control.on_progress = [&](const Progress& progress) {
        CHECK(progress.samples_total == 1000000);
        if (progress.samples_done >= 3) {
            source.request_stop();
        }
    };
    const RenderResult stopped = render(scene, test::room_camera(), o, control);
    REQUIRE(stopped.samples.end >= 3);
    REQUIRE(stopped.samples.end < 1000000);
    CHECK(stopped.film.sample_count() == stopped.samples.end);
    o.samples.end = stopped.samples.end;
    CHECK(film_of(scene, o) == stopped.film);
}

TEST_CASE("what a progress callback throws reaches the caller", "[render]")
{
    const Scene scene = room();
    RenderControl control;
    control.on_progress = [](const Progress&) { throw std::runtime_error("enough"); };
    CHECK_THROWS_AS(render(scene, test::room_camera(), options(IntegratorKind::bdpt), control),
                    std::runtime_error);
    // And the next render is not harmed.
    CHECK(film_of(scene, options(IntegratorKind::pt)).sample_count() == 8);
}

TEST_CASE("a time limit ends the render early, but not before one pass", "[render]")
{
    const Scene scene = room();
    RenderOptions o = options(IntegratorKind::pt);
    o.samples = {.begin = 0, .end = 1000000};
    RenderControl control;
    control.time_limit = 0.0;
    const RenderResult result = render(scene, test::room_camera(), o, control);
    CHECK(result.samples.end >= 1);
    CHECK(result.samples.end < 1000000);
}

}  // namespace bdpt
