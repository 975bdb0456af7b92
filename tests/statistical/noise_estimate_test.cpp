// The noise that a render tells is the noise that it has, by its variance over seeds.

#include <bdpt/noise.h>
#include <bdpt/render.h>

#include "catch.hpp"
#include "equality_cases.h"
#include "scene_builder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace bdpt::test::noise_estimate_test {
namespace {

constexpr int width = 48;
constexpr int height = 32;
constexpr int side = 16;  // of the tiles of `estimate_noise`
constexpr std::int64_t samples = 16;

double luminance_of(Rgb value)
{
    return 0.2126 * static_cast<double>(value.r) + 0.7152 * static_cast<double>(value.g) +
           0.0722 * static_cast<double>(value.b);
}

/// Sums of the luminance of a pixel over renders.
struct PixelSums {
    double values = 0.0;
    double squares = 0.0;
};

/// The definition of `estimate_noise` with the variance between renders: with so few tiles, the
/// largest.
double true_noise(const std::vector<PixelSums>& pixels, int renders)
{
    double mean = 0.0;
    for (const PixelSums& pixel : pixels) {
        mean += pixel.values / renders / static_cast<double>(pixels.size());
    }
    double most = 0.0;
    for (int top = 0; top < height; top += side) {
        for (int left = 0; left < width; left += side) {
            double variance = 0.0;
            double brightness = 0.0;
            for (int i = 0; i < side * side; ++i) {
                const PixelSums& pixel =
                    pixels[static_cast<std::size_t>((top + i / side) * width + left + i % side)];
                const double of_pixel = pixel.values / renders;
                variance +=
                    (pixel.squares / renders - of_pixel * of_pixel) * renders / (renders - 1);
                brightness += of_pixel;
            }
            most = std::max(most, std::sqrt(variance / (side * side)) /
                                      std::max(brightness / (side * side), 0.01 * mean));
        }
    }
    return most;
}

/// Root mean square of the noise that renders tell, over what they have.
double told_over_true(const EqualityCase& test, std::int64_t planned_samples)
{
    constexpr int renders = 200;
    const Scene scene(test.scene);
    RenderOptions options{.integrator = IntegratorKind::mis,
                          .film = {.width = width, .height = height},
                          .sampling = {.samples = {0, samples}},
                          .transport = {.max_depth = test.max_depth}};
    options.sampling.planned_samples = planned_samples;
    std::vector<PixelSums> pixels(std::size_t{width} * height);
    double told = 0.0;
    for (int render_number = 0; render_number < renders; ++render_number) {
        options.sampling.seed = static_cast<std::uint64_t>(render_number);
        const RenderResult result = render(scene, test.camera, options);
        const double noise = estimate_noise(result.film);
        told += noise * noise / renders;
        const Image image = result.image();
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const double value = luminance_of(image.pixels[i]);
            pixels[i].values += value;
            pixels[i].squares += value * value;
        }
    }
    return std::sqrt(told) / true_noise(pixels, renders);
}

}  // namespace

TEST_CASE("the noise that renders tell is what they have", "[noise][long]")
{
    std::vector<EqualityCase> cases = equality_cases();
    constexpr std::size_t count = 12;
    REQUIRE(cases.size() >= count);
    for (std::size_t i = 0; i < count; ++i) {
        const EqualityCase& test = cases[i * cases.size() / count];
        CAPTURE(test.name);
        for (const std::int64_t planned : {samples, std::int64_t{0}}) {
            const double ratio = told_over_true(test, planned);
            CAPTURE(planned, ratio);
            CHECK(ratio > 0.8);
            CHECK(ratio < 1.6);
        }
    }
}

}  // namespace bdpt::test::noise_estimate_test
