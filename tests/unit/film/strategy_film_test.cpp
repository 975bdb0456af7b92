#include <bdpt/error.h>
#include <bdpt/film/strategy_film.h>

#include "catch.hpp"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace bdpt::strategy_film_test {
namespace {

constexpr PixelRect region{.x0 = 2, .y0 = 3, .x1 = 5, .y1 = 5};
constexpr std::array<Strategy, 3> some{{{.s = 0, .t = 2}, {.s = 2, .t = 1}, {.s = 3, .t = 0}}};

StrategyShare share(float weighted, float unweighted)
{
    return {.weighted = Rgb(weighted), .unweighted = Rgb(unweighted)};
}

}  // namespace

TEST_CASE("strategies have names that sort", "[strategy film]")
{
    CHECK(strategy_name({.s = 2, .t = 3}) == "s02t03");
    CHECK(strategy_name({.s = 10, .t = 0}) == "s10t00");
    CHECK(strategy_name({.s = 0, .t = 123}) == "s00t123");
}

TEST_CASE("images of strategies hold what was added, by strategy and place", "[strategy film]")
{
    StrategyFilm film(region, some);
    CHECK_FALSE(film.empty());
    film.count_samples(3);
    film.count_samples(1);
    film.add({.s = 0, .t = 2}, {2.0f, 3.0f}, share(1.0f, 2.0f));
    film.add({.s = 0, .t = 2}, {2.9f, 3.9f}, share(3.0f, 8.0f));
    film.add({.s = 3, .t = 0}, {4.5f, 4.5f}, {.weighted = {1.0f, 2.0f, 3.0f}, .unweighted = {}});
    // Neither this strategy nor these places have images.
    film.add({.s = 1, .t = 1}, {2.0f, 3.0f}, share(5.0f, 5.0f));
    film.add({.s = 0, .t = 9}, {2.0f, 3.0f}, share(5.0f, 5.0f));
    film.add({.s = 9, .t = 0}, {2.0f, 3.0f}, share(5.0f, 5.0f));
    for (const Vec2 outside : {Vec2(1.9f, 3.0f), Vec2(5.0f, 3.0f), Vec2(2.0f, 2.9f),
                               Vec2(2.0f, 5.0f), Vec2(-1e9f, 1e9f)}) {
        film.add({.s = 2, .t = 1}, outside, share(5.0f, 5.0f));
    }
    const Image weighted = film.weighted({.s = 0, .t = 2});
    REQUIRE(weighted.width == 3);
    REQUIRE(weighted.height == 2);
    CHECK(weighted.at(0, 0) == Rgb(1.0f));
    CHECK(weighted.at(1, 0) == Rgb(0.0f));
    CHECK(film.unweighted({.s = 0, .t = 2}).at(0, 0) == Rgb(2.5f));
    CHECK(film.weighted({.s = 3, .t = 0}).at(2, 1) == Rgb(0.25f, 0.5f, 0.75f));
    CHECK(film.unweighted({.s = 3, .t = 0}).at(2, 1) == Rgb(0.0f));
    for (const Rgb& pixel : film.weighted({.s = 2, .t = 1}).pixels) {
        CHECK(pixel == Rgb(0.0f));
    }
    CHECK_THROWS_AS(film.weighted({.s = 1, .t = 1}), Error);
}

TEST_CASE("what is not a radiance is not in images of strategies", "[strategy film]")
{
    StrategyFilm film(region, some);
    film.count_samples(1);
    const auto nan = std::numeric_limits<float>::quiet_NaN();
    const auto infinity = std::numeric_limits<float>::infinity();
    film.add({.s = 2, .t = 1}, {3.0f, 3.0f}, share(1.0f, infinity));
    film.add({.s = 2, .t = 1}, {3.0f, 3.0f}, share(nan, 2.0f));
    film.add({.s = 2, .t = 1}, {3.0f, 3.0f}, share(-1.0f, -1.0f));
    film.add({.s = 2, .t = 1}, {4.0f, 3.0f}, share(1e30f, 1e30f));
    CHECK(film.weighted({.s = 2, .t = 1}).at(1, 0) == Rgb(1.0f));
    CHECK(film.unweighted({.s = 2, .t = 1}).at(1, 0) == Rgb(2.0f));
    CHECK(film.weighted({.s = 2, .t = 1}).at(2, 0) == Rgb(ExactSum::max_value));
}

TEST_CASE("images of strategies become layers", "[strategy film]")
{
    StrategyFilm film(region, some);
    film.count_samples(2);
    film.add({.s = 2, .t = 1}, {3.0f, 4.0f}, {.weighted = {2, 4, 6}, .unweighted = {8, 10, 12}});
    const std::vector<Layer> layers = film.develop();
    const std::vector<std::string> names{"s00t02", "s00t02.unweighted",
                                         "s02t01", "s02t01.unweighted",
                                         "s03t00", "s03t00.unweighted"};
    REQUIRE(layers.size() == names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        CHECK(layers[i].name == names[i]);
        CHECK(layers[i].channels == "RGB");
        CHECK(layers[i].width == 3);
        CHECK(layers[i].height == 2);
        REQUIRE(layers[i].values.size() == 18);
    }
    const std::size_t pixel = 3 * (1 * 3 + 1);
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(layers[2].values[pixel + c] == static_cast<float>(c + 1));
        CHECK(layers[3].values[pixel + c] == static_cast<float>(c + 4));
    }
    CHECK(StrategyFilm().develop().empty());
}

TEST_CASE("images of strategies are merged exactly", "[strategy film]")
{
    StrategyFilm one(region, some);
    one.count_samples(1);
    one.add({.s = 2, .t = 1}, {3.0f, 4.0f}, share(0.1f, 0.7f));
    StrategyFilm two(region, some);
    two.count_samples(2);
    two.add({.s = 2, .t = 1}, {3.0f, 4.0f}, share(1e6f, 3e-5f));
    StrategyFilm both(region, some);
    both.count_samples(3);
    both.add({.s = 2, .t = 1}, {3.0f, 4.0f}, share(1e6f, 3e-5f));
    both.add({.s = 2, .t = 1}, {3.0f, 4.0f}, share(0.1f, 0.7f));
    CHECK_FALSE(one == both);
    one.merge(two);
    CHECK(one == both);

    CHECK_THROWS_AS(one.merge(StrategyFilm({2, 3, 5, 6}, some)), Error);
    CHECK_THROWS_AS(one.merge(StrategyFilm(region, std::span(some).first(2))), Error);
    CHECK_THROWS_AS(one.merge(StrategyFilm()), Error);
}

}  // namespace bdpt::strategy_film_test
