// Verdicts about a renderer that is known: a toy whose paths are points of an interval.

#include "verify/verdict.h"

#include "catch.hpp"
#include "toy_light.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bdpt::eval::verdict_test {
namespace {

using test::ToyFault;
using test::ToyLight;

constexpr int enough = 600;  // batches

const TileGrid grid(4, 4, 2);

VerifyOptions toy_options(double false_alarm = 1e-3)
{
    VerifyOptions options;
    options.max_depth = 2;
    options.false_alarm = false_alarm;
    options.detectable_bias = 0.02;
    return options;
}

Evidence gather(const ToyFault& fault, int batches, std::uint64_t seed = 1)
{
    ToyLight toy(seed, fault);
    Evidence evidence(grid, 2, 4);
    for (int i = 0; i < batches; ++i) {
        evidence.add(toy.batch(grid));
    }
    return evidence;
}

VerifyReport judge_toy(const ToyFault& fault, int batches = enough)
{
    return judge(gather(fault, batches), toy_options());
}

const StrategyFinding& finding(const VerifyReport& report, Strategy strategy)
{
    return *std::find_if(report.strategies.begin(), report.strategies.end(),
                         [&](const auto& found) { return found.strategy == strategy; });
}

const IntegratorFinding& finding(const VerifyReport& report, IntegratorKind kind)
{
    return *std::find_if(
        report.integrators.begin(), report.integrators.end(),
        [&](const auto& found) { return found.integrator == kind && found.edges == 2; });
}

}  // namespace

TEST_CASE("a sound renderer passes, although strategies are blind, rare or without variance",
          "[long]")
{
    const VerifyReport report = judge_toy({});
    CHECK(report.verdict == Verdict::pass);
    CHECK(report.detectable < 0.02);
    CHECK(report.weights.wrong == 0);
    CHECK(report.radiance == Approx(1.0).epsilon(0.02));
    CHECK(report.lengths[0].radiance == 0.0);
    CHECK(report.lengths[1].radiance == Approx(1.0).epsilon(0.02));
    // Strategy 2 sees [0.3, 1), 3 sees [0, 0.01), lt what either sees.
    CHECK(finding(report, {0, 3}).blind == Approx(0.0).margin(1e-9));
    CHECK(finding(report, {2, 1}).blind == Approx(0.3).margin(0.02));
    CHECK(finding(report, {3, 0}).blind == Approx(0.99).margin(0.02));
    CHECK(report.lengths[1].seen_from_camera == Approx(1.0));
    CHECK(report.lengths[1].seen_from_light == Approx(0.71).margin(0.02));
    // Each point is found by more than one strategy.
    CHECK(report.unchecked == 0.0);
    double weighted = 0.0;
    for (const StrategyFinding& found : report.strategies) {
        weighted += found.weighted;
    }
    CHECK(weighted == Approx(report.radiance));
}

TEST_CASE("a sound renderer with few samples is inconclusive")
{
    const VerifyReport report = judge_toy({}, 8);
    CHECK(report.verdict == Verdict::inconclusive);
    CHECK(report.detectable > 0.02);
    CHECK(judge_toy({}, 2).verdict == Verdict::inconclusive);
}

TEST_CASE("what is noisier than was asked for is inconclusive, with many samples too", "[long]")
{
    VerifyOptions strict = toy_options();
    strict.detectable_bias = 1e-4;
    const VerifyReport report = judge(gather({}, enough), strict);
    CHECK(report.verdict == Verdict::inconclusive);
    CHECK(report.detectable > 1e-4);
    CHECK(report.detectable < 0.02);
}

TEST_CASE("nothing is said to be detectable with so few samples that it would not be", "[long]")
{
    const int fewest = static_cast<int>(trusted_samples / (16 * bdpt_samples));
    VerifyOptions lenient = toy_options();
    lenient.detectable_bias = 1.0;
    CHECK(judge(gather({}, fewest - 1), lenient).verdict == Verdict::inconclusive);
    CHECK(judge(gather({}, fewest), lenient).verdict == Verdict::pass);
}

