// Merging is judged beside the strategies.

#include "catch.hpp"
#include "statistics.h"
#include "verify/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bdpt::eval::merge_sums_test {
namespace {

/// Of an image of 4 x 4 pixels. Paths of two edges are points x of [0, 1), all of them as bright: 1
/// nit. A splat finds them with density 1, merging with density 2 `rarity` x, and brings `factor`
/// times as much as it should.
Batch toy_batch(test::Random& random, double factor, double rarity)
{
    const TileGrid grid(4, 4, 2);
    Batch batch{
        .bdpt = PathSums(grid, 2), .others = {5, RadianceSums(grid, 2)}, .images = {}};
    batch.merges.emplace(2, Measure::mean);
    const auto add = [&](bool merged, double x) {
        const double p = merged ? 2.0 * rarity * x : 1.0;
        const double sum = 1.0 + 2.0 * rarity * x;
        const std::array<float, 4> shares{0.0f, 0.0f, static_cast<float>(1.0 / sum), 0.0f};
        const double value = (merged ? factor : 1.0) / p;
        batch.merges->add({.strategy = {.s = 2, .t = merged ? 2 : 1},
                           .merged = merged,
                           .raster = {1.5f, 1.5f},
                           .unweighted = Rgb(static_cast<float>(value)),
                           .weight = static_cast<float>(p / sum),
                           .shares = shares});
    };
    for (int i = 0; i < 16 * other_samples; ++i) {
        add(false, static_cast<double>(random.next()));
        if (static_cast<double>(random.next()) < rarity) {
            add(true, std::sqrt(1.0 - static_cast<double>(random.next())));
        }
    }
    return batch;
}

VerifyReport judged(double factor, double rarity)
{
    test::Random random(3);
    Evidence evidence(TileGrid(4, 4, 2), 2, 5);
    for (int i = 0; i < 400; ++i) {
        evidence.add(toy_batch(random, factor, rarity));
    }
    VerifyOptions options;
    options.max_depth = 2;
    return judge(evidence, options);
}

}  // namespace

TEST_CASE("merging with a wrong factor fails, however little weight it has")
{
    for (const double rarity : {0.1, 1.0}) {
        CAPTURE(rarity);
        const MergeFinding sound = judged(1.0, rarity).merges.at(1);
        CHECK(std::abs(sound.whole.z) < 4.0);
        CHECK(sound.whole.expected > 0.0);
        CHECK(sound.brought > 0.0);
        for (const double factor : {0.8, 1.25}) {
            CAPTURE(factor);
            const VerifyReport wrong = judged(factor, rarity);
            CHECK(fails(wrong.merges.at(1).whole, wrong));
            CHECK(wrong.verdict == Verdict::fail);
            CHECK((wrong.merges.at(1).whole.z > 0.0) == (factor > 1.0));
        }
    }
}

}  // namespace bdpt::eval::merge_sums_test
