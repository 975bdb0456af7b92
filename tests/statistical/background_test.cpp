// Without the environment behind, integrators agree all the same: each leaves out the same paths.

#include "catch.hpp"
#include "equal_means.h"
#include "equality_cases.h"
#include "scene_builder.h"

#include <algorithm>
#include <string>

namespace bdpt::test::background_test {
namespace {

RenderOptions hidden(const EqualityCase& test, IntegratorKind integrator, std::uint64_t seed)
{
    RenderOptions result;
    result.integrator = integrator;
    result.transport.max_depth = test.max_depth;
    result.transport.background = Background::none;
    result.sampling.seed = seed;
    return result;
}

}  // namespace

TEST_CASE("all integrators agree: without the background", "[equality][background][long]")
{
    const auto cases = equality_cases();
    const auto found = std::find_if(cases.begin(), cases.end(), [](const EqualityCase& test) {
        return test.name == "environment with a sun";
    });
    REQUIRE(found != cases.end());
    const Scene scene(found->scene);
    const bool has_lens = GENERATE(false, true);
    const CameraDesc camera = has_lens ? with_lens(found->camera, 0.1f, 2.5f) : found->camera;
    const std::uint64_t seed = has_lens ? 470010 : 470000;
    TileMeans mis(scene, camera, hidden(*found, IntegratorKind::mis, seed));
    std::uint64_t next = seed;
    for (const IntegratorKind kind :
         {IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::bdpt, IntegratorKind::lt}) {
        TileMeans other(scene, camera, hidden(*found, kind, ++next));
        const MeanComparison result = compare_means(
            mis, other, {.detectable_bias = found->detectable_bias_of_light_sampling});
        INFO((has_lens ? "lens" : "pinhole")
             << ", mis = " << static_cast<int>(kind) << ": " << result.text());
        CHECK(result.sharp_enough);
        CHECK(result.equal);
    }
}

}  // namespace bdpt::test::background_test
