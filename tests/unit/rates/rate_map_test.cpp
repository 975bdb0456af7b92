#include "rates/rate_map.h"

#include "catch.hpp"

#include <bdpt/error.h>
#include <bdpt/film/film.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace bdpt::test::rate_map_test {
namespace {

RateEvidence evidence(int width, int height, double variance = 1.0)
{
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return {.width = width,
            .height = height,
            .variance = std::vector<double>(pixels, variance),
            .brightness = std::vector<double>(pixels, 1.0),
            .cost = std::vector<double>(pixels, 1.0)};
}

/// Columns from `from` on have `factor` times as much.
void raise(const RateEvidence& size, std::vector<double>& plane, int from, double factor)
{
    for (std::size_t i = 0; i < plane.size(); ++i) {
        if (static_cast<int>(i) % size.width >= from) {
            plane[i] *= factor;
        }
    }
}

void check_mean(const SampleRates& rates)
{
    CHECK(rates.mean() <= 1.0);
    CHECK(rates.mean() > 0.99);
}

}  // namespace

TEST_CASE("samples go where variance is", "[rates]")
{
    RateEvidence found = evidence(80, 64);
    raise(found, found.variance, 40, 16.0);
    const SampleRates rates = rates_for(found);
    check_mean(rates);
    // As the root of variances, each with a quarter of the mean: that of 18.1 / 3.1.
    CHECK(rates.rate(70, 30) == 2.0f * rates.rate(10, 30));
    CHECK(rates.greatest() <= 2.0f);
}

TEST_CASE("variance counts relative to the brightness around", "[rates]")
{
    RateEvidence found = evidence(80, 64);
    raise(found, found.variance, 40, 16.0);
    raise(found, found.brightness, 40, 4.0);
    const SampleRates rates = rates_for(found);
    CHECK(rates.rate(70, 30) == 1.0f);
    CHECK(rates.rate(10, 30) == 1.0f);
    // What is nearly black need not be clean.
    found = evidence(80, 64);
    raise(found, found.variance, 40, 1e-8);
    raise(found, found.brightness, 40, 1e-5);
    CHECK(rates_for(found).rate(70, 30) < 1.0f);
}

TEST_CASE("samples that cost more are taken less often", "[rates]")
{
    RateEvidence found = evidence(80, 64);
    raise(found, found.cost, 40, 16.0);
    const SampleRates rates = rates_for(found);
    CHECK(4.0f * rates.rate(70, 30) == rates.rate(10, 30));
}

TEST_CASE("one bright sample raises the rates around it, and no others", "[rates]")
{
    RateEvidence found = evidence(64, 64);
    found.variance[64 * 32 + 32] = 1e6;
    const SampleRates rates = rates_for(found);
    CHECK(rates.rate(32, 32) == 4.0f);
    CHECK(rates.rate(36, 28) == 4.0f);
    CHECK(rates.rate(37, 32) <= 1.0f);
    CHECK(rates.rate(5, 5) <= 1.0f);
    check_mean(rates);
}

TEST_CASE("rates have the mean 1, whatever was found", "[rates]")
{
    // Nothing to choose.
    for (const double variance : {0.0, 1e-30, 1.0, 1e40}) {
        CHECK(rates_for(evidence(7, 5, variance)).mean() == 1.0);
    }
    CHECK(rates_for(evidence(1, 1)).rate(0, 0) == 1.0f);
    RateEvidence black = evidence(9, 9, 0.0);
    std::fill(black.brightness.begin(), black.brightness.end(), 0.0);
    CHECK(rates_for(black).mean() == 1.0);
    // Most is background without noise, which cannot have less than a quarter.
    RateEvidence background = evidence(200, 100);
    raise(background, background.variance, 20, 0.0);
    const SampleRates few = rates_for(background);
    check_mean(few);
    CHECK(few.rate(3, 50) == 4.0f);
    CHECK(few.least() < 1.0f);
    // All rates differ.
    RateEvidence slope = evidence(128, 128);
    for (std::size_t i = 0; i < slope.variance.size(); ++i) {
        slope.variance[i] = 1e-3 * static_cast<double>(i * i);
    }
    const SampleRates many = rates_for(slope);
    check_mean(many);
    CHECK(many.least() == 0.5f);
}

TEST_CASE("rates are powers of two for each pixel", "[rates]")
{
    const SampleRates rates(3, 2, {-2, -1, 0, 1, 2, 0});
    CHECK(rates.rate(0, 0) == 0.25f);
    CHECK(rates.rate(1, 0) == 0.5f);
    CHECK(rates.rate(2, 0) == 1.0f);
    CHECK(rates.rate(0, 1) == 2.0f);
    CHECK(rates.rate(1, 1) == 4.0f);
    CHECK(rates.mean() == 8.75 / 6.0);
    CHECK_THROWS_AS(SampleRates(3, 2, {0, 0, 0}), Error);
    CHECK_THROWS_AS(SampleRates(0, 0, {}), Error);
    CHECK_THROWS_AS(SampleRates(-1, -1, {0}), Error);
    CHECK_THROWS_AS(SampleRates(1, 1, {3}), Error);
    CHECK_THROWS_AS(SampleRates(1, 1, {-3}), Error);
}

TEST_CASE("a film clamps what a sample brings, whatever it counts", "[rates]")
{
    Film film(FilmLayout{
        .width = 2, .height = 1, .region = {.x0 = 0, .y0 = 0, .x1 = 2, .y1 = 1}, .clamp = 2.0f});
    film.add_sample(0, 0, 0, Rgb(8.0f), 4.0f);
    film.add_sample(1, 0, 0, Rgb(8.0f), 0.25f);
    film.add_splat({1.5f, 0.5f}, 0, Rgb(8.0f), 0.5f);
    film.count_samples(0, 1);
    const Image image = film.develop();
    CHECK(image.pixels[0] == Rgb(8.0f));
    CHECK(image.pixels[1] == Rgb(1.5f));
    CHECK(film.develop_camera().pixels[1] == Rgb(0.5f));
    CHECK(film.clamp_loss().contributions == 3);
    CHECK(film.clamp_loss().radiance == Rgb((24.0f + 1.5f + 3.0f) / 2.0f));
}

}  // namespace bdpt::test::rate_map_test
