// How many samples each strategy takes.

#include "path/strategy_set.h"

#include "catch.hpp"

namespace bdpt::test::strategy_set_test {

namespace {

RenderOptions bidirectional()
{
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    return options;
}

}  // namespace

TEST_CASE("few camera paths connect a point on a light to the lens, if they can hit lights",
          "[strategies]")
{
    RenderOptions options = bidirectional();
    CHECK(StrategySet(options).count(1, 1) == 1.0f / 64.0f);
    options.bidirectional.visible_light_samples = 0.5;
    CHECK(StrategySet(options).count(1, 1) == 0.5f);
    CHECK(StrategySet(options).count(1, 2) == 1.0f);

    SECTION("lt")
    {
        options.integrator = IntegratorKind::lt;
    }
    SECTION("hits disabled")
    {
        options.bidirectional.disabled = {{.s = 0, .t = 2}};
    }
    SECTION("uniform weights")
    {
        options.transport.heuristic = Heuristic::uniform;
    }
    SECTION("camera paths without edges")
    {
        options.bidirectional.max_camera_depth = 0;
    }
    CHECK(StrategySet(options).count(1, 1) == 1.0f);
}

TEST_CASE("strategies that are disabled take no samples", "[strategies]")
{
    RenderOptions options = bidirectional();
    options.bidirectional.disabled = {{.s = 1, .t = 1}};
    CHECK(StrategySet(options).count(1, 1) == 0.0f);
    CHECK_FALSE(StrategySet(options).uses(1, 1));
    CHECK(StrategySet(options).uses(0, 2));
}

TEST_CASE("the longest subpaths are those that a strategy uses", "[strategies]")
{
    RenderOptions options = bidirectional();
    options.transport.max_depth = 5;
    CHECK(StrategySet(options).camera_vertices() == 6);
    CHECK(StrategySet(options).light_vertices() == 5);
    CHECK(StrategySet(options).uses(0, 6));
    CHECK_FALSE(StrategySet(options).uses(0, 7));
    CHECK_FALSE(StrategySet(options).uses(0, 1));

    options.bidirectional.disabled = {{.s = 0, .t = 6}, {.s = 1, .t = 5}, {.s = 5, .t = 1}};
    CHECK(StrategySet(options).camera_vertices() == 5);
    CHECK(StrategySet(options).light_vertices() == 5);  // (6, 0): the lens is no vertex of the walk
    options.bidirectional.disabled.push_back({.s = 6, .t = 0});
    CHECK(StrategySet(options).light_vertices() == 4);
    options.bidirectional.max_camera_depth = 2;
    options.bidirectional.max_light_depth = 1;
    CHECK(StrategySet(options).camera_vertices() == 3);
    CHECK(StrategySet(options).light_vertices() == 2);

    options = bidirectional();
    options.transport.max_depth = 5;
    options.integrator = IntegratorKind::lt;
    CHECK(StrategySet(options).camera_vertices() == 1);
    CHECK(StrategySet(options).light_vertices() == 5);
}

TEST_CASE("the strategies of very long paths need little memory and time", "[strategies]")
{
    RenderOptions options = bidirectional();
    options.transport.max_depth = 1'000'000;  // a table of all strategies had 4 TB
    const StrategySet strategies(options);
    CHECK(strategies.camera_vertices() == 1'000'001);
    CHECK(strategies.light_vertices() == 1'000'000);
    CHECK(strategies.count(400'000, 500'000) == static_cast<float>(strategies.connections()));
}

}  // namespace bdpt::test::strategy_set_test
