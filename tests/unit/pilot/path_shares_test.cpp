#include "pilot/pilot_contributions.h"

#include "catch.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace bdpt::test::path_shares_test {
namespace {

/// Of a path of four vertices, by the number of those from the light. In the pilot those with
/// s <= 1 have one sample, splats half of one, connections two.
constexpr std::array shares{0.1f, 0.2f, 0.3f, 0.25f, 0.15f};
constexpr int vertices = 4;
constexpr double pilot_light_paths = 0.5;

PathContribution path_of(int s)
{
    return {.strategy = {.s = s, .t = vertices - s},
            .merged = false,
            .light_path = 0,
            .raster = Vec2(0.5f),
            .unweighted = Rgb(3.0f),
            .weight = 1.0f,
            .shares = shares};
}

/// How many times as many samples as a pilot the candidate takes of strategy s.
double ratio(const Candidate& candidate, int s)
{
    return s == 0              ? 1.0
           : s == 1            ? candidate.light_samples
           : vertices - s <= 1 ? candidate.light_paths / pilot_light_paths
                               : candidate.connections / 2.0;
}

double power(double share, Heuristic heuristic)
{
    return heuristic == Heuristic::power ? share * share : share;
}

double weight_of(const Candidate& candidate, int s, Heuristic heuristic)
{
    double sum = 0.0;
    for (int i = 0; i <= vertices; ++i) {
        sum += power(ratio(candidate, i) * shares[static_cast<std::size_t>(i)], heuristic);
    }
    return power(ratio(candidate, s) * shares[static_cast<std::size_t>(s)], heuristic) / sum;
}

}  // namespace

TEST_CASE("a path that a pilot found has the weights of every candidate", "[pilot]")
{
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            const Candidate& candidate = candidates[k];
            double sum = 0.0;
            for (int s = 0; s <= vertices; ++s) {
                CAPTURE(candidate.light_paths, candidate.connections, s);
                const double weight =
                    PathShares(path_of(s), heuristic, pilot_light_paths).weights()[k];
                CHECK(weight == Approx(weight_of(candidate, s, heuristic)).epsilon(1e-5));
                sum += weight;
            }
            CHECK(sum == Approx(1.0).epsilon(1e-5));
        }
    }
}

TEST_CASE("a candidate finds a path as often as all of its strategies do", "[pilot]")
{
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        double number = 0.0;
        for (int s = 0; s <= vertices; ++s) {
            number +=
                ratio(candidates[k], s) * static_cast<double>(shares[static_cast<std::size_t>(s)]);
        }
        for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
            const PathShares found(path_of(2), heuristic, pilot_light_paths);
            CHECK(found.numbers()[k] == Approx(number).epsilon(1e-5));
        }
    }
}

TEST_CASE("second moments of a path are those of all strategies, whichever found it", "[pilot]")
{
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            const Candidate& candidate = candidates[k];
            for (int found = 0; found <= vertices; ++found) {
                CAPTURE(candidate.light_paths, candidate.connections, found);
                // f over the density of all strategies of the pilot together.
                const double mean =
                    3.0 * static_cast<double>(shares[static_cast<std::size_t>(found)]);
                double own = 0.0;
                double splats = 0.0;
                double connections = 0.0;
                for (int s = 0; s <= vertices; ++s) {
                    const double taken = ratio(candidate, s) *
                                         static_cast<double>(shares[static_cast<std::size_t>(s)]);
                    if (taken == 0.0) {
                        continue;
                    }
                    const double weight = weight_of(candidate, s, heuristic);
                    double& moment = s <= 1 ? own : vertices - s <= 1 ? splats : connections;
                    moment += mean * mean * weight * weight / taken;
                }
                const auto moments =
                    PathShares(path_of(found), heuristic, pilot_light_paths).second_moments();
                CHECK(moments.own[k] == Approx(own).epsilon(1e-5));
                CHECK(moments.connections[k] == Approx(connections).epsilon(1e-5));
                CHECK(moments.splats[k] == Approx(splats).epsilon(1e-5));
            }
        }
    }
}

