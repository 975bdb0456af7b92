#include <bdpt/render.h>

#include "catch.hpp"
#include "purity.h"
#include "room.h"
#include "scene_builder.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

namespace bdpt::purity_test {
namespace {

using test::check_region;
using test::room;
using test::SceneBuilder;

RenderOptions options(IntegratorKind integrator)
{
    RenderOptions result;
    result.integrator = integrator;
    result.film.width = 37;
    result.film.height = 29;
    result.sampling.samples = {.begin = 0, .end = 8};
    result.transport.max_depth = 5;
    result.sampling.seed = 11;
    return result;
}

Film film_of(const Scene& scene, const RenderOptions& options)
{
    return render(scene, test::room_camera(), options).film;
}

const AovSet all_aovs{Aov::albedo,       Aov::normal,   Aov::depth,    Aov::position,
                      Aov::sample_count, Aov::variance, Aov::alpha,    Aov::shadow,
                      Aov::opacity,      Aov::uv,       Aov::distance, Aov::camera_normal};

std::vector<float> crop_of(const Layer& layer, const PixelRect& crop)
{
    std::vector<float> values;
    const auto channels = static_cast<std::ptrdiff_t>(layer.channels.size());
    for (int y = crop.y0; y < crop.y1; ++y) {
        const auto row = layer.values.begin() + channels * layer.width * y;
        values.insert(values.end(), row + channels * crop.x0, row + channels * crop.x1);
    }
    return values;
}

}  // namespace

TEST_CASE("the same bits for any threads and tiles", "[purity]")
{
    const Scene scene = room();
    for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::pt, IntegratorKind::mis}) {
        RenderOptions o = options(kind);
        o.system.threads = 1;
        const Film expected = film_of(scene, o);
        for (const int threads : {2, 8}) {
            o.system.threads = threads;
            CHECK(film_of(scene, o) == expected);
        }
        for (const int tile : {8, 64}) {
            o.system.tile_size = tile;
            CHECK(film_of(scene, o) == expected);
        }
        RenderOptions other = o;
        other.sampling.seed = 12;
        CHECK_FALSE(film_of(scene, other) == expected);
        other = o;
        other.sampling.sampler = SamplerKind::independent;
        CHECK_FALSE(film_of(scene, other) == expected);
        o.film.filter.kind = FilterKind::gaussian;
        const Film filtered = film_of(scene, o);
        CHECK_FALSE(filtered == expected);
        o.system.threads = 1;
        o.system.tile_size = 5;
        CHECK(film_of(scene, o) == filtered);
        o.sampling.seed = 12;
        CHECK_FALSE(film_of(scene, o) == filtered);
    }
}

TEST_CASE("roulette that lets every walk go on changes no bit", "[purity]")
{
    const Scene scene = room();
    for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::mis, IntegratorKind::lt}) {
        RenderOptions o = options(kind);
        o.transport.rr_start = o.transport.max_depth;
        const Film expected = film_of(scene, o);
        o.transport.rr_start = 1;
        CHECK_FALSE(film_of(scene, o) == expected);
        o.transport.rr_survival = 0.7f;
        CHECK_FALSE(film_of(scene, o) == expected);
        o.transport.rr_survival = 1.0f;
        CHECK(film_of(scene, o) == expected);
    }
}

TEST_CASE("the same bits in media, for any threads, tiles, parts and crops", "[purity][media]")
{
    SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.7f)), test::plastic(Rgb(0.6f), 0.3f));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    MaterialDesc milk = test::glass(0.3f);
    milk.attenuation_color = {0.3f, 0.4f, 0.5f};
    milk.attenuation_distance = 0.2f;
    milk.volume_scatter = {.color = Rgb(0.9f), .anisotropy = 0.4f};
    builder.sphere({0.3f, -0.5f, 0.2f}, 0.4f, milk, 16);
    builder.desc.fog = MediumDesc{.extinction = {0.2f, 0.4f, 0.8f}, .albedo = {0.9f, 0.8f, 0.7f}};
    VolumeDesc smoke;
    smoke.size = {2, 2, 2};
    smoke.density = {1, 0, 2, 0.5f, 3, 1, 0, 1};
    smoke.world_from_grid = Mat4(0.6f);
    smoke.world_from_grid[3] = Vec4(-0.8f, -0.5f, -0.5f, 1.0f);
    builder.desc.volumes.push_back(smoke);
    const Scene scene(std::move(builder.desc));
    for (const auto kind : {IntegratorKind::mis, IntegratorKind::lt, IntegratorKind::bdpt,
                            IntegratorKind::vcm, IntegratorKind::automatic}) {
        CAPTURE(static_cast<int>(kind));
        RenderOptions o = options(kind);
        o.sampling.samples = {.begin = 0, .end = 6};
        o.system.threads = 1;
        test::check_purity(scene, o, render(scene, test::room_camera(), o));
    }
}

