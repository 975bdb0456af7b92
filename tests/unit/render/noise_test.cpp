#include <bdpt/error.h>
#include <bdpt/noise.h>
#include <bdpt/render.h>

#include "catch.hpp"
#include "room.h"
#include "scene_builder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <stop_token>
#include <utility>
#include <vector>

namespace bdpt::test::noise_test {
namespace {

constexpr int side = 320;  // [pixels], 400 tiles
constexpr int samples = 32;

/// A film of grey pixels, each with `samples` samples of a normal distribution: its mean and its
/// standard deviation by tile of 16 x 16 pixels.
struct Grey {
    double mean = 1.0;
    double deviation = 0.1;
};

enum class From : std::uint8_t { camera, light };

Film noisy_film(const std::function<Grey(int tile)>& grey, From from = From::camera)
{
    Film film(
        {.width = side, .height = side, .region = {.x0 = 0, .y0 = 0, .x1 = side, .y1 = side}});
    std::mt19937 engine(5);
    std::normal_distribution<double> normal;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const Grey g = grey(y / 16 * (side / 16) + x / 16);
            for (int i = 0; i < samples; ++i) {
                const Rgb value(static_cast<float>(g.mean + g.deviation * normal(engine)));
                if (from == From::camera) {
                    film.add_sample(x, y, i, value);
                } else {
                    film.add_splat(Vec2(x, y) + 0.5f, i, value);
                }
            }
        }
    }
    film.count_samples(0, samples);
    return film;
}

const double clean = 1.0 / std::sqrt(samples);  // what is left of a deviation

TEST_CASE("noise is the deviation of pixels over their mean", "[noise]")
{
    // Estimates of tiles spread by 9 %, and 95 % of them are not above the result.
    const auto grey = [](int) { return Grey{.mean = 2.0, .deviation = 0.3}; };
    const double expected = 0.15 * clean;
    CHECK(estimate_noise(noisy_film(grey)) == Approx(1.07 * expected).epsilon(0.03));
    CHECK(estimate_noise(noisy_film(grey, From::light)) == Approx(1.07 * expected).epsilon(0.03));
}

TEST_CASE("noise is that of nearly all tiles that have some", "[noise][long]")
{
    const auto some = [](int one_of) {
        return [one_of](int tile) { return Grey{.deviation = tile % one_of == 0 ? 0.4 : 0.04}; };
    };
    CHECK(estimate_noise(noisy_film(some(10))) > 0.35 * clean);
    CHECK(estimate_noise(noisy_film(some(40))) < 0.06 * clean);
    // Background without any noise hides nothing.
    const auto in_the_void = [](int tile) {
        return tile % 40 == 0 ? Grey{.deviation = 0.2} : Grey{.mean = 0.0, .deviation = 0.0};
    };
    CHECK(estimate_noise(noisy_film(in_the_void)) > 0.17 * clean);
    const auto in_a_sky = [](int tile) {
        return tile % 40 == 0 ? Grey{.deviation = 0.2} : Grey{.deviation = 0.0002};
    };
    CHECK(estimate_noise(noisy_film(in_a_sky)) > 0.17 * clean);
    // Tiles that are nearly black are measured by the image: 1 % of its mean is their floor.
    const auto in_the_dark = [](int tile) {
        return tile % 2 == 0 ? Grey{.mean = 1.0, .deviation = 0.0}
                             : Grey{.mean = 0.001, .deviation = 0.0002};
    };
    CHECK(estimate_noise(noisy_film(in_the_dark)) == Approx(1.07 * 0.04 * clean).epsilon(0.05));
}

TEST_CASE("silhouettes before an empty background are judged as before a bright one", "[noise]")
{
    // A clean grey disk whose border covers pixels by chance, before nothing.
    Film film(
        {.width = side, .height = side, .region = {.x0 = 0, .y0 = 0, .x1 = side, .y1 = side}});
    AovFilm alpha(film.region(), {Aov::alpha});
    AovFilm normals(film.region(), {Aov::normal});
    std::mt19937 engine(5);
    std::normal_distribution<float> normal(2.0f, 0.2f);
    std::uniform_real_distribution<float> uniform;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            for (int i = 0; i < samples; ++i) {
                const Vec2 at = Vec2(x, y) + Vec2(uniform(engine), uniform(engine)) - side / 2.0f;
                const bool hit = dot(at, at) < 100.0f * 100.0f;
                film.add_sample(x, y, i, Rgb(hit ? normal(engine) : 0.0f));
                if (hit) {
                    alpha.add(x, y, {});
                    normals.add(x, y, {});
                }
            }
        }
    }
    film.count_samples(0, samples);
    const double inside = 1.07 * 0.1 * clean;
    CHECK(estimate_noise(film) > 4.0 * inside);
    CHECK(estimate_noise(film, normals) == estimate_noise(film));  // all of it is shown
    CHECK(estimate_noise(film, alpha) == Approx(inside).epsilon(0.05));
}