TEST_CASE("a path that only light paths make counts against having none", "[pilot]")
{
    constexpr std::array only_splats{0.0f, 0.0f, 0.0f, 1.0f};
    const PathContribution path{.strategy = {.s = 3, .t = 0},
                                .merged = false,
                                .light_path = 0,
                                .raster = Vec2(0.5f),
                                .unweighted = Rgb(1.0f),
                                .weight = 1.0f,
                                .shares = only_splats};
    const PathShares found(path, Heuristic::power, pilot_light_paths);
    const PathShares::SecondMoments moments = found.second_moments();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (candidates[k].light_paths == 0.0) {
            CHECK(std::isinf(moments.own[k]));
            continue;
        }
        CHECK(moments.own[k] == 0.0);
        CHECK(moments.connections[k] == 0.0);
        // With a quarter of the pilot's light paths four times the second moment.
        CHECK(moments.splats[k] == Approx(pilot_light_paths / candidates[k].light_paths));
    }
    CHECK(found.camera_mean() == 0.0);
    CHECK(found.splat_mean() == Approx(1.0));
}

TEST_CASE("a path that a pilot found by merging counts for all strategies, too", "[pilot]")
{
    // Merging finds such paths 19 times for once that all strategies do, which thus bring 20 f.
    constexpr float others = 20.0f;
    std::array<float, shares.size()> rare{};
    for (std::size_t s = 0; s < rare.size(); ++s) {
        rare[s] = shares[s] / others;
    }
    const PathContribution path{.strategy = {.s = 3, .t = 2},
                                .merged = true,
                                .light_path = 0,
                                .raster = Vec2(0.5f),
                                .unweighted = Rgb(2.0f),
                                .weight = 0.95f,
                                .shares = rare};
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
        const PathShares found(path, heuristic, pilot_light_paths);
        CHECK(found.kind() == PathShares::indirect);
        CHECK(found.camera_mean() == Approx(2.0 * 0.95 / (1.0 - 0.4 / 20.0)));
        // As if it were found once in 20 times, and brought 20 times as much.
        PathContribution joined = path_of(1);
        joined.unweighted = Rgb(2.0f * 0.95f * others / shares[1]);
        const PathShares once(joined, heuristic, pilot_light_paths);
        CHECK(found.found_by_one() == Approx(once.found_by_one() / 20.0));
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            CAPTURE(candidates[k].light_paths, candidates[k].connections);
            CHECK(found.numbers()[k] == Approx(once.numbers()[k] / 20.0));
            CHECK(found.second_moments().own[k] == Approx(once.second_moments().own[k] / 20.0));
            CHECK(found.second_moments().splats[k] ==
                  Approx(once.second_moments().splats[k] / 20.0));
            CHECK(found.own_values()[k] == Approx(once.own_values()[k]));
        }
    }
}

TEST_CASE("the value of a path is its own part of the second moment over that of the mean",
          "[pilot]")
{
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
        const PathShares found(path_of(0), heuristic, pilot_light_paths);
        const double mean = 3.0 * static_cast<double>(shares[0]);
        for (std::size_t k = 0; k < candidates.size(); ++k) {
            const double weight =
                weight_of(candidates[k], 0, heuristic) + weight_of(candidates[k], 1, heuristic);
            CHECK(found.own_values()[k] ==
                  Approx(found.second_moments().own[k] / (mean * weight)).epsilon(1e-5));
        }
    }
}

