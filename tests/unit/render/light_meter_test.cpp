// Light that falls in, against closed forms.

#include "catch.hpp"
#include "furnace.h"
#include "scene_builder.h"

#include <bdpt/light/light_meter.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace bdpt::test::light_meter_test {
namespace {

const CameraDesc outside = camera_at({0.5f, 1.5f, 4.0f}, {0, 0, 0}, 0.8f);

EnvironmentLightDesc constant_sky(float radiance)
{
    EnvironmentLightDesc sky;
    sky.radiance = Image{1, 1, {Rgb(radiance)}};
    return sky;
}

double level_of(const SceneBuilder& builder, const CameraDesc& camera = outside)
{
    return light_level(white_cards(Scene(builder.desc), camera));
}

SceneBuilder sphere_under_sky(const MaterialDesc& material, float radiance)
{
    SceneBuilder builder;
    builder.sphere({0, 0, 0}, 1.0f, material).light(constant_sky(radiance));
    return builder;
}

}  // namespace

TEST_CASE("a card on a sphere under an even sky has the sky's radiance, whatever the colour",
          "[light_meter]")
{
    const float radiance = GENERATE(0.01f, 1.0f, 300.0f);
    for (const MaterialDesc& material :
         {lambertian(Rgb(1.0f)), lambertian(Rgb(0.2f)), lambertian(Rgb(0.0f)), glass(0.0f),
          metal(Rgb(0.9f), 0.1f), plastic(Rgb(0.02f), 0.2f)}) {
        const double level = level_of(sphere_under_sky(material, radiance));
        CHECK(level == Approx(static_cast<double>(radiance)).epsilon(0.02));
        REQUIRE(light_exposure(level).has_value());
        CHECK(*light_exposure(level) == Approx(-std::log2(radiance)).margin(0.03));
    }
}

TEST_CASE("a card under a lamp has I / (pi d^2)", "[light_meter]")
{
    SceneBuilder builder;
    builder.quad({-0.1f, 0, 0.1f}, {0.1f, 0, 0.1f}, {0.1f, 0, -0.1f}, {-0.1f, 0, -0.1f},
                 lambertian(Rgb(0.3f)));
    builder.light(PointLightDesc{.position = {0, 2, 0}, .intensity = Rgb(8.0f)});
    const CameraDesc camera = camera_at({0, 1, 1}, {0, 0, 0}, 0.1f);
    CHECK(level_of(builder, camera) == Approx(8.0 / (3.14159265 * 4.0)).epsilon(0.01));
}

TEST_CASE("light that surfaces reflect is metered too", "[light_meter]")
{
    // In a furnace of emission 1 and albedo a radiance is 1 / (1 - a) in all directions.
    const Scene furnace = furnace_sphere(Rgb(1.0f), Rgb(0.6f));
    const CameraDesc inside = camera_at({0.1f, 0.0f, 0.3f}, {0.0f, 0.1f, -1.0f}, 0.9f);
    const std::vector<double> cards = white_cards(furnace, inside);
    double sum = 0.0;
    for (const double card : cards) {
        sum += card;
    }
    CHECK(sum / static_cast<double>(cards.size()) == Approx(2.5).epsilon(0.03));
}

TEST_CASE("cards are the same on any number of threads, and none where nothing is seen",
          "[light_meter]")
{
    const SceneBuilder builder = sphere_under_sky(lambertian(Rgb(0.5f)), 1.0f);
    const Scene scene(builder.desc);
    const std::vector<double> cards = white_cards(scene, outside, {.aspect = 2.0f});
    CHECK(cards.size() > 100);
    CHECK(cards == white_cards(scene, outside, {.aspect = 2.0f, .threads = 3}));
    CHECK(white_cards(scene, camera_at({0, 0, 4}, {0, 0, 8}, 0.8f)).empty());
}

TEST_CASE("cards of few paths have the same mean as those of many, and more noise",
          "[light_meter][long]")
{
    SceneBuilder builder;
    const MaterialDesc wall = lambertian(Rgb(0.7f));
    builder.walls(wall, wall).ceiling(wall).front(wall).lamp(0.98f, 0.3f, Rgb(5.0f));
    const Scene scene(builder.desc);
    const CameraDesc inside = camera_at({0.0f, 0.0f, 0.9f}, {0.0f, 0.0f, -1.0f}, 0.9f);
    const std::vector<double> exact = white_cards(scene, inside, {.paths = 1024});
    const auto mean_and_noise = [&](int paths) {
        const std::vector<double> cards = white_cards(scene, inside, {.paths = paths});
        REQUIRE(cards.size() == exact.size());
        double sum = 0.0;
        double squares = 0.0;
        for (std::size_t i = 0; i < cards.size(); ++i) {
            sum += cards[i];
            squares += (cards[i] - exact[i]) * (cards[i] - exact[i]);
        }
        return std::pair(sum / static_cast<double>(cards.size()), squares);
    };
    const auto [mean_of_2, noise_of_2] = mean_and_noise(2);
    const auto [mean_of_32, noise_of_32] = mean_and_noise(32);
    CHECK(mean_of_2 == Approx(mean_of_32).epsilon(0.05));
    CHECK(noise_of_2 > 8.0 * noise_of_32);
}

TEST_CASE("a number of paths out of range is an error that names it", "[light_meter]")
{
    const Scene scene(sphere_under_sky(lambertian(Rgb(0.5f)), 1.0f).desc);
    CHECK_THROWS_WITH(white_cards(scene, outside, {.paths = 0}),
                      ContainsSubstring("number of paths of a card is 0, not in [1, 1024]"));
    CHECK_THROWS_WITH(white_cards(scene, outside, {.paths = 1025}), ContainsSubstring("1025"));
}

TEST_CASE("the level is that of most of the brighter half", "[light_meter]")
{
    std::vector<double> cards(100, 2.0);
    std::fill_n(cards.begin(), 45, 0.0);  // in nooks
    std::fill_n(cards.rbegin(), 5, 1e6);  // beside a lamp
    CHECK(light_level(cards) == Approx(2.0));
    CHECK(light_level({}) == 0.0);
    CHECK_FALSE(light_exposure(0.0).has_value());
    CHECK(light_exposure(0.25) == 2.0f);
}

}  // namespace bdpt::test::light_meter_test
