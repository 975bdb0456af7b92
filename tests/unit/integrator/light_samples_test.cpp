#include "math/random_numbers.h"

#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace bdpt::light_samples_test {
namespace {

/// A wide lamp over a floor, in which all light is direct.
Scene lamp_over_floor()
{
    test::SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.0f)), test::lambertian(Rgb(0.6f)));
    builder.ceiling(test::lambertian(Rgb(0.0f))).lamp(0.9f, 0.7f, Rgb(5.0f));
    return Scene(std::move(builder.desc));
}

RenderOptions direct_light(IntegratorKind integrator, int light_samples)
{
    RenderOptions options;
    options.integrator = integrator;
    options.film = {.width = 16, .height = 16};
    options.sampling.samples.end = 4;
    options.sampling.light_samples = light_samples;
    options.transport.max_depth = 2;
    return options;
}

RenderResult rendered(IntegratorKind integrator, int light_samples)
{
    return render(lamp_over_floor(), test::room_camera(), direct_light(integrator, light_samples));
}

/// Mean square of what two images with other numbers differ by.
double difference(const Image& a, const Image& b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double d = static_cast<double>(a.pixels[i].g) - static_cast<double>(b.pixels[i].g);
        sum += d * d;
    }
    return sum / static_cast<double>(a.pixels.size());
}

}  // namespace

TEST_CASE("shifted points are as many in each part of the unit square", "[sampler]")
{
    const Vec2 u = GENERATE(Vec2(0.0f), Vec2(0.3f, 0.9f), Vec2(0x1.fffffep-1f));
    constexpr std::uint32_t count = 16;
    std::vector<int> columns(count);
    std::vector<int> rows(count);
    CHECK(shifted_point(u, 0, count) == u);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec2 point = shifted_point(u, i, count);
        REQUIRE(std::min(point.x, point.y) >= 0.0f);
        REQUIRE(std::max(point.x, point.y) < 1.0f);
        // Cells that begin where the point 0 is in its own.
        const Vec2 moved = 16.0f * Vec2(point - u + Vec2(1.0f));
        ++columns[static_cast<std::size_t>(moved.x + 0.5f) % count];
        ++rows[static_cast<std::size_t>(moved.y + 0.5f) % count];
    }
    CHECK(std::count(columns.begin(), columns.end(), 1) == count);
    CHECK(std::count(rows.begin(), rows.end(), 1) == count);
}

TEST_CASE("several light samples take as many shadow rays, and have less noise", "[integrator]")
{
    const auto kind = GENERATE(IntegratorKind::nee, IntegratorKind::mis, IntegratorKind::bdpt);
    const RenderResult reference = rendered(kind, 256);
    const RenderResult one = rendered(kind, 1);
    const RenderResult sixteen = rendered(kind, 16);
    CHECK(one.stats.rays.camera == sixteen.stats.rays.camera);
    if (kind != IntegratorKind::bdpt) {
        CHECK(sixteen.stats.rays.shadow > 12 * one.stats.rays.shadow);
        CHECK(sixteen.stats.rays.shadow < 20 * one.stats.rays.shadow);
    }
    const Image truth = reference.film.develop();
    const double noise = difference(one.film.develop(), truth);
    // The edges of what is lit keep their noise, and directions of the BSDF.
    CHECK(difference(sixteen.film.develop(), truth) < 0.5 * noise);
}

TEST_CASE("the light samples of bdpt at a camera vertex are points apart", "[integrator]")
{
    constexpr int light_samples = 16;
    RenderOptions options = direct_light(IntegratorKind::bdpt, light_samples);
    options.sampling.samples.end = 1;
    options.system.threads = 1;
    std::map<std::pair<float, float>, std::vector<float>> found;  // by pixel
    RenderControl control;
    control.on_path = [&](const PathContribution& path) {
        if (path.strategy == Strategy{.s = 1, .t = 2}) {
            found[{path.raster.x, path.raster.y}].push_back(path.unweighted.g);
        }
    };
    (void)render(lamp_over_floor(), test::room_camera(), options, control);
    CHECK(found.size() > 50);
    for (const auto& [pixel, values] : found) {
        CHECK(values.size() == light_samples);
        CHECK(std::set(values.begin(), values.end()).size() > light_samples / 2);
    }
}

}  // namespace bdpt::light_samples_test
