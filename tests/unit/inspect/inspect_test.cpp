#include <bdpt/error.h>
#include <bdpt/inspect.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace bdpt::inspect_test {
namespace {

using test::SceneBuilder;

constexpr int size = 16;

Scene room()
{
    SceneBuilder builder;
    builder.walls(test::plastic(Rgb(0.7f), 0.3f), test::lambertian(Rgb(0.6f)));
    builder.ceiling(test::lambertian(Rgb(0.7f))).lamp(0.9f, 0.5f, Rgb(5.0f));
    builder.sphere({0.5f, -0.6f, 0.2f}, 0.4f, test::glass(0.0f));
    return Scene(std::move(builder.desc));
}

/// A white floor under a sky of one colour.
Scene floor_under_sky()
{
    SceneBuilder builder;
    builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1},
                 test::lambertian(Rgb(0.8f, 0.4f, 0.2f)));
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(3)}}});
    return Scene(std::move(builder.desc));
}

RenderOptions options_of(IntegratorKind integrator)
{
    RenderOptions options;
    options.integrator = integrator;
    options.film.width = size;
    options.film.height = size;
    options.transport.max_depth = 5;
    return options;
}

/// The integral over all directions, by the mean of each row.
double integral(const Image& map)
{
    constexpr double pi = 3.14159265358979;
    double sum = 0.0;
    for (int y = 0; y < map.height; ++y) {
        const double height = std::cos(pi * y / map.height) - std::cos(pi * (y + 1) / map.height);
        for (int x = 0; x < map.width; ++x) {
            sum += static_cast<double>(map.at(x, y).g) * height * 2.0 * pi / map.width;
        }
    }
    return sum;
}

}  // namespace

TEST_CASE("an inspected sample is what the film gets", "[inspect]")
{
    const Scene scene = room();
    const auto kind = GENERATE(IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::mis,
                               IntegratorKind::bdpt, IntegratorKind::lt);
    RenderOptions options = options_of(kind);
    int lit = 0;
    for (int number = 0; number < 160; ++number) {  // few light paths meet their own pixel
        const int x = number % 16;
        const PixelSample which{.x = x, .y = 11, .index = number / 16};
        const InspectedSample sample = inspect_sample(scene, test::room_camera(), options, which);
        options.film.crop = PixelRect{.x0 = x, .y0 = 11, .x1 = x + 1, .y1 = 12};
        options.sampling.samples = {.begin = which.index, .end = which.index + 1};
        const Rgb pixel = render(scene, test::room_camera(), options).film.develop().pixels[0];
        CAPTURE(static_cast<int>(kind), x);
        CHECK(sample.value.g == Approx(pixel.g).epsilon(1e-5));
        lit += pixel.g > 0.0f ? 1 : 0;
        REQUIRE(sample.camera_path.size() >= 2);
        CHECK(sample.camera_path[0].kind == InspectedKind::lens);
        CHECK(std::abs(sample.raster.x - static_cast<float>(x) - 0.5f) <= 2.0f);
        CHECK(sample.light_path.empty() ==
              (kind != IntegratorKind::bdpt && kind != IntegratorKind::lt));
        for (const InspectedContribution& found : sample.contributions) {
            const float shares = std::accumulate(found.shares.begin(), found.shares.end(), 0.0f);
            CHECK((found.shares.empty() || shares == Approx(1.0f).epsilon(1e-4)));
            CHECK(found.strategy.t <= static_cast<int>(sample.camera_path.size()));
        }
    }
    CHECK(lit >= 1);
}

