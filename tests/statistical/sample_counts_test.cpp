// Numbers of light paths, connections and light samples change noise only.

#include "catch.hpp"
#include "equal_means.h"
#include "equality_cases.h"
#include "equality_check.h"
#include "scene_builder.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::test::sample_counts_test {

TEST_CASE("bdpt with any numbers of light paths and connections agrees with mis",
          "[equality][light-paths][long]")
{
    // Half of all cases, each with other numbers.
    std::vector<EqualityCase> cases = equality_cases();
    for (const auto& more : {motion_cases(), layer_cases(), many_light_cases()}) {
        cases.insert(cases.end(), more.begin(), more.end());
    }
    const std::array<std::pair<double, double>, 6> numbers{
        {{0.06, 1.0}, {0.5, 2.5}, {4.0, 0.25}, {0.0, 0.0}, {2.0, 1.0}, {1.0, 4.0}}};
    for (std::size_t i = 0; i < cases.size(); i += 2) {
        const EqualityCase& test = cases[i];
        const auto [light_paths, connections] = numbers[(i + i / 6) % numbers.size()];
        const Scene scene(test.scene);
        TileMeans mis(scene, test.camera, options(test, IntegratorKind::mis, 450000 + 10 * i));
        RenderOptions shared = options(test, IntegratorKind::bdpt, 450001 + 10 * i);
        shared.bidirectional.light_paths = light_paths;
        shared.bidirectional.connections = connections;
        shared.transport.heuristic = i % 4 == 0 ? Heuristic::power : Heuristic::balance;
        if (i % 8 < 4) {
            shared.bidirectional.disabled = {{.s = 1, .t = 1}};
        } else {
            shared.bidirectional.visible_light_samples = 0.2;
        }
        TileMeans bdpt(scene, test.camera, shared);
        const std::string what = "mis = bdpt with " + std::to_string(light_paths) +
                                 " light paths and " + std::to_string(connections) + " connections";
        check_equal(test, what.c_str(), mis, bdpt);
    }
}

TEST_CASE("several light samples agree with one", "[equality][long]")
{
    std::vector<EqualityCase> cases = equality_cases();
    const auto more = many_light_cases();
    cases.insert(cases.end(), more.begin(), more.end());
    for (std::size_t i = 0; i < cases.size(); i += 4) {
        const bool in_fog = i == 0;  // where there are three ways to a lamp
        const EqualityCase test = in_fog ? media_cases().front() : cases[i];
        const Scene scene(test.scene);
        const std::uint64_t seed = 470000 + 10 * i;
        TileMeans one(scene, test.camera, options(test, IntegratorKind::mis, seed));
        for (const auto kind : {IntegratorKind::mis, IntegratorKind::nee, IntegratorKind::bdpt}) {
            RenderOptions four = options(test, kind, seed + 1 + static_cast<std::uint64_t>(kind));
            four.sampling.light_samples = 4;
            four.bidirectional.light_paths = i % 8 == 0 ? 1.0 : 0.5;
            TileMeans several(scene, test.camera, four);
            check_equal(test, "1 = 4 light samples", one, several,
                        test.detectable_bias_of_light_sampling);
        }
    }
}

TEST_CASE("light tracing with a fraction of a light path agrees with mis",
          "[equality][light-paths]")
{
    const auto cases = equality_cases();
    const EqualityCase& test = cases.front();
    REQUIRE(test.seen_by_lt);
    const Scene scene(test.scene);
    RenderOptions mis_options = options(test, IntegratorKind::mis, 460001);
    RenderOptions lt_options = options(test, IntegratorKind::lt, 460002);
    mis_options.transport.min_depth = *test.seen_by_lt;
    lt_options.transport.min_depth = *test.seen_by_lt;
    lt_options.bidirectional.light_paths = 0.3;
    TileMeans mis(scene, test.camera, mis_options);
    TileMeans lt(scene, test.camera, lt_options);
    check_equal(test, "mis = lt with 0.3 light paths", mis, lt,
                test.detectable_bias_of_light_sampling);
}

TEST_CASE("several light paths have the time of their sample", "[equality][motion][long]")
{
    const EqualityCase test = motion_cases().front();
    const Scene scene(test.scene);
    TileMeans mis(scene, test.camera, options(test, IntegratorKind::mis, 410001));
    RenderOptions three_light_paths = options(test, IntegratorKind::bdpt, 410002);
    three_light_paths.bidirectional.light_paths = 3;
    TileMeans bdpt(scene, test.camera, three_light_paths);
    check_equal(test, "mis = bdpt, three light paths", mis, bdpt);
    RenderOptions shared = options(test, IntegratorKind::bdpt, 410003);
    shared.bidirectional.light_paths = 0.5;
    shared.bidirectional.connections = 2.5;
    TileMeans sharing(scene, test.camera, shared);
    check_equal(test, "mis = bdpt, shared light paths", mis, sharing);
}

}  // namespace bdpt::test::sample_counts_test