TEST_CASE("nothing can be said about the dark")
{
    ToyFault dark;
    dark.factors = {0.0, 0.0, 0.0, 0.0};
    dark.integrators = {0.0, 0.0, 0.0, 0.0};
    const VerifyReport report = judge_toy(dark, 8);
    CHECK(report.verdict == Verdict::inconclusive);
    CHECK(report.radiance == 0.0);
}

TEST_CASE("a strategy with a wrong factor fails", "[long]")
{
    for (std::size_t s = 0; s < 3; ++s) {
        for (const double factor : {0.93, 1.07}) {
            CAPTURE(s, factor);
            ToyFault fault;
            fault.factors[s] = factor;
            const VerifyReport report = judge_toy(fault);
            CHECK(report.verdict == Verdict::fail);
            const Strategy wrong{.s = static_cast<int>(s), .t = 3 - static_cast<int>(s)};
            const MeanComparison& test = finding(report, wrong).whole;
            CHECK(fails(test, report));
            CHECK((test.found < test.expected) == (factor < 1.0));
        }
    }
}

TEST_CASE("light in the wrong channel fails, although the mean of all is right", "[long]")
{
    const Rgb tint(1.07f, 1.0f, 0.93f);
    const VerifyReport strategy = judge_toy({.tint = tint});
    CHECK(strategy.verdict == Verdict::fail);
    const StrategyFinding& wrong = finding(strategy, {.s = 0, .t = 3});
    CHECK_FALSE(fails(wrong.whole, strategy));
    REQUIRE(wrong.channels.size() == 3);
    CHECK(fails(wrong.channels[0], strategy));
    CHECK_FALSE(fails(wrong.channels[1], strategy));
    CHECK(fails(wrong.channels[2], strategy));
    CHECK(wrong.channels[2].found < wrong.channels[2].expected);
    const VerifyReport integrator = judge_toy({.tint_of_mis = tint});
    CHECK(integrator.verdict == Verdict::fail);
    const IntegratorFinding& mis = finding(integrator, IntegratorKind::mis);
    CHECK_FALSE(fails(mis.whole, integrator));
    CHECK(fails(mis.channels.at(0), integrator));
}

TEST_CASE("a wrong factor is seen in what others find, if hardly anyone checks the strategy",
          "[long]")
{
    // Where strategy 3 finds anything, in a hundredth of the image, its weight is nearly one.
    ToyFault fault;
    fault.factors[3] = 5.0;
    const VerifyReport report = judge_toy(fault);
    CHECK(report.verdict == Verdict::fail);
    CHECK(fails(finding(report, {0, 3}).whole, report));
    fault.factors[3] = 1.05;  // changes the image by 0.05 %
    CHECK(judge_toy(fault).verdict == Verdict::pass);
}

TEST_CASE("a strategy that is wrong in a part of the image fails there")
{
    ToyFault fault;
    fault.factors[2] = 1.08;
    fault.only_left = true;
    const VerifyReport report = judge_toy(fault);
    CHECK(report.verdict == Verdict::fail);
    const auto& tiles = finding(report, {2, 1}).tiles;
    REQUIRE(tiles.size() == 4);
    CHECK(fails(tiles[0], report));
    CHECK_FALSE(fails(tiles[1], report));
    CHECK(fails(tiles[2], report));
    CHECK_FALSE(fails(tiles[3], report));
}

TEST_CASE("an integrator with a wrong factor fails", "[long]")
{
    for (std::size_t i = 0; i < 4; ++i) {
        CAPTURE(i);
        ToyFault fault;
        fault.integrators[i] = i == 1 ? 0.8 : 0.95;  // nee has no finite variance
        const VerifyReport report = judge_toy(fault);
        CHECK(report.verdict == Verdict::fail);
        CHECK(fails(finding(report, other_integrators[i]).whole, report));
    }
}