TEST_CASE("the same bits for a scene that is built again", "[purity]")
{
    CHECK(film_of(room(), options(IntegratorKind::bdpt)) ==
          film_of(room(), options(IntegratorKind::bdpt)));
}

TEST_CASE("the same bits with a pinned instruction set, too", "[purity]")
{
    for (const Isa isa : test::isas_of_this_cpu()) {
        CAPTURE(isa_name(isa));
        const Scene scene = room(isa);
        REQUIRE(scene.isa() == isa);
        RenderOptions o = options(IntegratorKind::bdpt);
        o.system.threads = 1;
        const Film expected = film_of(scene, o);
        o.system.threads = 8;
        o.system.tile_size = 64;
        CHECK(film_of(scene, o) == expected);
        CHECK(film_of(room(isa), o) == expected);
        o.system.threads = 2;
        o.system.tile_size = 8;
        o.sampling.samples = {.begin = 3, .end = 8};
        Film parts = film_of(scene, o);
        o.sampling.samples = {.begin = 0, .end = 3};
        parts.merge(film_of(scene, o));
        CHECK(parts == expected);
        o.sampling.samples = {.begin = 0, .end = 8};
        o.film.crop = PixelRect{5, 3, 24, 20};
        check_region(film_of(scene, o).develop(), expected.develop(), *o.film.crop);
    }
}

TEST_CASE("the same bits however many threads the scene is built with", "[purity]")
{
    // Large enough for Embree to build in parallel, and twice in the same place, so that the order
    // of the triangles in its tree decides which one is hit.
    const auto build = [](int threads) {
        SceneBuilder builder;
        for (const Rgb color : {Rgb(0.9f, 0.1f, 0.1f), Rgb(0.1f, 0.1f, 0.9f)}) {
            builder.sphere({0.0f, 0.0f, 0.0f}, 0.9f, test::lambertian(color), 160);
        }
        builder.light(PointLightDesc{.position = {2.0f, 2.0f, 3.0f}, .intensity = Rgb(9.0f)});
        std::optional<Scene> scene;
        const tbb::global_control allowance(tbb::global_control::max_allowed_parallelism, 16);
        tbb::task_arena arena(threads);
        arena.execute([&] { scene.emplace(std::move(builder.desc)); });
        return std::move(*scene);
    };
    const RenderOptions o = options(IntegratorKind::mis);
    const Film expected = film_of(build(1), o);
    CHECK(film_of(build(2), o) == expected);
    CHECK(film_of(build(16), o) == expected);
}

TEST_CASE("a range rendered in parts and merged is the whole", "[purity]")
{
    const Scene scene = room();
    RenderOptions o = options(IntegratorKind::bdpt);
    o.sampling.sampler = GENERATE(SamplerKind::sobol, SamplerKind::independent);
    o.film.filter.kind = GENERATE(FilterKind::box, FilterKind::blackman_harris);
    const Film whole = film_of(scene, o);
    o.sampling.samples = {.begin = 5, .end = 8};
    Film parts = film_of(scene, o);
    o.sampling.samples = {.begin = 0, .end = 1};
    parts.merge(film_of(scene, o));
    o.sampling.samples = {.begin = 1, .end = 5};
    parts.merge(film_of(scene, o));
    CHECK(parts == whole);
    CHECK(parts.defects().invalid == 0);
}

TEST_CASE("a crop has the pixels of the whole image, to the bit", "[purity]")
{
    const Scene scene = room();
    const auto filter = GENERATE(FilterKind::box, FilterKind::gaussian);
    for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::pt, IntegratorKind::mis}) {
        RenderOptions o = options(kind);
        o.film.filter.kind = filter;
        const Film whole = film_of(scene, o);
        for (const PixelRect crop : {PixelRect{0, 0, 37, 29}, PixelRect{5, 3, 24, 20},
                                     PixelRect{36, 28, 37, 29}, PixelRect{0, 17, 37, 18}}) {
            o.film.crop = crop;
            o.system.threads = 1;
            o.system.tile_size = 8;
            const Film part = film_of(scene, o);
            o.system.threads = 8;
            o.system.tile_size = 16;
            CHECK(film_of(scene, o) == part);
            CHECK(part.sample_count() == 8);
            check_region(part.develop(), whole.develop(), crop);
            check_region(part.develop_half(1), whole.develop_half(1), crop);
        }
    }
}

