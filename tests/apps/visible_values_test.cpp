// What a denoiser is given where pixels show something in part.

#include "output/image_files.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "catch.hpp"

namespace bdpt::job::visible_values_test {
namespace {

Layer layer(int width, int height, std::vector<float> values, const char* channels = "A")
{
    return {.name = "",
            .channels = channels,
            .width = width,
            .height = height,
            .values = std::move(values)};
}

TEST_CASE("values of a constant colour are that colour, whatever share of pixels shows it")
{
    const int width = 7;
    const int height = 5;
    std::vector<float> shares;
    std::vector<float> sums;
    for (int i = 0; i < width * height; ++i) {
        shares.push_back(i % 3 == 0 ? 0.0f : static_cast<float>(i) / 35.0f);
        sums.insert(sums.end(), {shares.back() * 0.5f, shares.back() * 3.0f});
    }
    const Layer values = visible_values(layer(width, height, sums, "XY"), shares);
    REQUIRE(values.values.size() == sums.size());
    for (std::size_t i = 0; i < values.values.size(); i += 2) {
        CHECK(values.values[i] == Approx(0.5f));
        CHECK(values.values[i + 1] == Approx(3.0f));
    }
}

TEST_CASE("pixels that show anything keep their own value, beside whatever light")
{
    const std::vector<float> shares{1.0f, 0.5f, 0.0625f, 0.0f, 0.0f, 0.0f};
    const Layer values = visible_values(layer(6, 1, {1000.0f, 1.0f, 0.25f, 0, 0, 0}), shares);
    CHECK(values.values[0] == 1000.0f);
    CHECK(values.values[1] == 2.0f);
    CHECK(values.values[2] == 4.0f);
    CHECK(values.values[3] == 4.0f);
    CHECK(values.values[4] == Approx(1001.25f / 1.5625f));
    CHECK(values.values[5] == values.values[4]);
}

TEST_CASE("holes take the values of the pixels beside them, not of those far away")
{
    std::vector<float> shares(64, 1.0f);
    std::vector<float> sums(64, 1.0f);
    for (std::size_t i = 32; i < 64; ++i) {
        sums[i] = 5.0f;
    }
    for (const std::size_t hole : {10U, 11U, 34U, 50U}) {
        shares[hole] = 0.0f;
        sums[hole] = 0.0f;
    }
    const Layer values = visible_values(layer(8, 8, sums), shares);
    CHECK(values.values[10] == Approx(1.0f));
    CHECK(values.values[11] == Approx(1.0f));
    CHECK(values.values[34] == Approx(5.0f));
    CHECK(values.values[50] == Approx(5.0f));
}

TEST_CASE("where nothing is shown at all values are 0")
{
    const Layer values =
        visible_values(layer(3, 2, std::vector<float>(6, 0.0f)), std::vector<float>(6, 0.0f));
    CHECK(values.values == std::vector<float>(6, 0.0f));
}

}  // namespace
}  // namespace bdpt::job::visible_values_test