TEST_CASE("weights that do not sum to one fail", "[long]")
{
    ToyFault scaled;
    scaled.weights = 0.99;
    const VerifyReport report = judge_toy(scaled, 8);
    CHECK(report.verdict == Verdict::fail);
    CHECK(report.weights.wrong > 0);
    CHECK(report.weights.worst == Approx(0.01).epsilon(0.05));
    // Each strategy's own weight is what it thinks that it is, but they disagree about a density.
    ToyFault disagreeing;
    disagreeing.own_density = 1.3;
    CHECK(judge_toy(disagreeing).weights.wrong == 0);
    CHECK(judge_toy(disagreeing).verdict == Verdict::fail);
    // A strategy is thought to find what it never finds.
    ToyFault claiming;
    claiming.claims_all = true;
    CHECK(judge_toy(claiming).verdict == Verdict::fail);
}

TEST_CASE("defects and lost light fail")
{
    const auto with = [](const ImageCheck& check) {
        ToyLight toy(1, {});
        Evidence evidence(grid, 2, 4);
        for (int i = 0; i < 2; ++i) {
            Batch batch = toy.batch(grid);
            batch.images[3] = i == 1 ? check : ImageCheck{};
            evidence.add(batch);
        }
        return judge(evidence, toy_options());
    };
    CHECK(with({}).verdict == Verdict::inconclusive);
    ImageCheck invalid;
    invalid.defects.invalid = 1;
    invalid.defects.first_invalid = FilmDefects::Place{.x = 3, .y = 1, .sample_index = 7};
    CHECK(with(invalid).verdict == Verdict::fail);
    CHECK(with(invalid).images[3].defects.first_invalid == invalid.defects.first_invalid);
    CHECK(with({.defects = {.invalid = 0, .saturated = 1, .first_invalid = {}}, .lost = 0.0})
              .verdict == Verdict::fail);
    CHECK(with({.defects = {}, .lost = 0.01}).verdict == Verdict::fail);
    CHECK(with({.defects = {}, .lost = 1e-5}).verdict == Verdict::inconclusive);
}

TEST_CASE("light that only one strategy can make is at stake, or unchecked")
{
    // Of two edges, made by s = 0 alone (path tracers see it), or by s = 2 alone (they do not).
    for (int s = 0; s < 3; ++s) {
        Evidence evidence(grid, 2, 4);
        for (int i = 0; i < 4; ++i) {
            const RadianceSums none(grid, 2);
            Batch batch{
                .bdpt = PathSums(grid, 2), .others = {none, none, none, none}, .images = {}};
            std::array<float, 4> shares{};
            shares[static_cast<std::size_t>(s)] = 1.0f;
            batch.bdpt.add({.strategy = {.s = s, .t = 3 - s},
                            .raster = Vec2(0.5f),
                            .unweighted = Rgb(static_cast<float>(1 + i % 2)),
                            .weight = 1.0f,
                            .shares = shares});
            evidence.add(batch);
        }
        const VerifyReport report = judge(evidence, toy_options());
        CHECK(report.unchecked == (s == 2 ? 1.0 : 0.0));
        CHECK(finding(report, {s, 3 - s}).solitary == Approx(report.radiance));
        if (s == 0) {
            CHECK(finding(report, {0, 3}).whole.detectable >= 1.0);
        }
    }
}

TEST_CASE("rare samples count as far as they have not been seen")
{
    // Of two edges, found by s = 1, which has nearly all of the share, in each batch once. pt,
    // which takes half as many samples, finds the same light by s = 0 in one of 200 batches, 99
    // nit.
    static_assert(bdpt_samples == 2 * other_samples);
    constexpr int batches = 400;
    constexpr float share = 0.01f;
    constexpr double bright = 99.0;
    const std::array<float, 4> shares{share, 1.0f - share, 0.0f, 0.0f};
    const float squares = share * share + (1.0f - share) * (1.0f - share);
    const auto error_of_pt = [&](bool seen) {
        Evidence evidence(grid, 2, 4);
        for (int i = 0; i < batches; ++i) {
            const RadianceSums none(grid, 2);
            Batch batch{
                .bdpt = PathSums(grid, 2), .others = {none, none, none, none}, .images = {}};
            const auto find = [&](int s, float radiance) {
                return PathContribution{.strategy = {.s = s, .t = 3 - s},
                                        .raster = Vec2(0.5f),
                                        .unweighted = Rgb(radiance)};
            };
            PathContribution found = find(1, 1.0f);
            found.weight = (1.0f - share) * (1.0f - share) / squares;
            found.shares = shares;
            batch.bdpt.add(found);
            if (seen && i % 200 == 0) {
                batch.others[0].add(find(0, static_cast<float>(bright)));
            }
            evidence.add(batch);
        }
        return finding(judge(evidence, toy_options()), IntegratorKind::pt).whole.error;
    };
    // Of two batches in 400: the spread alone.
    const double samples = 16.0 * other_samples * batches;
    const double spread = bright * std::sqrt(2.0 * (1.0 - 2.0 / batches)) / samples;
    CHECK(error_of_pt(true) == Approx(spread).epsilon(0.01));
    // None of them: what they would have added.
    CHECK(error_of_pt(false) == Approx(spread).epsilon(0.02));
}

