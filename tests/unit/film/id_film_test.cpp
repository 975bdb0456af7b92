#include <bdpt/film/id_film.h>

#include <bdpt/error.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "catch.hpp"

namespace bdpt::id_film_test {
namespace {

constexpr PixelRect region{.x0 = 2, .y0 = 1, .x1 = 5, .y1 = 3};
constexpr AovSet both{Aov::object, Aov::material};

/// "n0" to "n9" of each kind.
IdNames names()
{
    IdNames result;
    for (std::vector<NamedId>& list : result) {
        for (int i = 0; i < 10; ++i) {
            const std::string name = "n" + std::to_string(i);
            list.push_back({.name = name, .id = name_id(name)});
        }
    }
    return result;
}

NameId id(int i)
{
    return names()[0][static_cast<std::size_t>(i)].id;
}

IdFilm film()
{
    return {region, both, names()};
}

Film samples(std::int64_t count)
{
    Film result({.width = 8, .height = 8, .region = region});
    result.count_samples(0, count);
    return result;
}

/// Object i met `counts[i]` times by one pixel, in chunks of any order.
void meet(IdFilm& film, int x, int y, const std::vector<int>& counts, unsigned seed)
{
    std::vector<SurfaceIds> met;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        met.insert(met.end(), static_cast<std::size_t>(counts[i]),
                   {.object = id(static_cast<int>(i)), .material = id(9)});
    }
    std::mt19937 engine(seed);
    std::shuffle(met.begin(), met.end(), engine);
    for (std::size_t begin = 0; begin < met.size(); begin += 3) {
        const std::size_t end = std::min(begin + 3, met.size());
        film.add(x, y, {met.data() + begin, end - begin});
    }
}

struct Level {
    NameId id;
    float share;
    [[nodiscard]] bool operator==(const Level&) const = default;
};

Level level(const std::vector<Layer>& layers, std::size_t rank, std::size_t pixel)
{
    const Layer& layer = layers.at(rank / 2);
    const float* values = layer.values.data() + 4 * pixel + 2 * (rank % 2);
    return {.id = std::bit_cast<NameId>(values[0]), .share = values[1]};
}

TEST_CASE("layers have ids by their share, the lesser id first where shares are equal", "[ids]")
{
    IdFilm ids = film();
    meet(ids, 3, 2, {2, 5, 1, 2, 3, 1, 1, 1}, 4);  // 16 of 32 samples; the rest met nothing
    const std::vector<Layer> layers = ids.develop(samples(32));
    REQUIRE(layers.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(layers[i].name ==
              (i < 3 ? "CryptoObject0" : "CryptoMaterial0") + std::to_string(i % 3));
        CHECK(layers[i].channels == "rgba");
        CHECK(layers[i].width == 3);
        CHECK(layers[i].values.size() == 24);
    }
    constexpr std::size_t pixel = 3 + 1;  // (3, 2) is in the second row and column
    std::vector<NameId> twice{id(0), id(3)};
    std::vector<NameId> once{id(2), id(5), id(6), id(7)};
    std::sort(twice.begin(), twice.end());
    std::sort(once.begin(), once.end());
    const std::vector<Level> expected{{id(1), 5 / 32.0f},    {id(4), 3 / 32.0f},
                                      {twice[0], 2 / 32.0f}, {twice[1], 2 / 32.0f},
                                      {once[0], 1 / 32.0f},  {once[1], 1 / 32.0f}};
    for (std::size_t rank = 0; rank < 6; ++rank) {
        CAPTURE(rank);
        CHECK(level(layers, rank, pixel) == expected[rank]);
        CHECK(level(layers, rank, 0) == Level{NameId::none, 0.0f});
    }
    const std::vector<Layer> materials(layers.begin() + 3, layers.end());
    CHECK(level(materials, 0, pixel) == Level{id(9), 0.5f});
    CHECK(level(materials, 1, pixel) == Level{NameId::none, 0.0f});
}

TEST_CASE("counts depend neither on the order of rays nor on how films are split", "[ids]")
{
    IdFilm whole = film();
    meet(whole, 2, 1, {4, 3, 2, 1, 0, 6}, 1);
    IdFilm again = film();
    meet(again, 2, 1, {4, 3, 2, 1, 0, 6}, 2);
    CHECK(again == whole);
    IdFilm a = film();
    IdFilm b = film();
    IdFilm c = film();
    meet(a, 2, 1, {4, 0, 1}, 3);
    meet(b, 2, 1, {0, 2, 0, 1}, 4);
    meet(c, 2, 1, {0, 1, 1, 0, 0, 6}, 5);
    IdFilm forth = a;
    forth.merge(b);
    CHECK_FALSE(forth == whole);
    forth.merge(c);
    IdFilm back = c;
    back.merge(b);
    back.merge(a);
    CHECK(forth == whole);
    CHECK(back == whole);
    CHECK(forth.ranks() == IdRanks{5, 1});
}

TEST_CASE("masks have the name that most rays of a pixel hit, or nothing", "[ids]")
{
    IdFilm ids = film();
    meet(ids, 2, 1, {0, 0, 3, 0, 4, 1}, 1);  // 8 of 8 hit something
    meet(ids, 3, 1, {0, 0, 3, 0, 1}, 2);     // 4 missed
    meet(ids, 4, 1, {0, 0, 0, 5}, 3);        // 3 missed
    meet(ids, 2, 2, {0, 0, 0, 4}, 4);        // 4 missed, 4 hit
    meet(ids, 3, 2, {0, 3, 2, 0, 0, 3}, 5);  // two names with the same number
    CHECK(ids.mask(IdKind::object, samples(8)) == std::vector<std::uint32_t>{5, 0, 4, 0, 2, 0});
    CHECK(ids.mask(IdKind::material, samples(8)) ==
          std::vector<std::uint32_t>{10, 0, 10, 0, 10, 0});
    CHECK(ids.mask(IdKind::instance, samples(8)).empty());  // not asked for
    CHECK_THROWS_AS(
        ids.mask(IdKind::object, Film({.width = 8, .height = 8, .region = {0, 0, 2, 2}})), Error);
}

TEST_CASE("ids of other regions, kinds or names are not merged", "[ids]")
{
    IdFilm ids = film();
    CHECK_NOTHROW(ids.merge(film()));
    CHECK_THROWS_AS(ids.merge(IdFilm({0, 0, 3, 2}, both, names())), Error);
    CHECK_THROWS_AS(ids.merge(IdFilm(region, {Aov::object}, names())), Error);
    CHECK_THROWS_AS(ids.merge(IdFilm(region, both, {})), Error);
    CHECK_THROWS_AS(ids.develop(Film({.width = 8, .height = 8, .region = {0, 0, 2, 2}})), Error);
}

TEST_CASE("what was not asked for is not counted", "[ids]")
{
    IdFilm none(region, {Aov::alpha, Aov::depth}, {});
    CHECK_FALSE(none.needs_hits());
    meet(none, 2, 1, {3}, 1);
    CHECK(none.develop(samples(4)).empty());
    CHECK(none.manifests().empty());
    IdFilm materials(region, {Aov::material}, names());
    CHECK(materials.needs_hits());
    meet(materials, 2, 1, {3}, 1);
    CHECK(materials.ranks() == IdRanks{0, 1});
    REQUIRE(materials.manifests().size() == 1);
    CHECK(materials.manifests()[0].layer == "CryptoMaterial");
    CHECK(materials.develop(samples(4)).front().name == "CryptoMaterial00");
}

using Words = ExactSum::Words;

/// Planes of one row, of four pixels each here three, as a file would have them.
std::vector<Words> planes_of(const IdFilm& film, IdKind kind, int row)
{
    const std::size_t ranks = film.ranks()[static_cast<std::size_t>(kind)];
    std::vector<Words> planes(3 * ranks);
    for (std::size_t rank = 0; rank < ranks; ++rank) {
        film.read_row(kind, rank, row, {planes.data() + 3 * rank, 3});
    }
    return planes;
}

TEST_CASE("planes hold all ids, and add to those that are there", "[ids]")
{
    IdFilm a = film();
    meet(a, 2, 1, {4, 3, 2, 1, 1, 1, 1, 1, 1}, 1);
    meet(a, 4, 1, {0, 1}, 1);
    meet(a, 3, 2, {0, 0, 8}, 1);
    IdFilm b = film();
    meet(b, 2, 1, {0, 1, 7}, 2);
    meet(b, 3, 1, {5}, 2);
    IdFilm both_films = a;
    both_films.merge(b);
    IdFilm read = film();
    for (const IdFilm* from : {&a, &b}) {
        for (const IdKind kind : id_kinds) {
            for (int row = 0; row < 2; ++row) {
                read.add_row(kind, row, planes_of(*from, kind, row), 15);
            }
        }
    }
    CHECK(read == both_films);
}

TEST_CASE("planes that no film has are refused", "[ids]")
{
    IdFilm ids = film();
    meet(ids, 2, 1, {4, 3, 2}, 1);
    const std::vector<Words> planes = planes_of(ids, IdKind::object, 0);
    const auto message = [&](const std::function<void(std::vector<Words>&)>& change,
                             std::int64_t samples = 9) {
        std::vector<Words> changed = planes;
        change(changed);
        IdFilm into = film();
        try {
            into.add_row(IdKind::object, 0, changed, samples);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::invalid_input);
            return std::string(error.what());
        }
        return std::string("none");
    };
    // Pixel 0 of the ranks 0, 1 and 2 is at 0, 3 and 6.
    CHECK(message([](auto&) {}) == "none");
    CHECK(message([](auto&) {}, 8).find("with more than") != std::string::npos);
    CHECK(message([](auto& p) { p[6].low = 0; }).find("without hits") != std::string::npos);
    CHECK(message([](auto& p) { p[6].low = ~std::uint64_t{0}; }).find("with more than") !=
          std::string::npos);
    CHECK(message([](auto& p) { std::swap(p[0], p[3]); }).find("order") != std::string::npos);
    CHECK(message([](auto& p) { p[3] = p[0]; }).find("ascending order") != std::string::npos);
    CHECK(message([](auto& p) { p[3] = {}; }).find("order") != std::string::npos);
    CHECK(message([](auto& p) { p[6].high += 1; }).find("without a name") != std::string::npos);
    CHECK(message([](auto& p) { p[6].high += std::uint64_t{1} << 32; }).find("without a name") !=
          std::string::npos);
    CHECK(message([](auto& p) { p[6].high = 0; }) != "none");
}

}  // namespace
}  // namespace bdpt::id_film_test
