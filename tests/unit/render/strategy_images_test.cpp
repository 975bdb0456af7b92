#include <bdpt/error.h>
#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace bdpt::strategy_images_test {
namespace {

/// Lamp and surfaces that do not touch, so that each strategy alone has little noise.
Scene stage()
{
    test::SceneBuilder builder;
    builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1},
                 test::lambertian({0.8f, 0.6f, 0.4f}));
    builder.quad({-0.8f, -0.6f, -1.6f}, {0.8f, -0.6f, -1.6f}, {0.8f, 0.9f, -1.6f},
                 {-0.8f, 0.9f, -1.6f}, test::plastic(Rgb(0.7f), 0.6f));
    builder.lamp(1.0f, 1.1f, Rgb(4.0f, 3.5f, 3.0f));
    return Scene(std::move(builder.desc));
}

CameraDesc pinhole()
{
    return test::camera_at({0.0f, 0.3f, 3.6f}, {0.0f, 0.0f, 0.0f}, 0.75f);
}

CameraDesc thin_lens()
{
    return test::with_lens(pinhole(), 1.2f, 3.4f);
}

CameraDesc parallel()
{
    return test::in_parallel(pinhole(), 2.6f);
}

RenderOptions options(IntegratorKind integrator = IntegratorKind::bdpt)
{
    RenderOptions result;
    result.integrator = integrator;
    result.film.width = 23;
    result.film.height = 17;
    result.sampling.samples = {.begin = 0, .end = 6};
    result.transport.max_depth = 4;
    result.bidirectional.strategy_depth = 4;
    result.sampling.seed = 5;
    return result;
}

glm::dvec3 mean(const Image& image)
{
    glm::dvec3 sum(0.0);
    for (const Rgb& pixel : image.pixels) {
        sum += glm::dvec3(pixel);
    }
    return sum / static_cast<double>(image.pixels.size());
}

/// The greatest difference of two pixels, relative to the brighter one.
double difference(const Image& a, const Image& b)
{
    REQUIRE(a.pixels.size() == b.pixels.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double x = static_cast<double>(a.pixels[i][c]);
            const double y = static_cast<double>(b.pixels[i][c]);
            worst = std::max(worst, std::abs(x - y) / std::max({x, y, 1e-4}));
        }
    }
    return worst;
}

Image sum_of_weighted(const StrategyFilm& film)
{
    std::vector<glm::dvec3> sums;
    for (const Strategy& strategy : film.strategies()) {
        const Image image = film.weighted(strategy);
        sums.resize(image.pixels.size(), glm::dvec3(0.0));
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sums[i] += glm::dvec3(image.pixels[i]);
        }
    }
    return {film.region().width(), film.region().height(), {sums.begin(), sums.end()}};
}

/// That the images are parts of the whole image, and do not change it.
void check_sum(const Scene& scene, const CameraDesc& camera, RenderOptions o)
{
    const RenderResult result = render(scene, camera, o);
    const Image image = result.film.develop();
    CHECK(mean(image).g > 0.01);
    CHECK(difference(sum_of_weighted(result.strategies), image) < 2e-6);
    o.bidirectional.strategy_depth = 0;
    const RenderResult without = render(scene, camera, o);
    CHECK(without.film == result.film);
    CHECK(without.strategies.empty());
}

std::vector<std::string> names(const Scene& scene, const CameraDesc& camera, const RenderOptions& o)
{
    std::vector<std::string> result;
    const RenderResult render_result = render(scene, camera, o);
    for (const Strategy& strategy : render_result.strategies.strategies()) {
        result.push_back(strategy_name(strategy));
    }
    return result;
}

}  // namespace

TEST_CASE("weighted images add up to the whole image", "[strategy images]")
{
    const Scene scene = stage();
    for (const auto heuristic : {Heuristic::balance, Heuristic::power, Heuristic::cutoff,
                                 Heuristic::maximum, Heuristic::uniform}) {
        CAPTURE(static_cast<int>(heuristic));
        for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::lt}) {
            RenderOptions o = options(kind);
            o.transport.heuristic = heuristic;
            check_sum(scene, pinhole(), o);
            check_sum(scene, thin_lens(), o);
        }
    }
    RenderOptions o = options();
    SECTION("three light paths")
    {
        o.bidirectional.light_paths = 3;
        check_sum(scene, thin_lens(), o);
    }
    SECTION("a crop")
    {
        o.film.crop = PixelRect{.x0 = 3, .y0 = 8, .x1 = 21, .y1 = 16};
        o.bidirectional.light_paths = 2;
        check_sum(scene, thin_lens(), o);
    }
    SECTION("strategies left out, a filter")
    {
        o.bidirectional.disabled = {{.s = 1, .t = 2}, {.s = 2, .t = 1}};
        o.film.filter.kind = FilterKind::gaussian;
        check_sum(scene, pinhole(), o);
    }
    SECTION("indirect light, short subpaths, roulette")
    {
        o.transport.min_depth = 3;
        o.bidirectional.max_camera_depth = 2;
        o.transport.rr_start = 1;
        check_sum(scene, pinhole(), o);
    }
    SECTION("orthographic")
    {
        check_sum(scene, parallel(), o);
    }
}

