// pt = mis = bdpt: the three integrators estimate the same integral by different densities, so a
// wrong density, weight, cosine or factor in any of them makes them differ.

#include "catch.hpp"
#include "equal_means.h"
#include "equality_cases.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace bdpt::test {
namespace {

RenderOptions options(const EqualityCase& test, IntegratorKind integrator, std::uint64_t seed)
{
    RenderOptions result;
    result.integrator = integrator;
    result.max_depth = test.max_depth;
    result.seed = seed;
    return result;
}

void check_equal(const EqualityCase& test, const char* what, TileMeans& a, TileMeans& b)
{
    const MeanComparison result = compare_means(a, b, {.detectable_bias = test.detectable_bias});
    INFO(test.name << ", " << what << ": " << result.text());
    CHECK(result.sharp_enough);
    CHECK(result.equal);
    if (std::getenv("BDPT_TEST_VERBOSE") != nullptr) {
        std::cout << test.name << ", " << what << ": " << result.text() << "\n";
    }
}

/// `first_seed`: cases do not share random numbers, or one unlucky draw would be seen in all.
void check_case(const EqualityCase& test, std::uint64_t first_seed)
{
    const Scene scene(test.scene);
    TileMeans pt(scene, test.camera, options(test, IntegratorKind::pt, first_seed + 1));
    TileMeans mis(scene, test.camera, options(test, IntegratorKind::mis, first_seed + 2));
    TileMeans bdpt(scene, test.camera, options(test, IntegratorKind::bdpt, first_seed + 3));
    check_equal(test, "pt = mis", pt, mis);
    check_equal(test, "mis = bdpt", mis, bdpt);
    RenderOptions balance = options(test, IntegratorKind::bdpt, first_seed + 4);
    balance.heuristic = Heuristic::balance;
    TileMeans bdpt_balance(scene, test.camera, balance);
    check_equal(test, "mis = bdpt (balance)", mis, bdpt_balance);
}

/// The same integral by other random numbers.
void check_samplers(const EqualityCase& test, std::uint64_t first_seed)
{
    const Scene scene(test.scene);
    TileMeans reference(scene, test.camera, options(test, IntegratorKind::mis, first_seed + 1));
    TileMeans mis(scene, test.camera, options(test, IntegratorKind::mis, first_seed + 2),
                  SamplerKind::sobol);
    TileMeans bdpt(scene, test.camera, options(test, IntegratorKind::bdpt, first_seed + 3),
                   SamplerKind::sobol);
    check_equal(test, "mis: independent = sobol", reference, mis);
    check_equal(test, "mis: independent = bdpt: sobol", reference, bdpt);
}

}  // namespace

TEST_CASE("pt, mis and bdpt agree", "[equality]")
{
    const auto cases = equality_cases();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        DYNAMIC_SECTION(cases[i].name)
        {
            check_case(cases[i], 100 * i);
        }
    }
}

TEST_CASE("Sobol points and independent numbers agree", "[equality]")
{
    const auto cases = equality_cases();
    for (const char* name : {"area light", "all kinds of light", "half transmission"}) {
        DYNAMIC_SECTION(name)
        {
            const auto test = std::find_if(cases.begin(), cases.end(),
                                           [&](const auto& c) { return c.name == name; });
            REQUIRE(test != cases.end());
            check_samplers(*test, 100000);
        }
    }
}

}  // namespace bdpt::test