TEST_CASE("what is said to be detectable is detected nine times out of ten", "[long]")
{
    // As few as anything is said of.
    const int batches = static_cast<int>(trusted_samples / (16 * bdpt_samples));
    constexpr int runs = 12;
    const VerifyReport sound = judge_toy({}, batches);
    for (int s = 0; s < 3; ++s) {
        const StrategyFinding& claimed = finding(sound, {.s = s, .t = 3 - s});
        ToyFault fault;
        // So that the mean of the image changes by that.
        fault.factors[static_cast<std::size_t>(s)] =
            1.0 + claimed.whole.detectable * sound.radiance / claimed.weighted;
        int found = 0;
        for (std::uint64_t seed = 0; seed < runs; ++seed) {
            const Evidence evidence = gather(fault, batches, 5000 + seed);
            found += judge(evidence, toy_options()).verdict == Verdict::fail ? 1 : 0;
        }
        CAPTURE(s, claimed.whole.detectable);
        CHECK(found >= 8);  // fewer with a chance of 0.4 %
    }
}

TEST_CASE("the tests of a family are corrected for their number")
{
    ToyFault fault;
    fault.factors[2] = 1.1;
    const VerifyReport report = judge_toy(fault, 40);
    const MeanComparison* min_whole = nullptr;
    const MeanComparison* min_tile = nullptr;
    std::size_t wholes = 0;
    std::size_t tiles = 0;
    const auto look = [&](const auto& finding) {
        wholes += 1 + finding.channels.size();
        tiles += finding.tiles.size();
        if (min_whole == nullptr || finding.whole.p < min_whole->p) {
            min_whole = &finding.whole;
        }
        for (const MeanComparison& channel : finding.channels) {
            min_whole = channel.p < min_whole->p ? &channel : min_whole;
        }
        for (const MeanComparison& tile : finding.tiles) {
            min_tile = min_tile == nullptr || tile.p < min_tile->p ? &tile : min_tile;
        }
    };
    std::for_each(report.strategies.begin(), report.strategies.end(), look);
    std::for_each(report.integrators.begin(), report.integrators.end(), look);
    CHECK(wholes == 60);  // the mean and three channels
    CHECK(tiles == 60);
    CHECK(min_whole->p_adjusted ==
          Approx(std::min(1.0, min_whole->p * static_cast<double>(wholes))));
    CHECK(min_tile->p_adjusted == Approx(std::min(1.0, min_tile->p * static_cast<double>(tiles))));
    CHECK(min_tile->p < min_tile->p_adjusted);
}

TEST_CASE("false alarms are as rare as promised", "[long]")
{
    constexpr int runs = 300;
    constexpr double false_alarm = 0.05;
    int alarms = 0;
    for (std::uint64_t seed = 0; seed < runs; ++seed) {
        const Evidence evidence = gather({}, 24, 1000 + seed);
        alarms += judge(evidence, toy_options(false_alarm)).verdict == Verdict::fail ? 1 : 0;
    }
    CAPTURE(alarms);
    // 15 expected at most; beyond 30 with a chance of 1e-4.
    CHECK(alarms <= 30);
}

}  // namespace bdpt::eval::verdict_test
