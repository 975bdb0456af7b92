// Vertex connection and merging: what is promised of it, but for the means (tests/statistical).

#include "catch.hpp"
#include "math/rgb.h"
#include "moving_scenes.h"
#include "path/merge.h"
#include "purity.h"
#include "room.h"
#include "scene_builder.h"

#include <bdpt/render.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace bdpt::test::vcm_test {
namespace {

RenderOptions options(IntegratorKind integrator = IntegratorKind::vcm)
{
    RenderOptions result;
    result.integrator = integrator;
    result.film.width = 37;
    result.film.height = 29;
    result.sampling.samples = {.begin = 0, .end = 6};
    result.sampling.seed = 5;
    result.transport.max_depth = 5;
    result.bidirectional.merge_radius = 0.03;
    return result;
}

RenderResult image_of(const Scene& scene, const RenderOptions& options)
{
    return render(scene, room_camera(), options);
}

/// The message of what `render` throws.
std::string refusal(const Scene& scene, const RenderOptions& options,
                    const RenderControl& control = {})
{
    try {
        static_cast<void>(render(scene, room_camera(), options, control));
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

/// The mean of the middle of a developed film.
double mean_of_middle(const Film& film)
{
    const Image image = film.develop();
    double sum = 0.0;
    int count = 0;
    for (int y = image.height / 3; y < 2 * image.height / 3; ++y) {
        for (int x = image.width / 3; x < 2 * image.width / 3; ++x) {
            sum += static_cast<double>(image.at(x, y).g);
            ++count;
        }
    }
    return sum / count;
}

}  // namespace

TEST_CASE("vcm without a merge radius is bdpt, to the bit", "[vcm]")
{
    const Scene scene = room();
    const auto [light_paths, connections, rays] = GENERATE(
        std::tuple(1.0, std::optional<double>(), 0.0),
        std::tuple(2.0, std::optional<double>(), 0.0),
        std::tuple(0.25, std::optional<double>(), 0.0), std::tuple(0.5, std::optional(2.5), 0.0),
        std::tuple(0.5, std::optional(4.0), 3.0));
    RenderOptions vcm = options();
    vcm.bidirectional.light_paths = light_paths;
    vcm.bidirectional.connections = connections;
    vcm.bidirectional.connection_rays = rays;
    vcm.transport.heuristic = GENERATE(Heuristic::balance, Heuristic::power);
    RenderOptions bdpt = vcm;
    bdpt.integrator = IntegratorKind::bdpt;
    const RenderResult merged = image_of(scene, vcm);
    vcm.bidirectional.merge_radius = 0.0;
    const RenderResult connected = image_of(scene, vcm);
    const RenderResult expected = image_of(scene, bdpt);
    CHECK(connected.film == expected.film);
    CHECK(connected.stats == expected.stats);
    CHECK_FALSE(merged.film == expected.film);
}

TEST_CASE("merged images are the same for any threads, tiles, parts and crops", "[vcm][purity]")
{
    const Scene scene = room();
    RenderOptions o = options();
    std::tie(o.bidirectional.light_paths, o.bidirectional.max_merges) =
        GENERATE(std::pair(0.5, 0), std::pair(1.0, 0), std::pair(1.0, 3));
    o.system.threads = 1;
    const RenderResult whole = image_of(scene, o);
    CHECK(whole.film.defects().invalid == 0);
    check_purity(scene, o, whole);
}

TEST_CASE("the merge radius shrinks with the sample index", "[vcm]")
{
    RenderOptions o = options();
    o.bidirectional.merge_radius = 0.1;
    const LightPathCounts counts(o);
    const BoundingSphere sphere{.center = Vec3(1.0f), .radius = 20.0f};
    const auto radius = [&](std::int64_t index) {
        return Merging(o, counts, sphere, index).radius;
    };
    CHECK(radius(0) == Approx(2.0));
    CHECK(radius(15) == Approx(2.0 * std::pow(16.0, -0.125)));
    CHECK(radius(4'000'000'000) == Approx(2.0 * std::pow(4e9, -0.125)));
    CHECK(Merging(o, counts, sphere, 3).light_paths == 37.0f * 29.0f);
    CHECK(Merging(o, counts, sphere, 0).weight() == Approx(37.0 * 29.0 * 4.0 * 3.14159265));
    o.bidirectional.merge_alpha = 1.0;
    CHECK(radius(4'000'000'000) == Approx(2.0));
    o.bidirectional.merge_radius = 1e-12;  // finer than positions are
    CHECK(radius(0) > 1e-7f);
    o.bidirectional.merge_radius = 0.0;
    CHECK(Merging(o, LightPathCounts(o), sphere, 0).weight() == 0.0);
}

TEST_CASE("vcm sees a caustic in a mirror, which no other integrator can", "[vcm]")
{
    // A point light in a bulb of glass, over a floor that the camera sees in a mirror: neither the
    // light nor the floor can be joined to.
    SceneBuilder builder;
    builder.quad({-3, -1, 3}, {3, -1, 3}, {3, -1, -3}, {-3, -1, -3}, lambertian(Rgb(0.7f)));
    builder.quad({-2, -1, -1}, {2, -1, -1}, {2, 2, -1}, {-2, 2, -1}, metal(Rgb(0.9f), 0.0f));
    builder.sphere({0.0f, 0.0f, 0.5f}, 0.3f, glass(0.0f), 48);
    builder.light(PointLightDesc{.position = {0.0f, 0.0f, 0.5f}, .intensity = Rgb(3.0f)});
    const Scene scene(std::move(builder.desc));
    // Looks into the mirror alone.
    const CameraDesc camera = camera_at({1.2f, 1.0f, 2.5f}, {0.3f, -0.3f, -1.0f}, 0.3f);
    RenderOptions o = options();
    o.transport.max_depth = 7;
    o.sampling.samples.end = 16;
    o.bidirectional.merge_radius = 0.01;
    CHECK(mean_of_middle(render(scene, camera, o).film) > 0.02);
    for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::mis, IntegratorKind::lt}) {
        o.integrator = kind;
        CHECK(mean_of_middle(render(scene, camera, o).film) == 0.0);
    }
}

TEST_CASE("vertices of different times do not merge", "[vcm]")
{
    // Early a shade keeps light from a plate, late another one hides the plate from the camera.
    const auto brightness = [](bool hides) {
        SceneBuilder builder;
        builder.quad({-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0},
                     lambertian(Rgb(0.7f)));
        const auto shade = [&](float x, float begin) {
            builder.quad({x - 0.9f, -3, 1}, {x + 0.9f, -3, 1}, {x + 0.9f, 3, 1}, {x - 0.9f, 3, 1},
                         lambertian(Rgb(0.0f)));
            move_last(builder, 1, [begin](float t) {
                return translation({0.0f, 4.3f * (begin + t), 0.0f});
            });
        };
        shade(-1.0f, 0.0f);
        if (hides) {
            shade(1.0f, -1.0f);
        }
        builder.light(
            DirectionalLightDesc{.direction = {1.0f, 0.0f, -1.0f}, .illuminance = Rgb(1.0f)});
        RenderOptions o = options();
        o.transport.max_depth = 2;
        o.sampling.samples.end = 64;
        const CameraDesc camera = camera_at({3.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 0.15f);
        return mean_of_middle(render(Scene(std::move(builder.desc)), camera, o).film);
    };
    CHECK(brightness(false) > 0.005);
    CHECK(brightness(true) == 0.0);
}

TEST_CASE("vcm refuses what it cannot do", "[vcm]")
{
    const Scene scene = room();
    RenderOptions o = options();
    o.bidirectional.strategy_depth = 3;
    CHECK(refusal(scene, o).find("need the integrator bdpt or lt") != std::string::npos);
}

TEST_CASE("vcm tells all paths, and which of them it has merged", "[vcm]")
{
    const Scene scene = room();
    RenderOptions o = options();
    o.transport.heuristic = Heuristic::balance;
    o.bidirectional.max_merges = GENERATE(0, 3);
    o.system.threads = 1;
    double sum = 0.0;
    int merged = 0;
    RenderControl control;
    control.on_path = [&](const PathContribution& path) {
        const Rgb c = path.weight * path.unweighted;
        sum += static_cast<double>(c.r + c.g + c.b);
        double shares = 0.0;
        for (const float share : path.shares) {
            shares += static_cast<double>(share);
        }
        CHECK(path.strategy.s + path.strategy.t ==
              static_cast<int>(path.shares.size()) - 1 + (path.merged ? 1 : 0));
        if (path.merged) {
            ++merged;
            // What the strategies leave of one is the share of all merges of the path.
            CHECK(static_cast<double>(path.weight) <= 1.0 - shares + 1e-4);
        }
    };
    const Film film = render(scene, test::room_camera(), o, control).film;
    CHECK(merged > 100);
    const Image image = film.develop();
    double expected = 0.0;
    for (const Rgb& c : image.pixels) {
        expected += static_cast<double>(c.r + c.g + c.b);
    }
    CHECK(sum / static_cast<double>(film.sample_count()) == Approx(expected).epsilon(1e-3));
}

TEST_CASE("where merges are limited, those that are chosen stand for all", "[vcm]")
{
    const Scene scene = room();
    RenderOptions o = options();
    o.film.width = 64;
    o.film.height = 48;
    o.bidirectional.merge_radius = 0.1;
    struct Merges {
        double number = 0.0;
        double chances = 0.0;  ///< sum of 1 / chance
        double light = 0.0;    ///< sum of what they bring
    };
    const auto merges_with = [&](int limit) {
        Merges merges;
        o.bidirectional.max_merges = limit;
        o.system.threads = 1;
        RenderControl control;
        control.on_path = [&](const PathContribution& path) {
            if (path.merged) {
                merges.number += 1.0;
                merges.chances += 1.0 / static_cast<double>(path.chance);
                merges.light += static_cast<double>(path.weight * luminance(path.unweighted));
            }
        };
        static_cast<void>(render(scene, room_camera(), o, control));
        return merges;
    };
    const Merges all = merges_with(0);
    const Merges limited = merges_with(4);
    const Merges unlimited = merges_with(1'000'000);
    CHECK(all.chances == all.number);
    CHECK(unlimited.number == all.number);
    CHECK(unlimited.light == all.light);
    CHECK(limited.number < 0.5 * all.number);
    CHECK(limited.chances == Approx(all.number).epsilon(0.02));
    CHECK(limited.light == Approx(all.light).epsilon(0.02));
}

TEST_CASE("scenes without light have nothing to merge with", "[vcm]")
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), lambertian(Rgb(0.5f)));
    const RenderResult result = image_of(Scene(std::move(builder.desc)), options());
    CHECK(mean_of_middle(result.film) == 0.0);
    CHECK(result.film.defects().invalid == 0);
}

}  // namespace bdpt::test::vcm_test
