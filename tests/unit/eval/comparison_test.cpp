#include <bdpt/error.h>
#include <bdpt/eval/comparison.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "catch.hpp"
#include "test_images.h"

namespace bdpt::eval::comparison_test {
namespace {

using test::flat;
using test::random_image;
using test::row_of;

ComparisonOptions quick(Metric metric = Metric::mse)
{
    return {.metrics = {metric}, .scale = {}, .map_metric = metric};
}

TEST_CASE("several images give mean, spread and extremes of each metric")
{
    Comparison comparison("r", flat(2, 1, Rgb(1.0f)), quick(Metric::rmse));
    for (const float value : {2.0f, 3.0f, 7.0f}) {
        comparison.add("s", flat(2, 1, Rgb(value)));
    }
    // RMSE 1, 2 and 6: mean 3, squares about it 4 + 1 + 9.
    const ComparisonReport report = comparison.report();
    REQUIRE(report.metrics.size() == 1);
    CHECK(report.metrics[0].mean == Approx(3.0));
    CHECK(report.metrics[0].deviation.value() == Approx(std::sqrt(14.0 / 2)));
    CHECK(report.metrics[0].least == Approx(1.0));
    CHECK(report.metrics[0].greatest == Approx(6.0));
    // The map has the root of the mean square: (1 + 4 + 36) / 3.
    CHECK(report.map.at(0, 0) == Approx(std::sqrt(41.0 / 3)));
    CHECK(report.images[2].values[0] == Approx(6.0));
}

TEST_CASE("the bias of seeds has the error that their spread says")
{
    Comparison comparison("r", row_of({Rgb(1, 0, 0), Rgb(3, 0, 0)}), quick());
    comparison.add("a", row_of({Rgb(2, 1, 0), Rgb(4, 0, 0)}));  // red +1, +1; green +1, 0
    comparison.add("b", row_of({Rgb(4, 1, 0), Rgb(4, 0, 0)}));  // red +3, +1; green +1, 0
    const ComparisonReport report = comparison.report();
    const Bias& bias = report.bias;
    CHECK(bias.source == BiasSource::seeds);
    // Red: means 1 and 2, so 1.5 with variance 0.5 and standard error sqrt(0.5 / 2).
    CHECK(bias.channels[0].value == Approx(1.5));
    CHECK(bias.channels[0].standard_error.value() == Approx(0.5));
    CHECK(bias.channels[1].value == Approx(0.5));
    CHECK(bias.channels[1].standard_error.value() == Approx(0.0));
    // The mean of the channels: 0.5 and 2.5 / 3.
    CHECK(bias.channels[3].value == Approx(2.0 / 3));
    CHECK(bias.channels[3].standard_error.value() == Approx(0.5 / 3));
    // Of six numbers a pixel's only the first red one varies: 1 and 3, variance of the mean 1.
    CHECK(bias.pixel_standard_error.value() == Approx(std::sqrt(1.0 / 6)));
    // One tile with three channels, of which red has variance 0.25.
    CHECK(bias.tile_standard_error.value() == Approx(std::sqrt(0.25 / 3)));
    // Green is wrong for sure. Red has t = 1.5 / 0.5 with one degree of freedom, so p is that of
    // Cauchy's distribution, twice by Holm since two of three tests are left. Blue is right.
    REQUIRE(report.biased_tiles.size() == 3);
    CHECK(report.biased_tiles[0].channel == 1);
    CHECK(report.biased_tiles[0].p == 0.0);
    CHECK(report.biased_tiles[1].channel == 0);
    CHECK(report.biased_tiles[1].t == Approx(3.0));
    CHECK(report.biased_tiles[1].p == Approx(2.0 * 2.0 / std::numbers::pi * std::atan(1.0 / 3.0)));
    CHECK(report.biased_tiles[2].p == 1.0);
}

TEST_CASE("one image's bias has the error that its blocks say")
{
    Image image = flat(16, 8, Rgb(1.0f));
    for (int y = 0; y < 8; ++y) {
        for (int x = 8; x < 16; ++x) {
            image.pixels[static_cast<std::size_t>(16 * y + x)] = Rgb(2.0f, 1.0f, 1.0f);
        }
    }
    Comparison comparison("r", flat(16, 8, Rgb(1.0f)), quick());
    comparison.add("a", image);
    const Bias bias = comparison.report().bias;
    CHECK(bias.source == BiasSource::blocks);
    CHECK(bias.channels[0].value == Approx(0.5));
    // Two blocks that are 0.5 below and above: their means have standard deviation sqrt(0.5).
    CHECK(bias.channels[0].standard_error.value() == Approx(0.5));
    CHECK(bias.channels[3].standard_error.value() == Approx(0.5 / 3));
    CHECK_FALSE(bias.pixel_standard_error);
    CHECK_FALSE(bias.tile_standard_error);
}

TEST_CASE("the worst tiles come first, with their place in the whole image")
{
    Image image = flat(5, 3, Rgb(0.0f));
    image.pixels[4] = Rgb(2.0f);   // (4, 0), in the tile of column 4
    image.pixels[10] = Rgb(3.0f);  // (0, 2), in the tile of row 2
    ComparisonOptions options = quick();
    options.tile_size = 2;
    options.worst_tiles = 3;
    options.x0 = 100;
    options.y0 = 50;
    Comparison comparison("r", flat(5, 3, Rgb(0.0f)), options);
    comparison.add("a", image);
    const ComparisonReport report = comparison.report();
    CHECK(report.region == PixelRect{100, 50, 105, 53});
    REQUIRE(report.worst_tiles.size() == 3);
    // 9 over two pixels, 4 over two.
    CHECK(report.worst_tiles[0].tile == PixelRect{100, 52, 102, 53});
    CHECK(report.worst_tiles[0].value == Approx(4.5));
    CHECK(report.worst_tiles[1].tile == PixelRect{104, 50, 105, 52});
    CHECK(report.worst_tiles[1].value == Approx(2.0));
    CHECK(report.worst_tiles[2].value == 0.0);
    CHECK(report.biased_tiles.empty());
}

/// Seeds with noise of standard deviation 0.29 a number; `bias` is in the green of one tile.
ComparisonReport noisy_seeds(float bias)
{
    ComparisonOptions options = quick();
    options.tile_size = 8;
    options.worst_tiles = 100;
    Comparison comparison("r", flat(32, 16, Rgb(0.5f)), options);
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Image image = random_image(32, 16, 1000 + seed);
        for (int y = 8; y < 16; ++y) {
            for (int x = 24; x < 32; ++x) {
                image.pixels[static_cast<std::size_t>(32 * y + x)].g += bias;
            }
        }
        comparison.add("seed", image);
    }
    return comparison.report();
}

TEST_CASE("a biased tile is found among noise, and noise is not called biased")
{
    const ComparisonReport sound = noisy_seeds(0.0f);
    REQUIRE(sound.biased_tiles.size() == 24);
    CHECK(sound.biased_tiles.front().p > 0.05);

    // 0.2 is sixteen standard errors of a tile: 0.29 / sqrt(64 pixels, 8 seeds).
    const ComparisonReport biased = noisy_seeds(0.2f);
    const TileBias& worst = biased.biased_tiles.front();
    CHECK(worst.tile == PixelRect{24, 8, 32, 16});
    CHECK(worst.channel == 1);
    CHECK(worst.p < 0.01);
    CHECK(worst.bias == Approx(0.2).margin(0.05));
    CHECK(worst.t == Approx(worst.bias / worst.standard_error));
    CHECK(biased.biased_tiles[1].p > 0.05);
    // The expected error of a tile's bias.
    CHECK(biased.bias.tile_standard_error.value() ==
          Approx(std::sqrt(1.0 / 12 / 512)).epsilon(0.2));
    CHECK(biased.bias.pixel_standard_error.value() ==
          Approx(std::sqrt(1.0 / 12 / 8)).epsilon(0.05));
}

TEST_CASE("images that cannot be compared are refused by name")
{
    const auto message = [](const Image& reference, const Image& image,
                            const ComparisonOptions& options) -> std::string {
        try {
            Comparison("right.exr", reference, options).add("left.exr", image);
        } catch (const Error& error) {
            return std::to_string(static_cast<int>(error.code())) + " " + error.what();
        }
        return "";
    };
    const Image sound = flat(3, 2, Rgb(1.0f));
    CHECK(message(sound, flat(2, 3, Rgb(1.0f)), quick()) ==
          "4 left.exr: has 2 x 3 pixels, but the reference right.exr has 3 x 2");
    Image nan = sound;
    nan.pixels[4].g = std::numeric_limits<float>::quiet_NaN();
    ComparisonOptions placed = quick();
    placed.x0 = 10;
    placed.y0 = 20;
    CHECK(message(sound, nan, placed) == "4 left.exr: pixel (11, 21) has nan in channel green");
    Image infinite = sound;
    infinite.pixels[2].b = -std::numeric_limits<float>::infinity();
    CHECK(message(infinite, sound, quick()) ==
          "4 right.exr: pixel (2, 0) has -inf in channel blue");
    CHECK(message({}, {}, quick()).starts_with("4 right.exr"));
    CHECK(message(sound, sound, quick(Metric::psnr)).starts_with("2 "));
    ComparisonOptions no_tiles = quick();
    no_tiles.tile_size = 0;
    CHECK(message(sound, sound, no_tiles).starts_with("2 "));
}

TEST_CASE("JSON has null for what is not a number")
{
    ComparisonOptions options;
    Comparison comparison("r", flat(8, 8, Rgb(1.0f)), options);
    comparison.add("a", flat(8, 8, Rgb(1.0f)));
    comparison.add("b", flat(8, 8, Rgb(1.0f)));
    const std::string text = comparison_json(comparison.report(), {}, "seeds", "r");
    CHECK(text.find("nan") == std::string::npos);
    CHECK(text.find("inf") == std::string::npos);
    CHECK(text.find("\"psnr\": {\n      \"mean\": null") != std::string::npos);
}

}  // namespace
}  // namespace bdpt::eval::comparison_test
