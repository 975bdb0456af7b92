// Verdicts about a toy renderer whose walks are ended by roulette.

#include "verify/verdict.h"

#include "catch.hpp"
#include "toy_light.h"

#include <cmath>
#include <cstdint>

namespace bdpt::eval {
namespace {

const TileGrid grid(4, 4, 2);

VerifyOptions toy_options(double false_alarm = 1e-3)
{
    VerifyOptions options;
    options.max_depth = 5;
    options.false_alarm = false_alarm;
    options.detectable_bias = 0.02;
    return options;
}

/// A batch of a sound renderer whose paths of five edges are all alike, 1 nit. Strategy 2 finds one
/// with three of five samples; strategy 0 would with two of five, but roulette leaves few of them,
/// each worth more. All other strategies are blind. `factor`: of what strategy 0 finds.
Batch batch_with_roulette(test::Random& random, double survival, double factor = 1.0)
{
    constexpr int edges = 5;
    constexpr std::array<float, edges + 2> shares{0.4f, 0.0f, 0.6f};
    constexpr float squares = 0.4f * 0.4f + 0.6f * 0.6f;
    const RadianceSums none(grid, edges);
    Batch batch{.bdpt = PathSums(grid, edges), .others = {none, none, none, none}, .images = {}};
    const auto found = [](int s, Vec2 raster, double radiance) {
        return PathContribution{.strategy = {.s = s, .t = edges + 1 - s},
                                .raster = raster,
                                .unweighted = Rgb(static_cast<float>(radiance))};
    };
    for (int pixel = 0; pixel < 16; ++pixel) {
        const Vec2 raster(static_cast<float>(pixel % 4) + 0.5f,
                          static_cast<float>(pixel / 4) + 0.5f);
        for (int i = 0; i < bdpt_samples; ++i) {
            for (const int s : {0, 2}) {
                const float share = shares[static_cast<std::size_t>(s)];
                const double chance = static_cast<double>(share) * (s == 0 ? survival : 1.0);
                if (static_cast<double>(random.next()) < chance) {
                    PathContribution path = found(s, raster, (s == 0 ? factor : 1.0) / chance);
                    path.weight = share * share / squares;
                    path.shares = shares;
                    batch.bdpt.add(path);
                }
            }
        }
        for (std::size_t other = 0; other < 3; ++other) {
            for (int i = 0; i < samples_of(other_integrators[other], edges); ++i) {
                if (static_cast<double>(random.next()) < survival) {
                    batch.others[other].add(found(0, raster, 1.0 / survival));
                }
            }
        }
    }
    return batch;
}

}  // namespace

TEST_CASE("survivors of roulette that have not turned up are no false alarm")
{
    const VerifyOptions options = toy_options(0.05);
    constexpr int runs = 100;
    constexpr int batches = 24;
    for (const double expected : {0.5, 2.0, 6.0}) {
        // So many are expected of strategy 0 in all batches.
        const double survival = expected / (0.4 * 16 * bdpt_samples * batches);
        int alarms = 0;
        for (std::uint64_t seed = 0; seed < runs; ++seed) {
            test::Random random(7000 + seed);
            Evidence evidence(grid, 5);
            for (int i = 0; i < batches; ++i) {
                evidence.add(batch_with_roulette(random, survival));
            }
            alarms += judge(evidence, options).verdict == Verdict::fail ? 1 : 0;
        }
        CAPTURE(expected, alarms);
        CHECK(alarms <= 5);  // as many are allowed
    }
}

TEST_CASE("a strategy that is wrong fails where roulette leaves enough of it")
{
    const VerifyOptions options = toy_options();
    test::Random random(7);
    Evidence sound(grid, 5);
    Evidence wrong(grid, 5);
    for (int i = 0; i < 200; ++i) {
        sound.add(batch_with_roulette(random, 0.05));
        // Survivors are not worth as much as they should be.
        wrong.add(batch_with_roulette(random, 0.05, 0.8));
    }
    CHECK(judge(sound, options).verdict != Verdict::fail);
    CHECK(judge(wrong, options).verdict == Verdict::fail);
}

}  // namespace bdpt::eval
