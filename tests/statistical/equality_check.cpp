#include "equality_check.h"

#include "catch.hpp"

#include <cstdlib>
#include <iostream>

namespace bdpt::test {

RenderOptions options(const EqualityCase& test, IntegratorKind integrator, std::uint64_t seed)
{
    RenderOptions result;
    result.integrator = integrator;
    result.transport.max_depth = test.max_depth;
    result.sampling.seed = seed;
    return result;
}

void check_equal(const EqualityCase& test, const char* what, TileMeans& a, TileMeans& b,
                 std::optional<double> detectable_bias)
{
    const MeanComparison result =
        compare_means(a, b, {.detectable_bias = detectable_bias.value_or(test.detectable_bias)});
    INFO(test.name << ", " << what << ": " << result.text());
    CHECK(result.sharp_enough);
    CHECK(result.equal);
    if (std::getenv("BDPT_TEST_VERBOSE") != nullptr) {
        std::cout << test.name << ", " << what << ": " << result.text() << "\n";
    }
}

}  // namespace bdpt::test
