#include <bdpt/error.h>
#include <bdpt/eval/metric.h>

#include <cmath>
#include <limits>
#include <string>

#include "catch.hpp"
#include "test_images.h"

namespace bdpt::eval::metric_test {
namespace {

using test::flat;
using test::random_image;
using test::row_of;
using test::scaled;

// Two pixels. x - r is (0.5, 0, -1) and (0, 2, 0); |r| is (0.5, 1, 2) and (0, 2, 4).
const Image pixel_row = row_of({Rgb(1.0f, 1.0f, 1.0f), Rgb(0.0f, 4.0f, 4.0f)});
const Image reference = row_of({Rgb(0.5f, 1.0f, 2.0f), Rgb(0.0f, 2.0f, 4.0f)});

TEST_CASE("images that no metric can measure are refused")
{
    const auto message = [](Metric metric, const Image& image, const Image& truth) -> std::string {
        try {
            static_cast<void>(evaluate(metric, image, truth));
        } catch (const Error& error) {
            return std::to_string(static_cast<int>(error.code())) + " " + error.what();
        }
        return "";
    };
    Image broken = pixel_row;
    broken.pixels[1].b = std::numeric_limits<float>::quiet_NaN();
    for (const Metric metric : all_metrics) {
        CAPTURE(to_string(metric));
        CHECK(message(metric, {}, {}) == "4 the reference: has no pixels");
        CHECK(message(metric, row_of({Rgb(1.0f)}), reference) ==
              "4 the image: has 1 x 1 pixels, but the reference has 2 x 1");
        CHECK(message(metric, broken, reference) ==
              "4 the image: pixel (1, 0) has nan in channel blue");
        CHECK(message(metric, pixel_row, broken) ==
              "4 the reference: pixel (1, 0) has nan in channel blue");
    }
}

TEST_CASE("metrics of two pixels have the values worked out by hand")
{
    // Squares are 0.25, 0, 1, 0, 4, 0: their sum is 5.25.
    CHECK(evaluate(Metric::mse, pixel_row, reference) == Approx(5.25 / 6));
    CHECK(evaluate(Metric::rmse, pixel_row, reference) == Approx(std::sqrt(0.875)));
    // Over r^2 + 0.01 of 0.26, 4.01 and 4.01.
    CHECK(evaluate(Metric::relmse, pixel_row, reference) ==
          Approx((0.25 / 0.26 + 1.0 / 4.01 + 4.0 / 4.01) / 6));
    // Over |r| + 0.01 of 0.51, 2.01 and 2.01.
    CHECK(evaluate(Metric::mape, pixel_row, reference) ==
          Approx((0.5 / 0.51 + 1.0 / 2.01 + 2.0 / 2.01) / 6));
    // Over |x| + |r| + 0.01 of 1.51, 3.01 and 6.01.
    CHECK(evaluate(Metric::smape, pixel_row, reference) ==
          Approx((0.5 / 1.51 + 1.0 / 3.01 + 2.0 / 6.01) / 6));
    // The reference's greatest component is 4, so 10 log10(16 / 0.875) dB.
    CHECK(evaluate(Metric::psnr, pixel_row, reference) == Approx(12.62112).epsilon(1e-6));
    // With a peak of 1: 10 log10(1 / 0.875).
    CHECK(evaluate(Metric::psnr, pixel_row, reference, {.peak = 1.0}) ==
          Approx(0.5799195).epsilon(1e-6));
}

TEST_CASE("errors that neighbours share count at all scales, others at the finest alone")
{
    constexpr int side = 32;
    const Image truth{side, side, std::vector<Rgb>(side * side, Rgb(1.0f))};
    // Off by 0.5 in squares of `size` pixels a side, up and down in turn.
    const auto checkered = [&](int size) {
        Image image = truth;
        for (int i = 0; i < side * side; ++i) {
            const bool up = (i % side / size + i / side / size) % 2 == 0;
            image.pixels[static_cast<std::size_t>(i)] = Rgb(up ? 1.5f : 0.5f);
        }
        return image;
    };
    const double error = 0.25 / 1.01;
    CHECK(evaluate(Metric::relmse, checkered(1), truth) == Approx(error));
    CHECK(evaluate(Metric::relmse_scales, checkered(1), truth) == Approx(error / 5));
    CHECK(evaluate(Metric::relmse_scales, checkered(2), truth) == Approx(2 * error / 5));
    CHECK(evaluate(Metric::relmse_scales, checkered(8), truth) == Approx(4 * error / 5));
    CHECK(evaluate(Metric::relmse_scales, checkered(16), truth) == Approx(error));

    // Squares at the border are smaller: an image of one pixel is all of them.
    CHECK(evaluate(Metric::relmse_scales, row_of({Rgb(1.5f)}), row_of({Rgb(1.0f)})) ==
          Approx(error));
    // (1.5, 1.5, 0.5) has 1.5 and 0.5 at scale 2, and 3.5 / 3 from scale 4 on.
    const double coarse = 1.0 / 36 / 1.01;
    CHECK(evaluate(Metric::relmse_scales, row_of({Rgb(1.5f), Rgb(1.5f), Rgb(0.5f)}),
                   row_of({Rgb(1.0f), Rgb(1.0f), Rgb(1.0f)})) ==
          Approx((2 * error + 3 * coarse) / 5));
}

TEST_CASE("epsilon is absolute or relative to the mean of the reference")
{
    // The mean of 0.5, 1, 2, 0, 2, 4 is 9.5 / 6; for relmse it counts squared.
    const double m = 9.5 / 6;
    MetricOptions options{.epsilon = 0.1, .epsilon_unit = EpsilonUnit::reference_mean};
    const double e = 0.1 * m * m;
    CHECK(evaluate(Metric::relmse, pixel_row, reference, options) ==
          Approx((0.25 / (0.25 + e) + 1.0 / (4 + e) + 4.0 / (4 + e)) / 6));
    const double d = 0.1 * m;
    CHECK(evaluate(Metric::mape, pixel_row, reference, options) ==
          Approx((0.5 / (0.5 + d) + 1.0 / (2 + d) + 2.0 / (2 + d)) / 6));
    options.epsilon_unit = EpsilonUnit::absolute;
    CHECK(evaluate(Metric::smape, pixel_row, reference, options) ==
          Approx((0.5 / 1.6 + 1.0 / 3.1 + 2.0 / 6.1) / 6));
}

TEST_CASE("terms are those of each pixel, and their mean gives the metric")
{
    const MetricScale scale = make_scale(reference, {});
    const ErrorMap squares = error_terms(Metric::rmse, pixel_row, reference, scale);
    REQUIRE(squares.values.size() == 2);
    CHECK(squares.at(0, 0) == Approx(1.25 / 3));
    CHECK(squares.at(1, 0) == Approx(4.0 / 3));
    CHECK(from_mean(Metric::rmse, 0.25, scale) == 0.5);
    CHECK(from_mean(Metric::mse, 0.25, scale) == 0.25);
    CHECK(mean(squares) == Approx(0.875));
}

TEST_CASE("an image that equals its reference has no error")
{
    const Image image = random_image(9, 7, 1, 20.0f);
    for (const Metric metric : all_metrics) {
        CAPTURE(to_string(metric));
        const double value = evaluate(metric, image, image);
        CHECK((metric == Metric::psnr ? std::isinf(value) && value > 0.0 : value == 0.0));
    }
}

TEST_CASE("what is relative does not depend on the unit of light")
{
    const Image image = random_image(16, 16, 1);
    const Image truth = random_image(16, 16, 2);
    const MetricOptions options{.epsilon_unit = EpsilonUnit::reference_mean};
    for (const Metric metric : {Metric::relmse, Metric::relmse_scales, Metric::mape, Metric::smape,
                                Metric::psnr, Metric::flip, Metric::flip_ldr}) {
        CAPTURE(to_string(metric));
        CHECK(evaluate(metric, scaled(image, 4096.0f), scaled(truth, 4096.0f), options) ==
              Approx(evaluate(metric, image, truth, options)).epsilon(1e-5));
    }
    CHECK(evaluate(Metric::mse, scaled(image, 2.0f), scaled(truth, 2.0f)) ==
          Approx(4.0 * evaluate(Metric::mse, image, truth)));
    CHECK(evaluate(Metric::rmse, scaled(image, 2.0f), scaled(truth, 2.0f)) ==
          Approx(2.0 * evaluate(Metric::rmse, image, truth)));
}

TEST_CASE("metrics that divide by the reference alone tell which image is the reference")
{
    for (const Metric metric : {Metric::mse, Metric::rmse, Metric::smape, Metric::flip_ldr}) {
        CAPTURE(to_string(metric));
        const MetricOptions fixed{.peak = 1.0, .exposure = 0.0f};
        CHECK(evaluate(metric, pixel_row, reference, fixed) ==
              Approx(evaluate(metric, reference, pixel_row, fixed)));
    }
    for (const Metric metric : {Metric::relmse, Metric::mape}) {
        CAPTURE(to_string(metric));
        CHECK(std::abs(evaluate(metric, pixel_row, reference) -
                       evaluate(metric, reference, pixel_row)) > 0.01);
    }
}

TEST_CASE("metrics have names that are read back")
{
    for (const Metric metric : all_metrics) {
        REQUIRE(parse_metric(to_string(metric)) == metric);
    }
    CHECK_FALSE(parse_metric("RELMSE"));
    CHECK_FALSE(parse_metric(""));
    CHECK_FALSE(grows_with_error(Metric::psnr));
    CHECK(grows_with_error(Metric::flip));
}

TEST_CASE("numbers that no metric can use are refused")
{
    const auto code = [](const MetricOptions& options, const Image& image) {
        try {
            static_cast<void>(make_scale(image, options));
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::internal;
    };
    CHECK(code({.epsilon = 0.0}, reference) == ErrorCode::usage);
    CHECK(code({.epsilon = std::nan("")}, reference) == ErrorCode::usage);
    CHECK(code({.peak = -1.0}, reference) == ErrorCode::usage);
    CHECK(code({.pixels_per_degree = 0.5}, reference) == ErrorCode::usage);
    CHECK(code({.exposures = FlipExposures{.start = 1.0, .stop = 0.0, .count = 2}}, reference) ==
          ErrorCode::usage);
    CHECK(code({.epsilon_unit = EpsilonUnit::reference_mean}, flat(2, 2, Rgb(0.0f))) ==
          ErrorCode::invalid_input);
}

}  // namespace
}  // namespace bdpt::eval::metric_test
