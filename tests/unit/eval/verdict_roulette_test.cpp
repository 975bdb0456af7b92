// Verdicts about renderers whose walks are ended by roulette: a toy, and bdpt in a dark room.

#include "verify/samples.h"
#include "verify/verdict.h"

#include <bdpt/eval/verify.h>

#include "catch.hpp"
#include "scene_builder.h"
#include "toy_light.h"

#include <cmath>
#include <cstdint>

namespace bdpt::eval::verdict_roulette_test {
namespace {

constexpr int edges = 5;

const TileGrid grid(4, 4, 2);

/// Strategy 0 walks so far from the camera that roulette may end it; 2 does not.
constexpr Strategy thinned{.s = 0, .t = edges + 1};
constexpr Strategy whole{.s = 2, .t = edges - 1};

VerifyOptions toy_options(double false_alarm = 1e-3)
{
    VerifyOptions options;
    options.max_depth = edges;
    options.false_alarm = false_alarm;
    options.detectable_bias = 0.02;
    return options;
}

/// A batch of a sound renderer whose paths of five edges are all alike, 1 nit. Strategy 2 finds one
/// with three of five samples; strategy 0 would with two of five, but roulette leaves few of them,
/// each worth more. All other strategies are blind. `factor`: of what strategy 0 finds.
Batch batch_with_roulette(test::Random& random, double survival, double factor = 1.0)
{
    constexpr std::array<float, edges + 2> shares{0.4f, 0.0f, 0.6f};
    constexpr float squares = 0.4f * 0.4f + 0.6f * 0.6f;
    const RadianceSums none(grid, edges);
    Batch batch{.bdpt = PathSums(grid, edges), .others = {none, none, none, none}, .images = {}};
    const auto found = [](Strategy strategy, Vec2 raster, double radiance) {
        return PathContribution{.strategy = strategy,
                                .raster = raster,
                                .unweighted = Rgb(static_cast<float>(radiance))};
    };
    for (int pixel = 0; pixel < 16; ++pixel) {
        const Vec2 raster(static_cast<float>(pixel % 4) + 0.5f,
                          static_cast<float>(pixel / 4) + 0.5f);
        for (int i = 0; i < bdpt_samples; ++i) {
            for (const Strategy strategy : {thinned, whole}) {
                const float share = shares[static_cast<std::size_t>(strategy.s)];
                const bool ends = strategy == thinned;
                const double chance = static_cast<double>(share) * (ends ? survival : 1.0);
                if (static_cast<double>(random.next()) < chance) {
                    PathContribution path = found(strategy, raster, (ends ? factor : 1.0) / chance);
                    path.weight = share * share / squares;
                    path.shares = shares;
                    batch.bdpt.add(path);
                }
            }
        }
        for (std::size_t other = 0; other < 3; ++other) {
            for (int i = 0; i < count_samples(other_integrators[other], edges); ++i) {
                if (static_cast<double>(random.next()) < survival) {
                    batch.others[other].add(found(thinned, raster, 1.0 / survival));
                }
            }
        }
    }
    return batch;
}

/// A closed room that reflects 3 to 7 %, with a lamp below the ceiling, and a dark sphere in it.
Scene dark_room()
{
    test::SceneBuilder builder;
    const auto wall = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d, Rgb color) {
        builder.quad(a, b, c, d, test::lambertian(color));
    };
    wall({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, {0.07f, 0.05f, 0.03f});
    wall({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}, {0.03f, 0.05f, 0.07f});
    wall({-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, Rgb(0.05f));
    wall({1, -1, 1}, {-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, Rgb(0.04f));
    wall({-1, -1, 1}, {-1, -1, -1}, {-1, 1, -1}, {-1, 1, 1}, {0.07f, 0.03f, 0.03f});
    wall({1, -1, -1}, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}, {0.03f, 0.07f, 0.03f});
    builder.lamp(0.3f, 0.95f, Rgb(20.0f, 18.0f, 15.0f));
    builder.sphere({0.3f, -0.6f, -0.2f}, 0.4f, test::lambertian(Rgb(0.06f)));
    return Scene(std::move(builder.desc));
}

}  // namespace

TEST_CASE("roulette gives no path more than its greatest weight")
{
    for (const int longest : {1, 3, 4, 5, 8, 64}) {
        const Roulette roulette(longest);
        CAPTURE(longest);
        for (int s = 0; s <= longest + 1; ++s) {
            const double weight = roulette.max_weight({.s = s, .t = longest + 1 - s});
            const double rounds = std::max(0, s - 4) + std::max(0, longest - s - 3);
            CHECK(weight ==
                  Approx(std::pow(static_cast<double>(roulette.min_survival()), -rounds)));
            CHECK(weight <= Roulette::max_roulette_weight * (1.0 + 1e-9));
        }
    }
    CHECK(Roulette(5).max_weight(thinned) == Approx(Roulette::max_roulette_weight));
    CHECK(Roulette(5).max_weight(whole) == 1.0);
}

TEST_CASE("second moments of what roulette thins are not taken for less than they are")
{
    constexpr double tiny = 1e-12;  // all are above it [nit]
    test::Random random(3);
    StrategySums sums;
    for (int i = 0; i < 100; ++i) {
        const Batch batch = batch_with_roulette(random, 1.0 / Roulette::max_roulette_weight);
        const StrategyRow row(edges);
        for (std::size_t tile = 0; tile < grid.size(); ++tile) {
            sums += batch.bdpt.strategy(tile, row.index(whole));
        }
    }
    CHECK(sums.second_moment.above(tiny) > sums.seen.above(tiny));
}

TEST_CASE("survivors of roulette are no false alarm")
{
    const VerifyOptions options = toy_options(0.05);
    constexpr int runs = 100;
    int alarms = 0;
    for (std::uint64_t seed = 0; seed < runs; ++seed) {
        test::Random random(7000 + seed);
        Evidence evidence(grid, edges, 4);
        for (int i = 0; i < 24; ++i) {
            evidence.add(batch_with_roulette(random, 1.0 / Roulette::max_roulette_weight));
        }
        alarms += judge(evidence, options).verdict == Verdict::fail ? 1 : 0;
    }
    CAPTURE(alarms);
    CHECK(alarms <= 5);  // as many are allowed
}

TEST_CASE("a strategy that is wrong fails although roulette thins it")
{
    const VerifyOptions options = toy_options();
    test::Random random(7);
    Evidence sound(grid, edges, 4);
    Evidence wrong(grid, edges, 4);
    for (int i = 0; i < 200; ++i) {
        sound.add(batch_with_roulette(random, 0.25));
        // Survivors are not worth as much as they should be.
        wrong.add(batch_with_roulette(random, 0.25, 0.8));
    }
    CHECK(judge(sound, options).verdict != Verdict::fail);
    CHECK(judge(wrong, options).verdict == Verdict::fail);
}

TEST_CASE("a sound renderer does not fail in a room that is nearly black", "[long]")
{
    const Scene scene = dark_room();
    const CameraDesc camera = test::camera_at({0.0f, 0.0f, 0.9f}, {0.0f, -0.1f, 0.0f}, 1.2f);
    VerifyOptions options = toy_options();
    options.width = 8;
    options.height = 8;
    options.max_batches = 32;
    options.seconds = 1e6;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        options.seed = seed;
        CAPTURE(seed);
        CHECK(verify(scene, camera, options).verdict != Verdict::fail);
    }
}

}  // namespace bdpt::eval::verdict_roulette_test
