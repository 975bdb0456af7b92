#include "rates/rate_map.h"

#include "catch.hpp"

#include <bdpt/error.h>
#include <bdpt/film/film.h>

#include <algorithm>
#include <cmath>
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

/// Returns the mean exponent of 16 x 16 pixels; those of rates between powers of two differ.
double octaves_around(const SampleRates& rates, int x, int y)
{
    constexpr int side = 16;
    double sum = 0.0;
    for (int i = 0; i < side * side; ++i) {
        sum += rates.exponent(x - side / 2 + i % side, y - side / 2 + i / side);
    }
    return sum / (side * side);
}

void check_mean(const SampleRates& rates)
{
    CHECK(rates.mean() <= 1.0);
    CHECK(rates.mean() > 0.99);
}

}  // namespace

TEST_CASE("rates are on average what is wanted, with a mean of 1", "[rates]")
{
    const PlaneSize size{.width = 128, .height = 96};
    // A slope of two octaves, of whose height nothing is known.
    const SampleRates rates = dithered_rates(size, [](int x, int /*y*/) { return 7.0 + x / 64.0; });
    check_mean(rates);
    CHECK(rates.mean() > 0.999);
    const double middle = octaves_around(rates, 64, 48);
    CHECK(octaves_around(rates, 32, 48) == Approx(middle - 0.5).margin(0.03));
    CHECK(octaves_around(rates, 96, 20) == Approx(middle + 0.5).margin(0.03));
    // Pixels of one column differ, and by one octave at most.
    for (int x = 0; x < 128; ++x) {
        int least = 9;
        int greatest = -9;
        for (int y = 0; y < 96; ++y) {
            least = std::min(least, rates.exponent(x, y));
            greatest = std::max(greatest, rates.exponent(x, y));
        }
        CHECK(greatest - least <= 1);
    }
}

TEST_CASE("rates stay in their range", "[rates]")
{
    const PlaneSize size{.width = 40, .height = 25};
    const auto halves = [](int x, int /*y*/) { return x < 20 ? 0.0 : 9.0; };
    const SampleRates wide = dithered_rates(size, halves);
    CHECK(wide.least() == 0.25f);
    CHECK(wide.greatest() <= 2.0f);
    check_mean(wide);
    const SampleRates narrow = dithered_rates(size, halves, {.min = -1, .max = 1});
    CHECK(narrow.least() == 0.5f);
    CHECK(narrow.greatest() == 2.0f);
    check_mean(narrow);
    // No rates of this range have a mean of 1.
    CHECK(dithered_rates(size, halves, {.min = -2, .max = -1}).mean() == 0.5);
}

TEST_CASE("equal wishes get a rate of 1", "[rates]")
{
    for (const double wish : {-30.0, 0.0, 0.3, 30.0, 1e9}) {
        const SampleRates rates =
            dithered_rates({.width = 33, .height = 9}, [wish](int, int) { return wish; });
        CHECK(rates.least() == 1.0f);
        CHECK(rates.greatest() == 1.0f);
    }
}

TEST_CASE("samples go where variance is", "[rates]")
{
    RateEvidence found = evidence(80, 64);
    raise(found, found.variance, 40, 16.0);
    const SampleRates rates = rates_for(found);
    check_mean(rates);
    // As the root of variances, each with a quarter of the mean: that of 18.1 / 3.1.
    CHECK(octaves_around(rates, 70, 30) - octaves_around(rates, 10, 30) ==
          Approx(0.5 * std::log2(18.125 / 3.125)).margin(0.03));
    CHECK(rates.greatest() <= 2.0f);
}

TEST_CASE("variance counts relative to the brightness around", "[rates]")
{
    RateEvidence found = evidence(80, 64);
    raise(found, found.variance, 40, 16.0);
    raise(found, found.brightness, 40, 4.0);
    const SampleRates rates = rates_for(found);
    CHECK(octaves_around(rates, 70, 30) == Approx(0.0).margin(0.03));
    CHECK(octaves_around(rates, 10, 30) == Approx(0.0).margin(0.03));
    // What is nearly black need not be clean.
    found = evidence(80, 64);
    raise(found, found.variance, 40, 1e-8);
    raise(found, found.brightness, 40, 1e-5);
    CHECK(octaves_around(rates_for(found), 70, 30) < -0.5);
}

TEST_CASE("samples that cost more are taken less often", "[rates]")
{
    RateEvidence found = evidence(80, 64);
    raise(found, found.cost, 40, 16.0);
    const SampleRates rates = rates_for(found);
    CHECK(octaves_around(rates, 70, 30) + 2.0 ==
          Approx(octaves_around(rates, 10, 30)).margin(0.03));
}

TEST_CASE("one bright sample raises the rates around it, and no others", "[rates]")
{
    RateEvidence found = evidence(64, 64);
    found.variance[64 * 32 + 32] = 1e6;
    const SampleRates rates = rates_for(found);
    CHECK(rates.rate(32, 32) == 4.0f);
    CHECK(rates.rate(36, 28) == 4.0f);
    CHECK(rates.rate(38, 32) <= 1.0f);
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
    CHECK(many.least() < 1.0f);
    CHECK(many.greatest() > 1.0f);
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
    Film film(FilmLayout{.width = 2,
                         .height = 1,
                         .region = {.x0 = 0, .y0 = 0, .x1 = 2, .y1 = 1},
                         .splats = SplatImage::apart,
                         .clamp = 2.0f});
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
