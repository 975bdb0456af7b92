#include <bdpt/light/studio_environment.h>

#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bdpt::test::studio_environment_test {
namespace {

/// The brightest texel between two columns and rows, given as shares of width and height.
float brightest(const Image& sky, float left, float right, float top, float bottom)
{
    const auto at = [](float share, int side) {
        return static_cast<int>(share * static_cast<float>(side));
    };
    float result = 0.0f;
    for (int y = at(top, sky.height); y < at(bottom, sky.height); ++y) {
        for (int x = at(left, sky.width); x < at(right, sky.width); ++x) {
            result = std::max(result, sky.at(x, y).g);
        }
    }
    return result;
}

}  // namespace

TEST_CASE("the studio is grey, and 1 nit on average", "[studio]")
{
    const Image sky = studio_environment().radiance.to_image();
    double sum = 0.0;
    double weights = 0.0;
    for (int y = 0; y < sky.height; ++y) {
        const double weight = std::sin(std::numbers::pi * (y + 0.5) / sky.height);
        for (int x = 0; x < sky.width; ++x) {
            const Rgb value = sky.at(x, y);
            REQUIRE((value.r == value.g && value.g == value.b && value.r > 0.05f));
            sum += weight * static_cast<double>(value.g);
            weights += weight;
        }
    }
    CHECK(sum / weights == Approx(1.0).epsilon(1e-4));
}

TEST_CASE("the key of the studio is on the left of who sees the front, the fill on the right",
          "[studio]")
{
    // Columns go from +z by -x, which is the left, -z in the middle, and +x back to +z.
    const Image sky = studio_environment().radiance.to_image();
    const float key = brightest(sky, 0.0f, 0.25f, 0.0f, 0.5f);
    const float fill = brightest(sky, 0.65f, 0.85f, 0.3f, 0.6f);
    const float behind = brightest(sky, 0.35f, 0.65f, 0.2f, 0.5f);
    const float wall = sky.at(sky.width / 2, sky.height / 2).g;
    CHECK(key > 2.0f * fill);
    CHECK(fill > 3.0f * wall);
    CHECK((behind > fill && behind < key));
    CHECK(sky.at(0, sky.height - 1).g > 1.5f * wall);  // the floor
}

TEST_CASE("the boxes of the studio have soft edges", "[studio]")
{
    const Image sky = studio_environment().radiance.to_image();
    float steepest = 0.0f;
    for (int y = 20; y < sky.height - 20; ++y) {
        for (int x = 1; x < sky.width; ++x) {
            steepest = std::max(steepest, std::abs(sky.at(x, y).g - sky.at(x - 1, y).g));
        }
    }
    CHECK(steepest < 0.5f * brightest(sky, 0.0f, 1.0f, 0.0f, 1.0f));
    CHECK(steepest > 0.0f);
}

}  // namespace bdpt::test::studio_environment_test
