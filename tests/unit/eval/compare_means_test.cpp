#include "verify/verdict.h"

#include "catch.hpp"
#include "statistics.h"
#include "verify/samples.h"

#include <bdpt/eval/statistics.h>

#include <cmath>
#include <cstddef>

namespace bdpt::eval::compare_means_test {

TEST_CASE("means are compared in standard errors")
{
    const MeanComparison test = compare_means({.found = 1.3,
                                               .expected = 1.0,
                                               .sample_variance = 0.008,
                                               .rare_variance = 0.002,
                                               .freedom = 50.0});
    CHECK(test.error == Approx(0.1).epsilon(1e-4));
    CHECK(test.z == Approx(3.0).epsilon(1e-4));
    // The bound is greater than the probability of Student's t.
    CHECK(test.p == Approx(2.0 * std::exp(-4.5)).epsilon(1e-3));
    CHECK(test.p > student_two_sided_p(3.0, 50.0));
    // With few degrees of freedom it is the other way round.
    const MeanComparison few = compare_means({.found = 0.7,
                                              .expected = 1.0,
                                              .sample_variance = 0.01,
                                              .rare_variance = 0.0,
                                              .freedom = 2.0});
    CHECK(few.z == Approx(-3.0).epsilon(1e-4));
    CHECK(few.p == Approx(student_two_sided_p(3.0, 2.0)).epsilon(1e-3));
}

TEST_CASE("nine of ten differences as great as is said are beyond the critical z")
{
    test::Random random(1);
    const auto normal = [&random] {
        const auto u = static_cast<double>(1.0f - random.next());
        return std::sqrt(-2.0 * std::log(u)) *
               std::cos(6.283185307179586 * static_cast<double>(random.next()));
    };
    constexpr double critical = 5.0;
    CHECK(detectable_z(critical, 1e12) == Approx(critical + 1.2816));
    for (const int freedom : {31, 100}) {
        constexpr int runs = 10000;
        int beyond = 0;
        for (int run = 0; run < runs; ++run) {
            const double difference = detectable_z(critical, freedom) + normal();
            double squares = 0.0;
            for (int i = 0; i < freedom; ++i) {
                const double x = normal();
                squares += x * x;
            }
            beyond += difference > critical * std::sqrt(squares / freedom) ? 1 : 0;
        }
        CAPTURE(freedom);
        CHECK(beyond / static_cast<double>(runs) == Approx(0.9).margin(0.012));
    }
}

TEST_CASE("equal means are not compared, and what only one side has differs for sure")
{
    CHECK(compare_means({.found = 2.0, .expected = 2.0}).p == 1.0);
    CHECK(compare_means({.found = 2.0, .expected = 2.0}).z == 0.0);
    const MeanComparison test = compare_means({.found = 1.0, .expected = 0.0, .freedom = 7.0});
    CHECK(test.p == 0.0);
    CHECK(std::isinf(test.z));
}

TEST_CASE("differences below the indifference are none")
{
    CHECK(compare_means({.found = 1.0001, .expected = 1.0, .freedom = 100.0}).p > 0.1);
    CHECK(compare_means({.found = 1.001, .expected = 1.0, .freedom = 100.0}).p < 1e-10);
}

TEST_CASE("degrees of freedom by Welch")
{
    Moments a;
    Moments b;
    for (const double x : {1.0, 2.0, 3.0}) {
        a.add(x);  // variance 1
    }
    for (const double x : {0.0, 0.0, 4.0, 4.0, 2.0}) {
        b.add(x);  // variance 4
    }
    // (1/3 + 4/5)^2 / ((1/3)^2 / 2 + (4/5)^2 / 4)
    CHECK(welch_freedom(a, b) == Approx(5.95876).epsilon(1e-5));
}

TEST_CASE("the critical z has the bound's probability, shared by all tests")
{
    const double z = critical_z(0.01, 20);
    CHECK(2.0 * std::exp(-0.5 * z * z) == Approx(0.0005));
}

TEST_CASE("second moments are told apart by size")
{
    SecondMoment moment;
    moment.add(0.5, 1.0);
    moment.add(100.0, 10.0);
    moment.add(1e30, 100.0);
    moment.add(1.0, 0.0);
    CHECK(moment.above(0.0) == 111.0);
    CHECK(moment.above(0.5) == 111.0);
    CHECK(moment.above(10.0) == 110.0);
    CHECK(moment.above(1000.0) == 100.0);
    SecondMoment sum;
    sum += moment;
    sum += moment;
    CHECK(sum.above(10.0) == 220.0);
}

TEST_CASE("tiles cover the image, and each pixel is in the tile that it is said to be in")
{
    for (const int grid : {1, 3, 5}) {
        const TileGrid tiles(7, 5, grid);
        double pixels = 0.0;
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            const PixelRect& tile = tiles.tiles()[i];
            CHECK(tile.width() > 0);
            CHECK(tile.height() > 0);
            pixels += tiles.pixels(i);
            for (int y = tile.y0; y < tile.y1; ++y) {
                for (int x = tile.x0; x < tile.x1; ++x) {
                    CHECK(tiles.tile_at(Vec2(x, y) + 0.5f) == i);
                }
            }
        }
        CHECK(pixels == 35.0);
    }
    CHECK(TileGrid(8, 8, 2).tile_at(Vec2(8.0f, 8.0f)) == 3);  // rounded up to the border
}

}  // namespace bdpt::eval::compare_means_test
