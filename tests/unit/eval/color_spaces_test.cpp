#include "metrics/metric_parts.h"

#include <cmath>

#include "catch.hpp"
#include "test_images.h"

namespace bdpt::eval::color_spaces_test {
namespace {

void check_near(Vec3 a, Vec3 b, float tolerance)
{
    CAPTURE(a.x, a.y, a.z, b.x, b.y, b.z);
    CHECK(std::abs(a.x - b.x) <= tolerance);
    CHECK(std::abs(a.y - b.y) <= tolerance);
    CHECK(std::abs(a.z - b.z) <= tolerance);
}

TEST_CASE("white and black have no colour in L*a*b* and in YCxCz")
{
    check_near(lab_from_linear(Rgb(1.0f)), Vec3(100.0f, 0.0f, 0.0f), 2e-4f);
    check_near(lab_from_linear(Rgb(0.0f)), Vec3(0.0f), 1e-5f);
    check_near(opponent_from_linear(Rgb(1.0f)), Vec3(100.0f, 0.0f, 0.0f), 2e-4f);
    check_near(opponent_from_linear(Rgb(0.0f)), Vec3(-16.0f, 0.0f, 0.0f), 1e-5f);
    // Y = 0.184187 is middle grey, L* = 50: ((50 + 16) / 116)^3.
    check_near(lab_from_linear(Rgb(0.184187f)), Vec3(50.0f, 0.0f, 0.0f), 2e-4f);
}

TEST_CASE("the primaries of sRGB have the L*a*b* values of the literature")
{
    check_near(lab_from_linear(Rgb(1.0f, 0.0f, 0.0f)), Vec3(53.24f, 80.09f, 67.20f), 0.06f);
    check_near(lab_from_linear(Rgb(0.0f, 1.0f, 0.0f)), Vec3(87.73f, -86.18f, 83.18f), 0.06f);
    check_near(lab_from_linear(Rgb(0.0f, 0.0f, 1.0f)), Vec3(32.30f, 79.19f, -107.86f), 0.06f);
}

TEST_CASE("colours survive the way there and back")
{
    const Image image = test::random_image(64, 1, 7);
    for (const Rgb& color : image.pixels) {
        check_near(linear_from_opponent(opponent_from_linear(color)), color, 2e-6f);
        check_near(linear_from_lab(lab_from_linear(color)), color, 4e-6f);
    }
    // Also where the curve of L*a*b* is a line.
    check_near(linear_from_lab(lab_from_linear(Rgb(0.001f, 0.004f, 0.0f))),
               Rgb(0.001f, 0.004f, 0.0f), 1e-6f);
}

}  // namespace
}  // namespace bdpt::eval::color_spaces_test