TEST_CASE("a smaller depth keeps the images of the short paths", "[strategy images]")
{
    const Scene scene = stage();
    RenderOptions o = options();
    const RenderResult all = render(scene, thin_lens(), o);
    o.bidirectional.strategy_depth = 2;
    const RenderResult some = render(scene, thin_lens(), o);
    CHECK(some.film == all.film);
    REQUIRE(some.strategies.strategies().size() == 7);
    for (const Strategy& strategy : some.strategies.strategies()) {
        CAPTURE(strategy_name(strategy));
        CHECK(strategy.s + strategy.t - 1 <= 2);
        CHECK(some.strategies.weighted(strategy).pixels ==
              all.strategies.weighted(strategy).pixels);
    }
}

TEST_CASE("an unweighted image is what that strategy renders alone", "[strategy images]")
{
    const Scene scene = stage();
    RenderOptions o = options();
    o.bidirectional.light_paths = GENERATE(1, 3);
    o.bidirectional.visible_light_samples = 1.0;  // as where camera paths do not hit lights
    o.sampling.samples = {.begin = 0, .end = 64};
    // With weights beside 1 for splats.
    o.film.filter = {.kind = FilterKind::gaussian, .radius = 0.7f};
    const CameraDesc camera = thin_lens();
    const StrategyFilm film = render(scene, camera, o).strategies;
    REQUIRE(film.strategies().size() == 3 + 4 + 5 + 6);
    for (const Strategy& strategy : film.strategies()) {
        CAPTURE(strategy_name(strategy), o.bidirectional.light_paths);
        // The same random numbers serve a strategy whether there are others or not.
        RenderOptions alone = o;
        alone.bidirectional.strategy_depth = 0;
        for (const Strategy& other : film.strategies()) {
            if (other != strategy) {
                alone.bidirectional.disabled.push_back(other);
            }
        }
        const Image image = render(scene, camera, alone).film.develop();
        CHECK(difference(film.unweighted(strategy), image) < 1e-5);
        CHECK(mean(image).g > 0.0);
    }
}

TEST_CASE("unweighted images of one length have equal means", "[strategy images]")
{
    const Scene scene = stage();
    RenderOptions o = options();
    o.bidirectional.strategy_depth = 3;
    o.transport.max_depth = 3;
    o.bidirectional.light_paths = 2;
    o.sampling.samples = {.begin = 0, .end = 1024};
    const StrategyFilm film = render(scene, thin_lens(), o).strategies;
    // What other seeds give differs by less than a third of this.
    constexpr double tolerance = 0.1;
    for (const int edges : {1, 2, 3}) {
        const double by_hits = mean(film.unweighted({.s = 0, .t = edges + 1})).g;
        CHECK(by_hits > 0.0);
        for (int s = 1; s <= edges + 1; ++s) {
            CAPTURE(edges, s);
            const double other = mean(film.unweighted({.s = s, .t = edges + 1 - s})).g;
            CHECK(other == Approx(by_hits).epsilon(tolerance));
        }
    }
}

TEST_CASE("images of strategies have the same bits for any threads, tiles and parts",
          "[strategy images]")
{
    const Scene scene = stage();
    RenderOptions o = options();
    o.bidirectional.light_paths = 2;
    o.film.filter.kind = FilterKind::tent;
    o.system.threads = 1;
    const StrategyFilm expected = render(scene, thin_lens(), o).strategies;
    for (const int tile : {8, 16}) {
        for (const int threads : {1, 2}) {
            o.system.tile_size = tile;
            o.system.threads = threads;
            CHECK(render(scene, thin_lens(), o).strategies == expected);
        }
    }
    o.sampling.samples = {.begin = 4, .end = 6};
    StrategyFilm parts = render(scene, thin_lens(), o).strategies;
    CHECK_FALSE(parts == expected);
    o.sampling.samples = {.begin = 0, .end = 4};
    parts.merge(render(scene, thin_lens(), o).strategies);
    CHECK(parts == expected);

    o = options();
    const StrategyFilm whole = render(scene, thin_lens(), o).strategies;
    o.film.crop = PixelRect{.x0 = 3, .y0 = 8, .x1 = 21, .y1 = 16};
    const StrategyFilm crop = render(scene, thin_lens(), o).strategies;
    REQUIRE(crop.strategies() == whole.strategies());
    for (const Strategy& strategy : whole.strategies()) {
        CAPTURE(strategy_name(strategy));
        const Image all = whole.unweighted(strategy);
        const Image part = crop.unweighted(strategy);
        int different = 0;
        for (int y = 8; y < 16; ++y) {
            for (int x = 3; x < 21; ++x) {
                different += part.at(x - 3, y - 8) == all.at(x, y) ? 0 : 1;
            }
        }
        CHECK(different == 0);
    }
}