TEST_CASE("the inspected samples of a pixel are those of a render with rates", "[inspect]")
{
    const Scene scene = floor_under_sky();
    RenderOptions options = options_of(IntegratorKind::mis);
    options.sampling.samples = {.begin = 0, .end = 8};
    options.sampling.planned_samples = 8;
    std::vector<std::int8_t> exponents(size * size, 0);
    constexpr int row = 15;
    exponents[row * size + 3] = -1;
    exponents[row * size + 4] = 1;
    options.sampling.rates = std::make_shared<const SampleRates>(size, size, exponents);
    const Image image = render(scene, test::room_camera(), options).film.develop();
    for (const auto& [x, samples] : {std::pair(3, 4), {4, 16}, {5, 8}}) {
        float sum = 0.0f;
        for (int index = 0; index < samples; ++index) {
            sum += inspect_sample(scene, test::room_camera(), options,
                                  {.x = x, .y = row, .index = index})
                       .value.g;
        }
        CAPTURE(x);
        CHECK(sum > 0.0f);
        CHECK(sum / static_cast<float>(samples) == Approx(image.at(x, row).g).epsilon(1e-5));
    }
}

TEST_CASE("directions of a floor under a sky are those of the closed form", "[inspect]")
{
    const Scene scene = floor_under_sky();
    RenderOptions options = options_of(IntegratorKind::nee);
    const PixelSample which{.x = 8, .y = 15, .index = 0};
    const DirectionMaps maps =
        inspect_directions(scene, test::room_camera(), options, which, 1, 64);
    REQUIRE(maps.product.width == 64);
    REQUIRE(maps.product.height == 32);
    constexpr float exact_pi = 3.14159265f;
    CHECK(integral(maps.product) == Approx(3.0 * 0.4).epsilon(0.01));
    CHECK(integral(maps.bsdf_pdf) == Approx(1.0).epsilon(0.01));
    // The floor does not hide the sky below from a point on it.
    CHECK(integral(maps.light_pdf) == Approx(1.0).epsilon(0.01));
    CHECK(maps.incident.at(32, 4).g == Approx(3.0f));
    CHECK(maps.scattering.at(32, 28).g == 0.0f);
    CHECK(maps.light_pdf.at(32, 4).g == Approx(0.25f / exact_pi).epsilon(1e-3));
    CHECK(maps.bsdf_pdf.at(32, 1).g ==
          Approx(std::cos(1.5f * exact_pi / 32.0f) / exact_pi).epsilon(0.01));
}

TEST_CASE("light sampling of a lamp that nothing hides has a density of one in all", "[inspect]")
{
    SceneBuilder builder;
    builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, test::lambertian(Rgb(0.5f)));
    builder.lamp(0.9f, 0.5f, Rgb(5.0f));
    const Scene scene{std::move(builder.desc)};
    const PixelSample which{.x = 8, .y = 14, .index = 0};
    const DirectionMaps maps = inspect_directions(scene, test::room_camera(),
                                                  options_of(IntegratorKind::bdpt), which, 1, 512);
    CHECK(integral(maps.light_pdf) == Approx(1.0).epsilon(0.02));
    CHECK(integral(maps.incident) > 0.0);
}

TEST_CASE("what cannot be inspected is refused", "[inspect]")
{
    const Scene scene = room();
    const auto fails = [&](const RenderOptions& options, const PixelSample& which, int vertex,
                           int width, const std::string& what) {
        try {
            static_cast<void>(
                inspect_directions(scene, test::room_camera(), options, which, vertex, width));
            FAIL("nothing was thrown");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::usage);
            CHECK(std::string(error.what()).find(what) != std::string::npos);
        }
    };
    const RenderOptions options = options_of(IntegratorKind::mis);
    fails(options, {.x = size, .y = 0}, 1, 8, "pixel 16,0 is outside of the image of 16x16");
    fails(options, {.x = 0, .y = -1}, 1, 8, "pixel 0,-1");
    fails(options, {.x = 3, .y = 11}, 100, 8, "vertex 100");
    fails(options, {.x = 3, .y = 11}, 0, 8, "vertex 0");
    fails(options, {.x = 3, .y = 11}, 1, 7, "width");
    fails(options, {.x = 11, .y = 11}, 1, 8, "delta");
    CHECK_THROWS_AS(inspect_sample(scene, test::room_camera(), options_of(IntegratorKind::vcm), {}),
                    Error);
}

}  // namespace bdpt::inspect_test
