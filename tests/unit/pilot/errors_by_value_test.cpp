#include "pilot/pilot_errors.h"

#include "catch.hpp"

#include <limits>

namespace bdpt::test::errors_by_value_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of 10 paths that bring 1000 each, 100 that bring 30, and 1000 that bring 1.
ErrorsByValue three_kinds()
{
    ErrorsByValue errors;
    errors.add(1.0, 1000.0, 1.0);
    errors.add(1000.0, 10.0, 100.0);
    errors.add(30.0, 100.0, 8.0);
    return errors;
}

}  // namespace

TEST_CASE("the errors of the brightest paths are excluded up to their number", "[pilot]")
{
    const ErrorsByValue errors = three_kinds();
    CHECK(errors.without_brightest(0.0, infinity) == Approx(109.0));
    CHECK(errors.without_brightest(5.0, infinity) == Approx(59.0));
    CHECK(errors.without_brightest(10.0, infinity) == Approx(9.0));
    CHECK(errors.without_brightest(35.0, infinity) == Approx(7.0));
    CHECK(errors.without_brightest(610.0, infinity) == Approx(0.5));
    CHECK(errors.without_brightest(1e4, infinity) == 0.0);
}

TEST_CASE("the errors of the brightest paths are excluded up to their light", "[pilot]")
{
    const ErrorsByValue errors = three_kinds();
    CHECK(errors.without_brightest(infinity, 0.0) == Approx(109.0));
    CHECK(errors.without_brightest(infinity, 2500.0) == Approx(84.0));
    CHECK(errors.without_brightest(infinity, 10000.0) == Approx(9.0));
    CHECK(errors.without_brightest(infinity, 11500.0) == Approx(5.0));
    // Whichever limit is reached first, dimmer paths count.
    CHECK(errors.without_brightest(5.0, 10000.0) == Approx(59.0));
    CHECK(errors.without_brightest(1e4, 2500.0) == Approx(84.0));
}

TEST_CASE("paths that a candidate cannot find always count", "[pilot]")
{
    ErrorsByValue errors = three_kinds();
    errors.add(1.0, 0.0, 2.0);
    CHECK(errors.without_brightest(1e4, infinity) == 2.0);
    errors.add(infinity, 0.0, infinity);
    CHECK(errors.without_brightest(1e4, infinity) == infinity);
}

TEST_CASE("errors of two parts add up", "[pilot]")
{
    ErrorsByValue errors = three_kinds();
    errors.add(three_kinds());
    CHECK(errors.without_brightest(0.0, infinity) == Approx(218.0));
    CHECK(errors.without_brightest(10.0, infinity) == Approx(118.0));
    CHECK(errors.without_brightest(infinity, 20000.0) == Approx(18.0));
    // Values that are hardly positive, or very large, are those of the first and last part.
    errors.add(1e-30, 1.0, 1.0);
    errors.add(1e30, 1.0, 3.0);
    CHECK(errors.without_brightest(1.0, infinity) == Approx(219.0));
}

}  // namespace bdpt::test::errors_by_value_test