TEST_CASE("cross terms of a sample are those of its definition", "[pilot]")
{
    CandidateMoments sample;
    const auto add = [&](int s, int light_path, float value) {
        PathContribution path = path_of(s);
        path.light_path = light_path;
        path.unweighted = Rgb(value);
        sample.add(path, PathShares(path, Heuristic::power, pilot_light_paths));
    };
    add(0, 0, 2.0f);
    add(1, 0, 3.0f);
    add(2, 0, 5.0f);
    add(2, 0, 7.0f);
    add(2, 1, 11.0f);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double c = candidates[k].connections;
        CAPTURE(candidates[k].light_paths, c);
        const auto weight = [&](int s) { return weight_of(candidates[k], s, Heuristic::power); };
        // Unweighted contributions are divided by the pilot's two connections.
        const double a0 = 2.0 * weight(0);
        const double a1 = 3.0 * weight(1);
        const double b0 = 10.0 * weight(2);
        const double b1 = 14.0 * weight(2);
        const double d = 22.0 * weight(2);
        double cross = 2.0 * a0 * a1;
        double value = a0 + a1;
        if (c > 0.0) {
            cross += 2.0 * (a0 + a1) * (b0 + b1 + d) / 2.0 + (2.0 * b0 * b1 + 0.0) / 2.0 / c +
                     (c > 1.0 ? (1.0 - 1.0 / c) * (b0 + b1) * d : 0.0);
            value += (b0 + b1 + d) / 2.0;
        }
        CHECK(sample.cross_terms(k) == Approx(cross).epsilon(1e-4));
        CHECK(sample.value(k) == Approx(value).epsilon(1e-5));
        CHECK(sample.light_samples(k) == Approx(a1).epsilon(1e-5));
    }
}

TEST_CASE("light samples of one vertex add their products to the second moment", "[pilot]")
{
    CandidateMoments sample;
    PathContribution path = path_of(1);
    path.unweighted = Rgb(3.0f);
    sample.add(path, PathShares(path, Heuristic::power, pilot_light_paths));
    VarianceOfSamples equal;
    equal.add(sample);
    equal.add(sample);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        // All samples have the mean m: of m^2 the squares of the n light samples, which are not
        // counted here, have a part of 1/n.
        const double mean = 3.0 * weight_of(candidates[k], 1, Heuristic::power);
        CHECK(equal.variance(k, 2) ==
              Approx(-mean * mean / candidates[k].light_samples).epsilon(1e-4));
    }
}

TEST_CASE("connections that are chosen rarely vary more", "[pilot]")
{
    constexpr double chance = 0.05;  // of one of the connections to 8 light paths, by one ray
    PathContribution path = path_of(2);
    path.chance = static_cast<float>(chance * PathShares::pilot_rays * 8.0 / 2.0);
    const auto moments = PathShares(path, Heuristic::power, pilot_light_paths).second_moments();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double rays = candidates[k].connection_rays;
        CAPTURE(candidates[k].light_paths, candidates[k].connections, rays);
        if (rays == 0.0) {
            CHECK(moments.choice[k] == 0.0);
        } else {
            const double expected = rays * chance * 8.0 / candidates[k].connections;
            CHECK(moments.choice[k] == Approx(moments.connections[k] * (1.0 / expected - 1.0)));
        }
    }
    path.chance = static_cast<float>(PathShares::pilot_rays);  // always chosen
    const auto sure = PathShares(path, Heuristic::power, pilot_light_paths).second_moments();
    for (const double choice : sure.choice) {
        CHECK(choice == 0.0);
    }
    CHECK(PathShares(path, Heuristic::power, pilot_light_paths).choice_is_known());
    // Of paths that were found otherwise, the choice is not known.
    const PathShares other(path_of(0), Heuristic::power, pilot_light_paths);
    CHECK_FALSE(other.choice_is_known());
    const auto unknown = other.second_moments();
    for (const double choice : unknown.choice) {
        CHECK(choice == 0.0);
    }
    PathContribution merged = path_of(2);
    merged.merged = true;
    CHECK_FALSE(PathShares(merged, Heuristic::power, pilot_light_paths).choice_is_known());
}

}  // namespace bdpt::test::path_shares_test