TEST_CASE("a film without noise is clean, and one that tells nothing is not", "[noise]")
{
    const double unknown = std::numeric_limits<double>::infinity();
    CHECK(estimate_noise(noisy_film([](int) { return Grey{.deviation = 0.0}; })) == 0.0);
    CHECK(estimate_noise(noisy_film([](int) { return Grey{.mean = 0.0, .deviation = 0.0}; })) ==
          unknown);
    Film film({.width = 3, .height = 2, .region = {.x0 = 0, .y0 = 0, .x1 = 3, .y1 = 2}});
    CHECK(estimate_noise(film) == unknown);
    film.add_sample(1, 1, 0, Rgb(1.0f));
    film.count_samples(0, 1);
    CHECK(estimate_noise(film) == unknown);
    film.count_samples(1, 2);
    CHECK(estimate_noise(film) > 1.0);
}

/// Brightness of the samples of each half of the film.
struct Halves {
    float even = 1.0f;
    float odd = 1.0f;
};

/// A row of tiles whose pixels have two samples each.
Film row_of_tiles(const std::vector<Halves>& tiles)
{
    constexpr int tile = 16;
    const int width = tile * static_cast<int>(tiles.size());
    Film film({.width = width, .height = tile, .region = {.x1 = width, .y1 = tile}});
    for (int y = 0; y < tile; ++y) {
        for (int x = 0; x < width; ++x) {
            const Halves& halves = tiles[static_cast<std::size_t>(x / tile)];
            film.add_sample(x, y, 0, Rgb(halves.even));
            film.add_sample(x, y, 1, Rgb(halves.odd));
        }
    }
    film.count_samples(0, 2);
    return film;
}

TEST_CASE("of fewer than 20 tiles none is left out", "[noise]")
{
    for (std::size_t tiles = 1; tiles < 20; ++tiles) {
        CAPTURE(tiles);
        std::vector<Halves> halves(tiles, {.even = 1.1f, .odd = 0.9f});
        halves[tiles / 2] = {.even = 1.5f, .odd = 0.5f};
        CHECK(estimate_noise(row_of_tiles(halves)) == Approx(0.5));
    }
    std::vector<Halves> twenty(20, {.even = 1.1f, .odd = 0.9f});
    twenty[7] = {.even = 1.5f, .odd = 0.5f};
    CHECK(estimate_noise(row_of_tiles(twenty)) == Approx(0.1));
}

TEST_CASE("noise is relative to the mean of both halves", "[noise]")
{
    CHECK(estimate_noise(row_of_tiles({{.even = 3.0f, .odd = 1.0f}})) == Approx(0.5));
    CHECK(estimate_noise(row_of_tiles({{.even = 1.0f, .odd = 3.0f}})) == Approx(0.5));
}

TEST_CASE("noise is looked at where halves have good sets of points", "[noise]")
{
    std::vector<std::int64_t> looks;
    for (std::int64_t n = next_noise_look(0); n < 800; n = next_noise_look(n)) {
        looks.push_back(n);
    }
    CHECK(looks == std::vector<std::int64_t>{16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768});
    CHECK(next_noise_look(40) == 48);
    CHECK(is_noise_look(48));
    for (const std::int64_t n : {0, 8, 12, 15, 17, 47, 49, 80}) {
        CHECK_FALSE(is_noise_look(n));
    }
    CHECK(samples_for_noise(0.04, 64, 0.02) == 256);
    CHECK(samples_for_noise(0.041, 64, 0.02) == 384);
    CHECK(samples_for_noise(std::numeric_limits<double>::infinity(), 64, 0.02) == 1LL << 31);
}

RenderOptions options(IntegratorKind kind, std::uint64_t seed)
{
    RenderOptions result;
    result.integrator = kind;
    result.film.width = 48;
    result.film.height = 32;
    result.transport.max_depth = 4;
    result.sampling = {.samples = {.begin = 0, .end = 32}, .seed = seed};
    return result;
}

double luminance_of(Rgb c)
{
    return 0.2126 * static_cast<double>(c.r) + 0.7152 * static_cast<double>(c.g) +
           0.0722 * static_cast<double>(c.b);
}

