#include "metrics/metric_parts.h"

#include "catch.hpp"

namespace bdpt::eval::convolution_test {
namespace {

Plane plane_of(int width, int height, const std::vector<float>& values)
{
    Plane plane(width, height);
    plane.values = values;
    return plane;
}

const Kernel one{1.0f};

TEST_CASE("rows and columns are correlated with their own kernel")
{
    // A kernel that is not symmetric: each pixel takes its right neighbour twice, its left thrice.
    const Kernel kernel{3.0f, 0.0f, 2.0f};
    const std::vector<float> values{1, 10, 100, 1000};
    // The border repeats: left of 1 is 1, right of 1000 is 1000.
    const std::vector<float> expected{23, 203, 2030, 2300};
    CHECK(convolve(plane_of(4, 1, values), kernel, one).values == expected);
    CHECK(convolve(plane_of(1, 4, values), one, kernel).values == expected);
}

TEST_CASE("a point becomes the product of both kernels")
{
    std::vector<float> values(25, 0.0f);
    values[12] = 1.0f;
    const Plane result =
        convolve(plane_of(5, 5, values), {1.0f, 2.0f, 4.0f}, {1.0f, 10.0f, 100.0f});
    // Correlation turns kernels around.
    CHECK(result.row(1)[1] == 400.0f);
    CHECK(result.row(1)[3] == 100.0f);
    CHECK(result.row(2)[2] == 20.0f);
    CHECK(result.row(3)[1] == 4.0f);
    CHECK(result.row(0)[2] == 0.0f);
}

TEST_CASE("kernels may be larger than the image")
{
    const Kernel kernel(21, 1.0f / 21.0f);
    const Plane result = convolve(plane_of(2, 1, {5.0f, 5.0f}), kernel, kernel);
    CHECK(result.values[0] == Approx(5.0f));
    CHECK(result.values[1] == Approx(5.0f));
}

}  // namespace
}  // namespace bdpt::eval::convolution_test
