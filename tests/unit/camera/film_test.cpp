#include <bdpt/error.h>
#include <bdpt/film.h>

#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <thread>
#include <vector>

namespace bdpt {
namespace {

double exact_sum(const std::vector<float>& values)
{
    long double sum = 0.0L;
    for (const float v : values) {
        sum += static_cast<long double>(v);
    }
    return static_cast<double>(sum);
}

ExactSum sum_of(const std::vector<float>& values)
{
    ExactSum sum;
    for (const float v : values) {
        sum.add(v);
    }
    return sum;
}

FilmLayout layout(int width, int height, SplatImage splats = SplatImage::present)
{
    return {.width = width,
            .height = height,
            .region = {.x0 = 0, .y0 = 0, .x1 = width, .y1 = height},
            .splats = splats};
}

}  // namespace

TEST_CASE("ExactSum keeps 1e-5 of the sum from 1e-5 to fireflies of 1e12", "[film]")
{
    std::mt19937 engine(1);
    for (const float scale : {1e-5f, 1.0f, 1e4f, 1e9f}) {
        std::exponential_distribution<float> distribution(1.0f / scale);
        std::vector<float> values;
        for (int i = 0; i < 20000; ++i) {
            values.push_back(distribution(engine));
        }
        CHECK(sum_of(values).value() == Approx(exact_sum(values)).epsilon(1e-6));
        values.push_back(1e12f);
        CHECK(sum_of(values).value() == Approx(exact_sum(values)).epsilon(1e-6));
    }
}

TEST_CASE("ExactSum does not lose many tiny splats next to a firefly", "[film]")
{
    ExactSum sum;
    constexpr float tiny = 1e-9f;
    sum.add(1e12f);
    for (int i = 0; i < 1000; ++i) {
        sum.add(tiny);
    }
    ExactSum firefly;
    firefly.add(1e12f);
    ExactSum only_tiny;
    for (int i = 0; i < 1000; ++i) {
        only_tiny.add(tiny);
    }
    firefly.add(only_tiny);
    CHECK(sum == firefly);
    CHECK(only_tiny.value() == Approx(1000.0 * static_cast<double>(tiny)).epsilon(1e-5));
}

TEST_CASE("ExactSum holds 2^24 fireflies of 1e12", "[film]")
{
    ExactSum sum;
    sum.add(1e12f);
    const double one = sum.value();
    for (int i = 0; i < 24; ++i) {
        const ExactSum copy = sum;
        sum.add(copy);  // doubles it
    }
    CHECK(sum.value() == std::ldexp(one, 24));
}

TEST_CASE("ExactSum is the same for every order and any threads", "[film]")
{
    std::mt19937 engine(7);
    std::lognormal_distribution<float> distribution(0.0f, 6.0f);
    std::vector<float> values;
    for (int i = 0; i < 4000; ++i) {
        values.push_back(std::min(distribution(engine), ExactSum::max_value));
    }
    const ExactSum expected = sum_of(values);
    std::shuffle(values.begin(), values.end(), engine);
    CHECK(sum_of(values) == expected);

    ExactSum shared;
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t i = t; i < values.size(); i += 4) {
                shared.add(values[i]);
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    CHECK(shared == expected);
}

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

}  // namespace bdpt
