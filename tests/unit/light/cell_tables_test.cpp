#include "light/environment/cell_tables.h"

#include "catch.hpp"
#include "chi_square.h"
#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt::cell_tables_test {
namespace {

struct Size {
    std::size_t columns;
    std::size_t rows;
};

/// Some of them zero, among them whole rows, and one that is most of all.
std::vector<float> uneven_weights(Size size, float sun, std::uint64_t seed)
{
    test::Random random(seed);
    std::vector<float> weights;
    for (std::size_t y = 0; y < size.rows; ++y) {
        const bool dark = size.rows > 4 && y % 5 == 3;
        for (std::size_t x = 0; x < size.columns; ++x) {
            const float value = std::pow(10.0f, -4.0f * random.next());
            weights.push_back(dark || random.next() < 0.2f ? 0.0f : value);
        }
    }
    weights[weights.size() / 2] = sun;
    return weights;
}

double sum_of(const std::vector<float>& weights)
{
    double sum = 0.0;
    for (const float weight : weights) {
        sum += static_cast<double>(weight);
    }
    return sum;
}

std::vector<double> probabilities(const CellTables& tables, std::size_t grid, Size size)
{
    std::vector<double> result;
    for (std::uint32_t y = 0; y < size.rows; ++y) {
        for (std::uint32_t x = 0; x < size.columns; ++x) {
            result.push_back(static_cast<double>(tables.probability(grid, x, y)));
        }
    }
    return result;
}

constexpr Size sizes[] = {{1, 1}, {1, 7}, {9, 1}, {16, 16}, {33, 20}, {128, 64}, {1000, 3}};

}  // namespace

TEST_CASE("cell tables: probabilities are those of the weights within the bound that is told",
          "[light][tiles]")
{
    for (const float sun : {1.0f, 1e6f, 1e30f}) {
        CellTables tables;
        std::size_t grid = 0;
        for (const Size size : sizes) {
            const std::vector<float> weights = uneven_weights(size, sun, 3);
            tables.add(weights, size.columns);
            const std::vector<double> found = probabilities(tables, grid++, size);
            const double total = sum_of(weights);
            double all = 0.0;
            for (std::size_t y = 0; y < size.rows; ++y) {
                const auto begin = weights.begin() + static_cast<std::ptrdiff_t>(y * size.columns);
                const std::vector<float> row(begin,
                                             begin + static_cast<std::ptrdiff_t>(size.columns));
                const double of_row = sum_of(row) / total;
                for (std::size_t x = 0; x < size.columns; ++x) {
                    CAPTURE(sun, size.columns, size.rows, x, y);
                    const double probability = found[y * size.columns + x];
                    all += probability;
                    REQUIRE((probability > 0.0) == (row[x] > 0.0f));
                    const double expected = static_cast<double>(row[x]) / total;
                    const double of_cells = static_cast<double>(size.columns) / 65408.0;
                    const double of_rows = static_cast<double>(size.rows) * 0x1p-24;
                    REQUIRE(std::abs(probability - expected) <=
                            (of_row + of_rows) * of_cells + 1.01 * of_rows + 1e-7 * expected);
                }
            }
            CHECK(all == Approx(1.0).epsilon(1e-6));
        }
    }
}

TEST_CASE("cell tables: samples have the probabilities that are told", "[light][tiles]")
{
    constexpr double significance = 1e-4;
    CellTables tables;
    std::size_t grid = 0;
    for (const Size size : sizes) {
        CAPTURE(size.columns, size.rows);
        tables.add(uneven_weights(size, 20.0f, 5), size.columns);
        const std::vector<double> expected = probabilities(tables, grid, size);
        std::vector<double> counts(expected.size(), 0.0);
        std::vector<double> places(16, 0.0);
        test::Random random(6);
        constexpr int samples = 200000;
        for (int i = 0; i < samples; ++i) {
            const CellTables::Cell cell = tables.sample(grid, random.next_2d());
            REQUIRE((cell.column < size.columns && cell.row < size.rows));
            REQUIRE((cell.offset.x >= 0.0f && cell.offset.x < 1.0f));
            REQUIRE((cell.offset.y >= 0.0f && cell.offset.y < 1.0f));
            counts[cell.row * size.columns + cell.column] += 1.0;
            places[static_cast<std::size_t>(4.0f * cell.offset.x) +
                   4 * static_cast<std::size_t>(4.0f * cell.offset.y)] += 1.0;
        }
        const double each = test::sidak(significance, 2 * static_cast<int>(std::size(sizes)));
        CHECK(test::chi_square(places, std::vector<double>(16, 1.0 / 16.0)).p_value > each);
        const test::ChiSquare result = test::chi_square(counts, expected);
        if (result.degrees >= 1) {
            CHECK(result.p_value > each);
        }
        ++grid;
    }
}

TEST_CASE("cell tables: the ends of the unit square lie in cells with weight", "[light][tiles]")
{
    constexpr float below_one = 0x1.fffffep-1f;
    CellTables tables;
    const std::vector<float> weights{0, 0, 0, 0,  //
                                     0, 2, 3, 0,  //
                                     0, 0, 0, 0};
    tables.add(weights, 4);
    const CellTables::Cell first = tables.sample(0, Vec2(0.0f));
    CHECK((first.column == 1 && first.row == 1));
    CHECK(first.offset == Vec2(0.0f));
    const CellTables::Cell last = tables.sample(0, Vec2(below_one));
    CHECK((last.column == 2 && last.row == 1));
    CHECK((last.offset.x > 0.999f && last.offset.y > 0.999f));
    CHECK(tables.probability(0, 1, 1) == Approx(0.4).epsilon(1e-4));
    CHECK(tables.probability(0, 2, 1) == Approx(0.6).epsilon(1e-4));
    CHECK(tables.probability(0, 3, 2) == 0.0f);
}

TEST_CASE("cell tables: even weights stay even", "[light][tiles]")
{
    CellTables tables;
    tables.add(std::vector<float>(std::size_t{128} * 64, 0.3f), 128);
    for (std::uint32_t y = 0; y < 64; ++y) {
        for (std::uint32_t x = 0; x < 128; ++x) {
            REQUIRE(tables.probability(0, x, y) == 0x1p-13f);
        }
    }
}

TEST_CASE("cell tables: two bytes for a cell of a large grid", "[light][tiles]")
{
    const std::vector<float> weights(std::size_t{512} * 512, 1.0f);
    CellTables tables;
    tables.add(weights, 512);
    CHECK(tables.bytes() < std::size_t{512} * 512 * 21 / 10);
}

}  // namespace bdpt::cell_tables_test
