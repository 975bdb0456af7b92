// What a render tells of each path that it finds.

#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace bdpt::path_contribution_test {
namespace {

/// All that makes strategies blind: glass, a mirror, a point light, a lamp that is seen.
Scene room()
{
    test::SceneBuilder builder;
    builder.walls(test::plastic(Rgb(0.7f), 0.3f), test::lambertian({0.6f, 0.5f, 0.4f}));
    builder.ceiling(test::lambertian(Rgb(0.7f))).lamp(0.9f, 0.5f, Rgb(5.0f));
    builder.sphere({-0.4f, -0.6f, 0.0f}, 0.4f, test::glass(0.0f));
    builder.sphere({0.5f, -0.6f, 0.2f}, 0.4f, test::metal(Rgb(0.9f), 0.0f));
    builder.light(PointLightDesc{.position = {0.3f, 0.2f, 0.5f}, .intensity = Rgb(0.5f)});
    return Scene(std::move(builder.desc));
}

RenderOptions options(IntegratorKind integrator)
{
    RenderOptions result;
    result.integrator = integrator;
    result.film.width = 12;
    result.film.height = 8;
    result.sampling.samples = {.begin = 0, .end = 8};
    result.transport.max_depth = 5;
    result.transport.min_depth = 1;
    result.system.threads = 1;  // Catch's assertions are not for several threads
    return result;
}

CameraDesc lens()
{
    CameraDesc camera = test::room_camera();
    camera.lens_radius = 0.3f;
    camera.focus_distance = 3.0f;
    return camera;
}

/// A room with a body of milky glass, or of glass that absorbs what the milk would scatter.
Scene room_with_body(bool milky)
{
    test::SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.7f)), test::lambertian(Rgb(0.6f)));
    builder.ceiling(test::lambertian(Rgb(0.7f))).lamp(0.9f, 0.5f, Rgb(5.0f));
    MaterialDesc body = test::glass(0.3f);
    body.attenuation_color = Rgb(0.3f);
    body.attenuation_distance = 0.3f;
    body.volume_scatter.color = Rgb(milky ? 0.9f : 0.0f);
    builder.sphere({0.0f, -0.3f, 0.0f}, 0.6f, body, 16);
    return Scene(std::move(builder.desc));
}

constexpr auto all_integrators = {IntegratorKind::bdpt, IntegratorKind::pt, IntegratorKind::mis,
                                  IntegratorKind::nee, IntegratorKind::lt};

}  // namespace

TEST_CASE("found paths add up to the image, and telling of them does not change it", "[paths]")
{
    const Scene scene = room();
    for (const IntegratorKind integrator : all_integrators) {
        for (const int min_depth : {1, 3}) {
            CAPTURE(static_cast<int>(integrator), min_depth);
            RenderOptions what = options(integrator);
            what.transport.min_depth = min_depth;
            what.film.filter = {.kind = FilterKind::gaussian};
            what.film.crop = PixelRect{.x0 = 2, .y0 = 0, .x1 = 12, .y1 = 7};
            std::vector<Vec3> sums(70, Vec3(0.0f));
            RenderControl control;
            control.on_path = [&](const PathContribution& path) {
                const auto x = static_cast<std::size_t>(path.raster.x);
                const auto y = static_cast<std::size_t>(path.raster.y);
                REQUIRE(what.film.crop->contains(static_cast<int>(std::floor(path.raster.x)),
                                                 static_cast<int>(std::floor(path.raster.y))));
                sums[y * 10 + x - 2] += path.weight * path.unweighted / 8.0f;
                CHECK(path.strategy.s + path.strategy.t > min_depth);
            };
            const RenderResult told = render(scene, lens(), what, control);
            CHECK(told.film == render(scene, lens(), what).film);
            const Image image = told.film.develop();
            for (std::size_t i = 0; i < sums.size(); ++i) {
                REQUIRE(sums[i].r == Approx(image.pixels[i].r).epsilon(1e-4).margin(1e-7));
                REQUIRE(sums[i].b == Approx(image.pixels[i].b).epsilon(1e-4).margin(1e-7));
            }
        }
    }
}

TEST_CASE("shares of all strategies sum to one and are those behind the weight", "[paths]")
{
    const Scene scene = room();
    for (const CameraDesc& camera : {test::room_camera(), lens()}) {
        for (const IntegratorKind integrator : {IntegratorKind::bdpt, IntegratorKind::lt}) {
            for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
                RenderOptions what = options(integrator);
                what.transport.heuristic = heuristic;
                what.bidirectional.light_paths = 2;
                int paths = 0;
                int blind = 0;
                RenderControl control;
                control.on_path = [&](const PathContribution& path) {
                    const auto& shares = path.shares;
                    REQUIRE(shares.size() ==
                            static_cast<std::size_t>(path.strategy.s + path.strategy.t + 1));
                    const float sum = std::accumulate(shares.begin(), shares.end(), 0.0f);
                    REQUIRE(sum == Approx(1.0).epsilon(1e-5));
                    double raised = 0.0;
                    for (const float share : shares) {
                        REQUIRE(share >= 0.0f);
                        raised += heuristic == Heuristic::power
                                      ? static_cast<double>(share) * static_cast<double>(share)
                                      : static_cast<double>(share);
                        blind += share == 0.0f ? 1 : 0;
                    }
                    const auto own =
                        static_cast<double>(shares[static_cast<std::size_t>(path.strategy.s)]);
                    const double weight = heuristic == Heuristic::power ? own * own : own;
                    REQUIRE(static_cast<double>(path.weight) ==
                            Approx(weight / raised).epsilon(1e-3).margin(1e-6));
                    ++paths;
                };
                (void)render(scene, camera, what, control);
                CHECK(paths > 500);
                CHECK(blind > 100);  // mirrors and the point light rule strategies out
            }
        }
    }
}

TEST_CASE("paths are known to scatter in a body: they bring what a body without scattering lacks",
          "[paths][media][long]")
{
    const auto integrator = GENERATE(IntegratorKind::bdpt, IntegratorKind::lt);
    CAPTURE(static_cast<int>(integrator));
    RenderOptions what = options(integrator);
    what.sampling.samples.end = 512;
    what.transport.max_depth = 8;
    const auto light = [&](bool milky, bool in_body) {
        double sum = 0.0;
        RenderControl control;
        control.on_path = [&](const PathContribution& path) {
            REQUIRE((milky || !path.scatters_in_body));
            if (path.scatters_in_body == in_body) {
                sum += static_cast<double>(path.weight * path.unweighted.g);
            }
        };
        (void)render(room_with_body(milky), test::room_camera(), what, control);
        return sum;
    };
    const double elsewhere = light(true, false);
    CHECK(elsewhere == Approx(light(false, false)).epsilon(0.02));
    CHECK(light(true, true) > 0.05 * elsewhere);
}

TEST_CASE("path tracers tell strategies with at most one vertex from the light", "[paths]")
{
    const Scene scene = room();
    for (const IntegratorKind integrator :
         {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::nee}) {
        int hits = 0;
        int joins = 0;
        RenderControl control;
        control.on_path = [&](const PathContribution& path) {
            REQUIRE(path.strategy.s <= 1);
            REQUIRE(path.shares.empty());
            REQUIRE(path.weight == 1.0f);
            ++(path.strategy.s == 0 ? hits : joins);
        };
        (void)render(scene, test::room_camera(), options(integrator), control);
        CHECK(hits > 0);
        CHECK(joins > 0);
    }
}

}  // namespace bdpt::path_contribution_test