TEST_CASE("there are images of the strategies that are used and no others", "[strategy images]")
{
    using Names = std::vector<std::string>;
    const Scene scene = stage();
    RenderOptions o = options();
    o.sampling.samples = {.begin = 0, .end = 1};
    o.bidirectional.strategy_depth = 2;
    CHECK(names(scene, pinhole(), o) == Names{"s00t02", "s01t01", "s00t03", "s01t02", "s02t01"});
    CHECK(names(scene, thin_lens(), o) ==
          Names{"s00t02", "s01t01", "s02t00", "s00t03", "s01t02", "s02t01", "s03t00"});
    CHECK(names(scene, parallel(), o) == Names{"s00t02", "s00t03", "s01t02", "s02t01"});
    o.bidirectional.disabled = {{.s = 1, .t = 2}};
    o.transport.min_depth = 2;
    CHECK(names(scene, pinhole(), o) == Names{"s00t03", "s02t01"});
    o.bidirectional.max_light_depth = 0;
    CHECK(names(scene, pinhole(), o) == Names{"s00t03"});
    o = options(IntegratorKind::lt);
    o.transport.max_depth = 2;
    o.bidirectional.strategy_depth = 9;
    CHECK(names(scene, thin_lens(), o) == Names{"s01t01", "s02t00", "s02t01", "s03t00"});
    o.bidirectional.strategy_depth = 0;
    CHECK(names(scene, thin_lens(), o).empty());
}

TEST_CASE("the memory of images of strategies is known beforehand and limited", "[strategy images]")
{
    RenderOptions o = options();
    // 3 + 4 + 5 + 6 strategies with two images of three 128-bit sums and three floats a pixel
    CHECK(strategy_image_bytes(o, thin_lens()) == 18U * 23 * 17 * 2 * 3 * (16 + 4));
    CHECK(strategy_image_bytes(o, pinhole()) == 14U * 23 * 17 * 2 * 3 * (16 + 4));
    o.film.crop = PixelRect{.x0 = 0, .y0 = 0, .x1 = 5, .y1 = 7};
    CHECK(strategy_image_bytes(o, pinhole()) == 14U * 5 * 7 * 120);
    o.bidirectional.strategy_depth = 0;
    CHECK(strategy_image_bytes(o, pinhole()) == 0);
    o.transport.max_depth = 4096;
    o.bidirectional.strategy_depth = 4096;
    o.film.width = 65536;
    o.film.height = 65536;
    o.film.crop.reset();
    // More than any machine has, and still counted right.
    const std::uint64_t strategies = std::uint64_t{4096} * 4099 / 2;
    CHECK(strategy_image_bytes(o, pinhole()) == strategies * 120 * 65536 * 65536);
    const Scene scene = stage();
    CHECK_THROWS_AS(render(scene, pinhole(), o), Error);

    o = options();
    o.bidirectional.strategy_memory = strategy_image_bytes(o, pinhole());
    CHECK(render(scene, pinhole(), o).strategies.strategies().size() == 14);
    --o.bidirectional.strategy_memory;
    try {
        static_cast<void>(render(scene, pinhole(), o));
        FAIL("not refused");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::usage);
        CHECK(std::string(error.what()) ==
              "images of strategies up to 4 edges (strategy_depth) take 1 MB, more than the limit "
              "(strategy_memory) of 1 MB");
    }
}

TEST_CASE("only integrators with light paths have images of strategies", "[strategy images]")
{
    const Scene scene = stage();
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::nee}) {
        CHECK_THROWS_AS(render(scene, pinhole(), options(kind)), Error);
        CHECK_THROWS_AS(strategy_image_bytes(options(kind), pinhole()), Error);
    }
    RenderOptions o = options();
    o.bidirectional.strategy_depth = -1;
    CHECK_THROWS_AS(render(scene, pinhole(), o), Error);
    o.bidirectional.strategy_depth = 4097;
    CHECK_THROWS_AS(render(scene, pinhole(), o), Error);
}

}  // namespace bdpt::strategy_images_test
