#include "pilot/light_pilot.h"

#include "catch.hpp"
#include "scene/light_set.h"
#include "scene/world.h"
#include "scene_builder.h"
#include "statistics.h"

#include <bdpt/scene.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace bdpt::test::light_starts_test {
namespace {

/// Four point lights, of which the last has no power, and a sun.
Scene lights_and_sun()
{
    SceneBuilder builder;
    builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, lambertian(Rgb(0.5f)));
    for (const float intensity : {1.0f, 1.0f, 2.0f, 0.0f}) {
        builder.light(PointLightDesc{.position = {0.0f, 1.0f, 0.0f}, .intensity = Rgb(intensity)});
    }
    builder.light(DirectionalLightDesc{.direction = {0.0f, -1.0f, 0.0f}});
    return Scene(std::move(builder.desc));
}

std::vector<IndirectLight> repeat(std::uint32_t light, float value, std::size_t count)
{
    return std::vector<IndirectLight>(count, {.light = LightId{light}, .value = value});
}

}  // namespace

TEST_CASE("light starts: nothing is learned from nothing", "[pilot]")
{
    const Scene scene = lights_and_sun();
    CHECK_FALSE(learn_starts({}, scene.world().lights()));
    CHECK_FALSE(learn_starts(repeat(1, 0.0f, 20), scene.world().lights()));
}

TEST_CASE("light starts: groups by what was found, with parts by power and for each", "[pilot]")
{
    const Scene scene = lights_and_sun();
    const LightSet& lights = scene.world().lights();
    const auto power = [&](std::uint32_t id) {
        return static_cast<double>(lights.emission_probability(LightId{id}));
    };
    const double lamps = power(0) + power(1) + power(2);
    auto found = repeat(1, 3.0f, 500);
    const auto more = repeat(4, 1.0f, 500);
    found.insert(found.end(), more.begin(), more.end());
    const auto starts = learn_starts(found, lights);
    REQUIRE(starts);
    REQUIRE(starts->size() == 5);
    const std::array expected{
        // A light that was not found: 16 findings for each of the three lights, by power.
        (0.8 * 0.75 + 0.05) * (0.9 * 48.0 / 548.0 + 0.1) * power(0) / lamps + 0.1 * power(0),
        (0.8 * 0.75 + 0.05) *
                (0.9 * (500.0 + 48.0 * power(1) / lamps) / 548.0 + 0.1 * power(1) / lamps) +
            0.1 * power(1),
        (0.8 * 0.75 + 0.05) * (0.9 * 48.0 / 548.0 + 0.1) * power(2) / lamps + 0.1 * power(2),
        0.0,
        0.8 * 0.25 + 0.05 + 0.1 * power(4),
    };
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(i);
        CHECK(starts->probability(i) == Approx(expected[i]).epsilon(1e-5));
    }
    SECTION("a group that was not found keeps its lights in proportion to power")
    {
        const auto of_sun = learn_starts(more, lights);
        REQUIRE(of_sun);
        CHECK(of_sun->probability(0) ==
              Approx(0.05 * power(0) / lamps + 0.1 * power(0)).epsilon(1e-5));
        CHECK(of_sun->probability(2) == Approx(2.0 * of_sun->probability(0)).epsilon(1e-5));
    }
}

TEST_CASE("light starts: light paths choose by the table, among few lights and many", "[pilot]")
{
    const int count = GENERATE(4, 200);
    SceneBuilder builder;
    builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, lambertian(Rgb(0.5f)));
    for (int i = 0; i < count; ++i) {
        builder.light(PointLightDesc{.position = {0.0f, 1.0f, 0.0f}});
    }
    builder.light(DirectionalLightDesc{.direction = {0.0f, -1.0f, 0.0f}});
    const Scene scene(std::move(builder.desc));
    const LightSet& lights = scene.world().lights();
    const auto sun = static_cast<std::uint32_t>(count);
    LearnedLight learned;
    learned.starts = learn_starts(repeat(sun, 1.0f, 500), lights);
    REQUIRE(lights.emission_probability(LightId{sun}) < 0.2f);
    REQUIRE(lights.emission_probability(LightId{sun}, &learned) > 0.8f);
    Random random(4);
    const auto draw = [&random] { return Vec2(random.next(), random.next()); };
    int of_sun = 0;
    constexpr int draws = 4000;
    for (int i = 0; i < draws; ++i) {
        const auto choice = lights.choose_for_emission(draw(), draw, &learned);
        REQUIRE(choice);
        REQUIRE(choice->probability == lights.emission_probability(choice->id, &learned));
        of_sun += choice->id == LightId{sun} ? 1 : 0;
    }
    CHECK(of_sun / static_cast<double>(draws) ==
          Approx(lights.emission_probability(LightId{sun}, &learned)).margin(0.025));
}

}  // namespace bdpt::test::light_starts_test
