#include "geometry/ray_passage.h"

#include "catch.hpp"

#include <cmath>
#include <cstdint>

namespace bdpt::ray_passage_test {
namespace {

/// Opacity by instance; the tint is green.
const AnyHitFilter filter{
    .owner = nullptr,
    .concerns = nullptr,
    .opacity =
        [](const void*, const AnyHit& surface) noexcept {
            return surface.instance == 9 ? 1.0f : surface.instance == 8 ? 0.0f : 0.5f;
        },
    .tint = [](const void*, const AnyHit&) noexcept { return Rgb(0.5f, 1.0f, 0.25f); }};

bool passes(RayPassage& passage, std::uint32_t instance, std::uint32_t triangle, float t = 1.0f)
{
    AnyHit surface;
    surface.instance = instance;
    surface.triangle = triangle;
    return passage.passes(filter, surface, t);
}

}  // namespace

TEST_CASE("a surface counts once, however often it is reported", "[geometry]")
{
    RayPassage expectation(PassageRule::expectation);
    RayPassage tint(PassageRule::tint);
    RayPassage record(PassageRule::record);
    for (RayPassage* passage : {&expectation, &tint, &record}) {
        for (const std::uint32_t triangle : {7U, 6U, 7U, 6U, 6U}) {
            REQUIRE(passes(*passage, 3, triangle));
        }
        REQUIRE(passes(*passage, 4, 7));
    }
    CHECK(tint.factor() == Rgb(0.125f, 1.0f, 0.015625f));
    CHECK(expectation.factor() == 0.125f * tint.factor());
    CHECK(record.factor() == Rgb(1.0f));
    CHECK(record.crossings().size() == 3);
}

TEST_CASE("opaque surfaces stop a ray by each rule but that of tints", "[geometry]")
{
    for (const PassageRule rule :
         {PassageRule::chance, PassageRule::expectation, PassageRule::record}) {
        RayPassage passage(rule);
        CHECK_FALSE(passes(passage, 9, 0));
        CHECK(passage.factor() == Rgb(1.0f));
    }
    RayPassage tint(PassageRule::tint);
    CHECK(passes(tint, 9, 0));
}

TEST_CASE("recorded surfaces are sorted, and end at the hit", "[geometry]")
{
    RayPassage record(PassageRule::record);
    CHECK(passes(record, 1, 0, 3.0f));
    CHECK(passes(record, 2, 0, 7.0f));
    CHECK(passes(record, 3, 0, 1.0f));
    CHECK(passes(record, 4, 0, 2.0f));
    CHECK(passes(record, 8, 0, 2.5f));  // invisible
    record.set_end(5.0f);
    const auto crossings = record.crossings();
    REQUIRE(crossings.size() == 3);
    CHECK(crossings[0].instance == 3);
    CHECK(crossings[1].instance == 4);
    CHECK(crossings[2].instance == 1);
    CHECK(crossings[2].t == 3.0f);
    CHECK(crossings[2].opacity == 0.5f);
    CHECK(record.has_all());
}

TEST_CASE("a record keeps the nearest surfaces, and tells if some are missing", "[geometry]")
{
    const bool backwards = GENERATE(false, true);
    RayPassage record(PassageRule::record);
    for (std::uint32_t i = 0; i < 100; ++i) {
        const std::uint32_t number = backwards ? 99 - i : i;
        CHECK(passes(record, 1, number, static_cast<float>(number)));
    }
    CHECK_FALSE(record.has_all());
    REQUIRE(record.crossings().size() == RayPassage::room);
    for (std::uint32_t i = 0; i < RayPassage::room; ++i) {
        CHECK(record.crossings()[i].triangle == i);
    }
    record.set_end(20.0f);
    CHECK(record.crossings().size() == 20);
    CHECK(record.has_all());
}

TEST_CASE("factors of a ray have the same bits in whatever order surfaces are reported",
          "[geometry]")
{
    const std::uint32_t count = GENERATE(5U, 32U, 33U, 50U);
    const AnyHitFilter tints{.owner = nullptr,
                             .concerns = nullptr,
                             .opacity = [](const void*, const AnyHit&) noexcept { return 0.01f; },
                             .tint =
                                 [](const void*, const AnyHit& surface) noexcept {
                                     const float way = static_cast<float>(surface.triangle) / 50.0f;
                                     return Rgb(1.0f - 0.1f * way, 0.97f,
                                                surface.triangle == 40 ? 0.0f : 1.0f);
                                 }};
    const auto factor = [&](std::uint32_t step) {
        RayPassage passage(PassageRule::expectation);
        for (std::uint32_t i = 0; i < count; ++i) {
            AnyHit surface;
            surface.triangle = i * step % count;
            const float t = 1.0f + 0.1f * static_cast<float>(surface.triangle);
            REQUIRE(passage.passes(tints, surface, t));
        }
        return passage.factor();
    };
    double expected = 1.0;
    for (std::uint32_t i = 0; i < count; ++i) {
        expected *= 0.99 * (1.0 - 0.1 * i / 50.0);
    }
    const Rgb first = factor(1);
    CHECK(first.x == Approx(expected).epsilon(1e-5));
    CHECK(first.y == Approx(std::pow(0.99 * 0.97, count)).epsilon(1e-5));
    if (count > 40) {
        CHECK(first.z == 0.0f);
    } else {
        CHECK(first.z == Approx(std::pow(0.99, count)).epsilon(1e-5));
    }
    for (const std::uint32_t step : {7U, 13U, 17U}) {
        CHECK(factor(step) == first);
    }
}

TEST_CASE("rays that pass by chance tell of tints only where asked", "[geometry]")
{
    RayPassage blind(PassageRule::chance);
    RayPassage looking(PassageRule::chance);
    looking.look_for_tints();
    int passed = 0;
    for (std::uint32_t triangle = 0; triangle < 20; ++triangle) {
        const bool free = passes(looking, 1, triangle);
        passed += free ? 1 : 0;
        CHECK(looking.is_tinted() == (passed > 0));
        CHECK(passes(blind, 1, triangle) == free);
        CHECK_FALSE(blind.is_tinted());
    }
    CHECK(passed > 3);
    CHECK(passed < 17);
}

}  // namespace bdpt::ray_passage_test
