#include "integrator/path/path_integrator.h"

#include "catch.hpp"

#include <limits>
#include <random>

namespace bdpt::light_techniques_test {
namespace {

constexpr LightTechnique techniques[] = {LightTechnique::light_sample, LightTechnique::bsdf_sample,
                                         LightTechnique::fog_sample};

}  // namespace

TEST_CASE("weights of the ways to find a light add up to one", "[mis]")
{
    std::mt19937 engine(5);
    std::lognormal_distribution<float> density(0.0f, 3.0f);
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power, Heuristic::cutoff,
                                      Heuristic::maximum, Heuristic::uniform}) {
        for (int i = 0; i < 1000; ++i) {
            TechniqueDensities densities{};
            for (float& d : densities) {
                d = engine() % 3U == 0 ? 0.0f : density(engine);
            }
            densities[engine() % 3U] = i % 5 == 0 ? densities[0] : density(engine);  // ties, too
            float sum = 0.0f;
            for (const LightTechnique used : techniques) {
                sum += mis_weight(densities, used, heuristic);
            }
            const bool any = densities[0] + densities[1] + densities[2] > 0.0f;
            REQUIRE(sum == (any ? Approx(1.0f) : Approx(0.0f)));
        }
    }
}

TEST_CASE("weights of the ways to find a light are those of Veach", "[mis]")
{
    const TechniqueDensities densities{1.0f, 3.0f, 0.2f};
    const auto weight = [&](Heuristic heuristic) {
        return mis_weight(densities, LightTechnique::light_sample, heuristic);
    };
    CHECK(weight(Heuristic::balance) == Approx(1.0 / 4.2));
    CHECK(weight(Heuristic::power) == Approx(1.0 / 10.04));
    CHECK(weight(Heuristic::cutoff) == Approx(1.0 / 4.0));
    CHECK(weight(Heuristic::maximum) == 0.0f);
    CHECK(weight(Heuristic::uniform) == Approx(1.0 / 3.0));
}

TEST_CASE("a lamp so small that its density is infinite is found by light samples alone", "[mis]")
{
    const TechniqueDensities densities{std::numeric_limits<float>::infinity(), 2.0f, 0.0f};
    CHECK(mis_weight(densities, LightTechnique::light_sample, Heuristic::power) == 1.0f);
    CHECK(mis_weight(densities, LightTechnique::bsdf_sample, Heuristic::power) == 0.0f);
}

}  // namespace bdpt::light_techniques_test
