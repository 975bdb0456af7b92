#include <bdpt/error.h>
#include <bdpt/film/exact_sum.h>
#include <bdpt/film/film.h>

#include "catch.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <thread>

namespace bdpt::film_test {
namespace {

FilmLayout layout(int width, int height, SplatImage splats = SplatImage::present)
{
    return {.width = width,
            .height = height,
            .region = {.x0 = 0, .y0 = 0, .x1 = width, .y1 = height},
            .splats = splats};
}

}  // namespace

TEST_CASE("Film averages samples and adds splats over the number of light paths", "[film]")
{
    Film film(layout(2, 1));
    film.add_sample(0, 0, 0, Rgb(1.0f, 2.0f, 3.0f));
    film.add_sample(0, 0, 1, Rgb(3.0f, 2.0f, 1.0f));
    film.add_splat({1.5f, 0.5f}, 0, Rgb(8.0f));
    film.add_splat({2.0f, 0.5f}, 0, Rgb(100.0f));  // just outside
    film.add_splat({-0.1f, 0.5f}, 0, Rgb(100.0f));
    film.count_samples(0, 2);
    const Image image = film.develop();
    CHECK(image.at(0, 0) == Rgb(2.0f));
    CHECK(image.at(1, 0) == Rgb(4.0f));
    CHECK(film.develop_half(0).at(0, 0) == Rgb(1.0f, 2.0f, 3.0f));
    CHECK(film.develop_half(1).at(0, 0) == Rgb(3.0f, 2.0f, 1.0f));
    CHECK(film.develop_half(0).at(1, 0) == Rgb(8.0f));
}

TEST_CASE("Film drops and counts NaN, infinite and negative values, and names the first", "[film]")
{
    Film film(layout(4, 4));
    film.add_sample(2, 1, 9, Rgb(std::numeric_limits<float>::quiet_NaN(), 0.0f, 0.0f));
    film.add_sample(3, 2, 5, Rgb(0.0f, -1.0f, 0.0f));
    film.add_splat({1.0f, 3.0f}, 7, Rgb(std::numeric_limits<float>::infinity()));
    film.add_sample(0, 0, 1, Rgb(1e30f));
    film.count_samples(0, 10);
    const FilmDefects defects = film.defects();
    CHECK(defects.invalid == 3);
    CHECK(defects.saturated == 1);
    REQUIRE(defects.first_invalid.has_value());
    CHECK(*defects.first_invalid == FilmDefects::Place{.x = 3, .y = 2, .sample_index = 5});
    CHECK(film.develop().at(2, 1) == Rgb(0.0f));
    CHECK(film.develop().at(0, 0).r == Approx(ExactSum::max_value / 10.0f));
}

TEST_CASE("Film::merge adds samples, counts and defects; sizes must match", "[film]")
{
    Film a(layout(1, 1, SplatImage::absent));
    Film b(layout(1, 1, SplatImage::absent));
    a.add_sample(0, 0, 0, Rgb(1.0f));
    b.add_sample(0, 0, 1, Rgb(3.0f));
    a.count_samples(0, 1);
    b.count_samples(1, 2);
    a.merge(b);
    CHECK(a.sample_count() == 2);
    CHECK(a.develop().at(0, 0) == Rgb(2.0f));
    CHECK_THROWS_AS(a.merge(Film(layout(2, 1, SplatImage::absent))), Error);
    CHECK_THROWS_AS(a.merge(Film(layout(1, 1))), Error);
}

TEST_CASE("Film rounds once, so that images do not tell how its sums were split", "[film]")
{
    // Just above the middle of two floats, but only if the two last digits are added first: one by
    // one they are lost to a double that holds the rest.
    Film split(layout(1, 1));
    Film whole(layout(1, 1));
    const float digit = 0x1p-13f;
    for (const float value : {0x1p40f, 0x1p16f}) {
        whole.add_sample(0, 0, 0, Rgb(value));
        split.add_sample(0, 0, 0, Rgb(value));
    }
    whole.add_sample(0, 0, 0, Rgb(digit));
    whole.add_sample(0, 0, 0, Rgb(digit));
    split.add_splat({0.5f, 0.5f}, 0, Rgb(digit));
    split.add_sample(0, 0, 1, Rgb(digit));
    whole.count_samples(0, 2);
    split.count_samples(0, 2);
    CHECK(whole.develop().at(0, 0).r == 0x1.000002p39f);
    CHECK(split.develop().at(0, 0) == whole.develop().at(0, 0));

    // And what comes back from rows has camera samples and splats in one.
    Film copy(layout(1, 1));
    for (std::size_t plane = 0; plane < Film::plane_names().size(); ++plane) {
        ExactSum::Words words;
        split.read_row(plane, 0, {&words, 1});
        copy.add_row(plane, 0, {&words, 1});
    }
    copy.count_samples(0, 2);
    CHECK(copy.develop_half(0).at(0, 0) == split.develop_half(0).at(0, 0));
    CHECK(copy.develop_half(1).at(0, 0) == split.develop_half(1).at(0, 0));
    CHECK(copy.develop().at(0, 0) == split.develop().at(0, 0));
}

TEST_CASE("ExactSum adds alone what it adds among threads", "[film]")
{
    std::mt19937 engine(3);
    std::uniform_real_distribution<float> exponent(-70.0f, 42.0f);
    std::bernoulli_distribution negative(0.3);
    ExactSum among;
    ExactSum alone;
    for (int i = 0; i < 100000; ++i) {
        const float value = std::exp2(exponent(engine)) * (negative(engine) ? -1.0f : 1.0f);
        among.add(value);
        alone.add_alone(value);
        REQUIRE(among == alone);
    }
}

TEST_CASE("a pixel takes splats while another thread adds its samples", "[film]")
{
    constexpr int count = 300'000;
    const SplatImage splats = GENERATE(SplatImage::present, SplatImage::apart);
    Film film(layout(1, 1, splats));
    std::thread splatting([&] {
        for (int i = 0; i < count; ++i) {
            film.add_splat({0.5f, 0.5f}, 0, Rgb(0x1p10f));
        }
    });
    for (int i = 0; i < count; ++i) {
        film.add_sample(0, 0, 0, Rgb(3.0f));
    }
    splatting.join();
    film.count_samples(0, 1);
    CHECK(film.develop().at(0, 0) == Rgb(count * 1027.0f));
}

TEST_CASE("a film without splats drops them", "[film]")
{
    Film film(layout(1, 1, SplatImage::absent));
    film.add_sample(0, 0, 0, Rgb(3.0f));
    film.add_splat({0.5f, 0.5f}, 0, Rgb(4.0f));
    film.count_samples(0, 1);
    CHECK(film.develop().at(0, 0) == Rgb(3.0f));
}

TEST_CASE("Film estimates the variance of its estimate from the halves", "[film]")
{
    // Samples with variance v: the estimates from n of them vary by v / n, on average.
    std::mt19937 engine(5);
    std::exponential_distribution<float> sample(0.5f);  // mean 2, variance 4
    constexpr int pixels = 40000;
    for (const int count : {2, 3, 16}) {
        Film film(layout(pixels, 1));
        for (int x = 0; x < pixels; ++x) {
            for (int i = 0; i < count; ++i) {
                // Half of the light comes by splats.
                film.add_sample(x, 0, i, Rgb(sample(engine)));
                film.add_splat({static_cast<float>(x) + 0.5f, 0.5f}, i, Rgb(sample(engine)));
            }
        }
        film.count_samples(0, count);
        const Image variance = film.variance();
        double mean = 0.0;
        for (const Rgb& v : variance.pixels) {
            mean += static_cast<double>(v.g) / pixels;
        }
        CHECK(mean == Approx(8.0 / count).epsilon(0.06));
    }
    Film half(layout(1, 1));
    half.add_sample(0, 0, 0, Rgb(1.0f));
    half.count_samples(0, 1);
    CHECK(half.variance().at(0, 0) == Rgb(std::numeric_limits<float>::infinity()));
}

TEST_CASE("Film clamps contributions by scale and tells what it took", "[film]")
{
    FilmLayout clamped = layout(2, 2);
    clamped.clamp = 4.0f;
    Film film(clamped);
    film.add_sample(0, 0, 0, Rgb(4.0f, 1.0f, 0.0f));  // just within
    film.add_sample(0, 1, 0, Rgb(2.0f, 8.0f, 6.0f));
    film.add_splat({1.5f, 0.5f}, 1, Rgb(16.0f, 0.0f, 4.0f));
    film.add_splat({1.5f, 0.5f}, 0, Rgb(1.0f));
    film.count_samples(0, 2);
    const Image image = film.develop();
    CHECK(image.at(0, 0) == Rgb(2.0f, 0.5f, 0.0f));
    CHECK(image.at(0, 1) == Rgb(0.5f, 2.0f, 1.5f));
    CHECK(image.at(1, 0) == Rgb(2.5f, 0.5f, 1.0f));
    CHECK(film.clamp_loss().contributions == 2);
    // (1 + 12, 4, 3 + 3) over two samples of four pixels.
    CHECK(film.clamp_loss().radiance == Rgb(13.0f, 4.0f, 6.0f) / 8.0f);

    // The image and the loss together are what there is without a clamp.
    Film other(clamped);
    other.add_splat({0.5f, 1.5f}, 2, Rgb(12.0f));
    other.count_samples(2, 4);
    film.merge(other);
    CHECK(film.clamp_loss().contributions == 3);
    CHECK(film.clamp_loss().radiance == Rgb(13.0f + 8.0f, 4.0f + 8.0f, 6.0f + 8.0f) / 16.0f);
    CHECK_THROWS_AS(film.merge(Film(layout(2, 2))), Error);
    CHECK(Film(layout(2, 2)).clamp_loss().contributions == 0);
}

TEST_CASE("Film counts the samples of both halves for any range", "[film]")
{
    for (const auto& [begin, end] : {std::pair{0, 5}, {5, 16}, {3, 4}, {4, 5}}) {
        Film film(layout(1, 1, SplatImage::absent));
        for (int i = begin; i < end; ++i) {
            film.add_sample(0, 0, i, Rgb(1.0f));
        }
        film.count_samples(begin, end);
        CHECK(film.sample_count() == end - begin);
        CHECK(film.develop().at(0, 0) == Rgb(1.0f));
    }
}

TEST_CASE("Film holds a region of the image and uses the image's positions", "[film]")
{
    const FilmLayout crop{.width = 8, .height = 6, .region = {.x0 = 3, .y0 = 2, .x1 = 5, .y1 = 5}};
    Film film(crop);
    CHECK(film.width() == 2);
    CHECK(film.height() == 3);
    film.add_sample(3, 2, 0, Rgb(1.0f));
    film.add_splat({4.5f, 4.99f}, 0, Rgb(2.0f));
    film.add_splat({2.99f, 3.0f}, 0, Rgb(100.0f));
    film.add_splat({5.0f, 3.0f}, 0, Rgb(100.0f));
    film.add_splat({3.0f, 1.99f}, 0, Rgb(100.0f));
    film.add_splat({3.0f, 5.0f}, 0, Rgb(100.0f));
    film.add_sample(4, 3, 0, Rgb(-1.0f));
    film.count_samples(0, 1);
    const Image image = film.develop();
    CHECK(image.at(0, 0) == Rgb(1.0f));
    CHECK(image.at(1, 2) == Rgb(2.0f));
    CHECK(image.at(1, 0) + image.at(0, 1) + image.at(1, 1) + image.at(0, 2) == Rgb(0.0f));
    CHECK(film.defects().first_invalid == FilmDefects::Place{.x = 4, .y = 3, .sample_index = 0});
    CHECK_THROWS_AS(film.merge(Film(layout(8, 6))), Error);
    CHECK_THROWS_AS(Film(layout(2, 3)).merge(film), Error);
}

}  // namespace bdpt::film_test