/// Mean square of the error of luminance over the square of its mean: of one tile.
double relative_square_error(const Image& image, const Image& reference)
{
    double error = 0.0;
    double mean = 0.0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const double d = luminance_of(image.pixels[i]) - luminance_of(reference.pixels[i]);
        error += d * d;
        mean += luminance_of(reference.pixels[i]);
    }
    const auto pixels = static_cast<double>(image.pixels.size());
    return error / pixels / (mean * mean / pixels / pixels);
}

TEST_CASE("noise is the true error, as references have it", "[noise][long]")
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), plastic(Rgb(0.6f), 0.4f));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    builder.sphere({0.3f, -0.6f, 0.2f}, 0.4f, lambertian(Rgb(0.5f)), 16);
    const Scene scene(std::move(builder.desc));
    constexpr int seeds = 24;
    for (const auto kind : {IntegratorKind::mis, IntegratorKind::bdpt, IntegratorKind::lt}) {
        RenderOptions o = options(kind, 1000);
        o.film.width = 16;  // one tile
        o.film.height = 16;
        o.sampling.samples.end = 2048;
        const Image reference = render(scene, room_camera(), o).film.develop();
        double estimated = 0.0;
        double measured = 0.0;
        o.sampling.samples.end = 32;
        for (int seed = 0; seed < seeds; ++seed) {
            o.sampling.seed = static_cast<std::uint64_t>(seed);
            const Film film = render(scene, room_camera(), o).film;
            estimated += estimate_noise(film) * estimate_noise(film);
            measured += relative_square_error(film.develop(), reference);
        }
        CAPTURE(static_cast<int>(kind), std::sqrt(measured / seeds), std::sqrt(estimated / seeds));
        CHECK(std::sqrt(estimated / measured) == Approx(1.0).margin(0.1));
    }
}

/// Ends a render at that noise.
RenderControl until(double noise)
{
    RenderControl control;
    control.noise_goal = noise;
    return control;
}

TEST_CASE("a render stops at a level of noise, whatever the threads and passes", "[noise]")
{
    const Scene scene = room();
    RenderOptions o = options(IntegratorKind::bdpt, 7);
    o.sampling.samples.end = 5000;
    const double goal = 0.13;
    std::optional<RenderResult> first;
    for (const int threads : {1, 3}) {
        o.system.threads = threads;
        o.system.tile_size = 5 + threads;
        std::optional<double> last;
        RenderControl control = until(goal);
        control.on_progress = [&](const Progress& progress) { last = progress.noise; };
        RenderResult result = render(scene, room_camera(), o, control);
        CHECK(is_noise_look(result.film.sample_count()));
        CHECK(estimate_noise(result.film) <= goal);
        CHECK(last == estimate_noise(result.film));
        if (first) {
            CHECK(result.film == first->film);
        }
        first = std::move(result);
    }
    const std::int64_t count = first->film.sample_count();
    CHECK(count > 16);
    // Not a look too late.
    for (std::int64_t n = next_noise_look(0); n < count; n = next_noise_look(n)) {
        o.sampling.samples.end = n;
        CHECK(estimate_noise(render(scene, room_camera(), o).film) > goal);
    }
}

TEST_CASE("a render that stops and goes on stops at the same level of noise", "[noise][long]")
{
    const Scene scene = room();
    RenderOptions o = options(IntegratorKind::bdpt, 7);
    o.sampling.samples.end = 5000;
    const double goal = 0.13;
    const RenderResult whole = render(scene, room_camera(), o, until(goal));
    std::mt19937 engine(11);
    for (int trial = 0; trial < 3; ++trial) {
        RenderResult part;
        for (std::int64_t before = -1; before != part.samples.count();) {
            before = part.samples.count();
            std::stop_source stop;
            RenderControl control = until(goal);
            control.stop = stop.get_token();
            control.on_progress = [&](const Progress&) {
                if (engine() % 3 == 0) {
                    stop.request_stop();
                }
            };
            part = continue_render(scene, room_camera(), o, std::move(part), control);
        }
        CHECK(part.film == whole.film);
    }
    // More samples than it takes, from a render that did not look, stay as they are.
    o.sampling.samples.end = 2 * whole.film.sample_count();
    RenderResult more = render(scene, room_camera(), o);
    const RenderResult kept =
        continue_render(scene, room_camera(), o, std::move(more), until(goal));
    CHECK(kept.samples.count() == o.sampling.samples.end);
    CHECK_THROWS_AS(render(scene, room_camera(), o, until(-1.0)), Error);
    CHECK_THROWS_AS(render(scene, room_camera(), o, until(std::nan(""))), Error);
}

}  // namespace
}  // namespace bdpt::test::noise_test
