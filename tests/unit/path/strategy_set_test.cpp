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

}  // namespace bdpt::test::strategy_set_test
