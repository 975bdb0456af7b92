#include "pilot/pilot_contributions.h"

#include "catch.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt::test::kept_paths_test {
namespace {

/// A path of that value, which camera paths alone find.
PilotContribution path_of(float value, double number = 1.0)
{
    const std::vector<float> shares{0.0f, 1.0f, 0.0f, 0.0f, 0.0f};
    return {.cell = 7,
            .shares = PathShares(
                {.strategy = {.s = 1, .t = 3}, .unweighted = Rgb(value), .shares = shares},
                Heuristic::power, 1.0),
            .number = number};
}

struct Sums {
    double number = 0.0;
    double light = 0.0;
    double squares = 0.0;
};

Sums sums_of(const std::vector<PilotContribution>& paths)
{
    Sums sums;
    for (const PilotContribution& path : paths) {
        const double mean = path.shares.mean();
        sums.number += path.number;
        sums.light += path.number * mean;
        sums.squares += path.number * mean * mean;
    }
    return sums;
}

/// Dim and bright paths, some of which stand for several.
std::vector<PilotContribution> uneven_paths()
{
    std::vector<PilotContribution> paths;
    for (int i = 0; i < 100; ++i) {
        paths.push_back(
            path_of(std::exp(-0.05f * static_cast<float>(i * 37 % 100)), i % 3 == 0 ? 2.5 : 1.0));
    }
    return paths;
}

}  // namespace

TEST_CASE("few paths are all kept", "[pilot]")
{
    std::vector<PilotContribution> paths(20 + pilot_constants.sampling.kept_paths,
                                         path_of(1.0f, 3.0));
    keep_some(paths, 20, 1);
    REQUIRE(paths.size() == 20 + pilot_constants.sampling.kept_paths);
    for (const PilotContribution& path : paths) {
        CHECK(path.number == 3.0);
    }
}

TEST_CASE("of many paths some are kept, and sums over all remain unbiased", "[pilot]")
{
    const std::vector<PilotContribution> all = uneven_paths();
    const Sums expected = sums_of(all);
    Sums mean;
    constexpr int repetitions = 20000;
    for (std::uint64_t random = 0; random < repetitions; ++random) {
        std::vector<PilotContribution> paths = all;
        keep_some(paths, 0, random);
        REQUIRE(paths.size() + 1 >= pilot_constants.sampling.kept_paths);
        REQUIRE(paths.size() <= pilot_constants.sampling.kept_paths + 1);
        const Sums sums = sums_of(paths);
        mean.number += sums.number / repetitions;
        mean.light += sums.light / repetitions;
        mean.squares += sums.squares / repetitions;
        // One random number chooses all, so that no sum is far off.
        CHECK(std::abs(sums.light - expected.light) < 0.5 * expected.light);
    }
    CHECK(mean.number == Approx(expected.number).epsilon(0.02));
    CHECK(mean.light == Approx(expected.light).epsilon(0.01));
    CHECK(mean.squares == Approx(expected.squares).epsilon(0.01));
}

TEST_CASE("a path that is brighter than all others is always kept, and earlier ones untouched",
          "[pilot]")
{
    for (std::uint64_t random = 0; random < 100; ++random) {
        std::vector<PilotContribution> paths(3, path_of(0.001f));
        paths.resize(103, path_of(1.0f));
        paths[50] = path_of(1000.0f);
        keep_some(paths, 3, random);
        REQUIRE(paths.size() < 20);
        int found = 0;
        for (const PilotContribution& path : paths) {
            found += path.shares.mean() > 999.0 && path.number == 1.0 ? 1 : 0;
        }
        CHECK(found == 1);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(paths[i].shares.mean() < 0.01);
            CHECK(paths[i].number == 1.0);
        }
    }
}

TEST_CASE("black paths are not kept where there are many", "[pilot]")
{
    std::vector<PilotContribution> paths(100, path_of(0.0f));
    keep_some(paths, 0, 5);
    CHECK(paths.empty());
}

}  // namespace bdpt::test::kept_paths_test