TEST_CASE("a clamp takes what is missing, and is pure", "[purity]")
{
    const Scene scene = room();
    RenderOptions o = options(GENERATE(IntegratorKind::bdpt, IntegratorKind::mis));
    o.bidirectional.disabled = {
        {.s = 1, .t = 1}};  // so that lamps are seen by camera samples, above the clamp
    const auto mean = [](const Film& film) {
        glm::dvec3 sum(0.0);
        for (const Rgb& pixel : film.develop().pixels) {
            sum += glm::dvec3(pixel) / (37.0 * 29.0);
        }
        return sum;
    };
    const glm::dvec3 whole = mean(film_of(scene, o));
    o.film.clamp = 0.3f;
    o.system.threads = 1;
    const Film clamped = film_of(scene, o);
    const glm::dvec3 rest = mean(clamped);
    const ClampLoss loss = clamped.clamp_loss();
    CHECK(loss.contributions > 100);
    CHECK(static_cast<double>(loss.radiance.g) > 0.05 * whole.g);
    for (int c = 0; c < 3; ++c) {
        CHECK(rest[c] + static_cast<double>(loss.radiance[c]) == Approx(whole[c]).epsilon(1e-5));
    }
    o.system.threads = 8;
    o.system.tile_size = 3;
    CHECK(film_of(scene, o) == clamped);
    o.sampling.samples = {.begin = 0, .end = 3};
    Film parts = film_of(scene, o);
    o.sampling.samples = {.begin = 3, .end = 8};
    parts.merge(film_of(scene, o));
    CHECK(parts == clamped);
}

TEST_CASE("AOVs are pure too, in any crop, and the same for every integrator", "[purity][aov]")
{
    const Scene scene = room();
    RenderOptions o = options(IntegratorKind::pt);
    o.film.aovs = all_aovs;
    o.film.filter.kind = FilterKind::tent;
    o.system.threads = 1;
    const RenderResult whole = render(scene, test::room_camera(), o);
    o.system.threads = 8;
    o.system.tile_size = 5;
    for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::mis}) {
        o.integrator = kind;
        CHECK(render(scene, test::room_camera(), o).aovs == whole.aovs);
    }
    o.integrator = IntegratorKind::pt;
    o.sampling.samples = {.begin = 3, .end = 8};
    RenderResult parts = render(scene, test::room_camera(), o);
    CHECK_FALSE(parts.aovs == whole.aovs);
    o.sampling.samples = {.begin = 0, .end = 3};
    const RenderResult first = render(scene, test::room_camera(), o);
    parts.film.merge(first.film);
    parts.aovs.merge(first.aovs);
    CHECK(parts.aovs == whole.aovs);
    CHECK(parts.film == whole.film);
    parts.stats += first.stats;
    CHECK(parts.stats == whole.stats);

    o = options(GENERATE(IntegratorKind::bdpt, IntegratorKind::pt));
    o.film.aovs = all_aovs;
    o.film.filter.kind = FilterKind::tent;
    const RenderResult all = render(scene, test::room_camera(), o);
    const std::vector<Layer> expected = all.aovs.develop(all.film);
    o.film.crop = PixelRect{7, 4, 30, 9};
    const RenderResult part = render(scene, test::room_camera(), o);
    const std::vector<Layer> layers = part.aovs.develop(part.film);
    REQUIRE(layers.size() == expected.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        CAPTURE(layers[i].name);
        CHECK(layers[i].values == crop_of(expected[i], *o.film.crop));
    }
}

TEST_CASE("a stop ends the render after a whole pass", "[render]")
{
    const Scene scene = room();
    RenderOptions o = options(IntegratorKind::mis);
    o.sampling.samples = {.begin = 0, .end = 1000000};
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
    REQUIRE(stopped.samples.end() >= 3);
    REQUIRE(stopped.samples.end() < 1000000);
    CHECK(stopped.film.sample_count() == stopped.samples.end());
    o.sampling.samples.end = stopped.samples.end();
    CHECK(film_of(scene, o) == stopped.film);
}

TEST_CASE("progress counts the samples of its own range", "[render]")
{
    const Scene scene = room();
    RenderOptions o = options(IntegratorKind::pt);
    o.sampling.samples = {.begin = 1000, .end = 1012};
    std::int64_t done = 0;
    RenderControl control;
    control.on_progress = [&](const Progress& progress) {
        CHECK(progress.samples_total == 12);
        CHECK(progress.samples_done > done);
        done = progress.samples_done;
    };
    const RenderResult result = render(scene, test::room_camera(), o, control);
    CHECK(done == 12);
    CHECK(result.samples.ranges().front().begin == 1000);
    CHECK(result.samples.end() == 1012);
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
    o.sampling.samples = {.begin = 0, .end = 1000000};
    RenderControl control;
    control.time_limit = 0.0;
    const RenderResult result = render(scene, test::room_camera(), o, control);
    CHECK(result.samples.end() >= 1);
    CHECK(result.samples.end() < 1000000);
}

}  // namespace bdpt::purity_test
