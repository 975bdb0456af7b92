// The light meter and the ground take light as integrators do: the ground's test is
// ground_shadow_test.cpp.

#include "catch.hpp"
#include "math/rgb.h"
#include "scene_builder.h"

#include <bdpt/light/light_meter.h>
#include <bdpt/render.h>

#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::test::meter_agreement_test {
namespace {

/// Sees nothing but a part of the floor.
const CameraDesc view = camera_at({0.0f, 2.0f, 2.5f}, {0.0f, 0.0f, 0.0f}, 0.5f);

/// A white floor, which is a card itself, with a red wall beside the view.
SceneBuilder white_floor()
{
    SceneBuilder builder;
    builder.quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}, lambertian(Rgb(1.0f)));
    builder.quad({1.5f, 0, 3}, {1.5f, 0, -3}, {1.5f, 2, -3}, {1.5f, 2, 3},
                 lambertian(Rgb(0.8f, 0.1f, 0.1f)));
    return builder;
}

PointLightDesc lamp()
{
    PointLightDesc lamp;
    lamp.position = {-2.0f, 4.0f, 0.0f};
    lamp.intensity = Rgb(30.0f, 20.0f, 10.0f);
    return lamp;
}

EnvironmentLightDesc uneven_sky()
{
    EnvironmentLightDesc sky;
    sky.radiance = Image{4,
                         2,
                         {Rgb(1.0f), Rgb(8.0f, 4.0f, 2.0f), Rgb(0.5f), Rgb(0.2f), Rgb(0.1f),
                          Rgb(0.1f), Rgb(0.1f), Rgb(0.1f)}};
    return sky;
}

/// Shades, colours or mirrors light on its way to the floor, above the view.
void hang(SceneBuilder& builder, const MaterialDesc& material)
{
    builder.quad({-4, 3, 3}, {4, 3, 3}, {4, 3.2f, -3}, {-4, 3.2f, -3}, material);
}

struct Case {
    std::string name;
    SceneBuilder scene;
};

std::vector<Case> cases()
{
    std::vector<Case> cases;
    const auto add = [&cases](std::string name, SceneBuilder scene) {
        cases.push_back({std::move(name), std::move(scene)});
    };
    SceneBuilder sky = white_floor();
    sky.light(uneven_sky());
    add("sky", sky);
    SceneBuilder lamps = white_floor();
    lamps.light(lamp()).light(
        DirectionalLightDesc{.direction = {0.3f, -1.0f, 0.2f}, .illuminance = Rgb(2.0f)});
    lamps.quad({-1, 5, 1}, {-1, 5, -1}, {1, 5, -1}, {1, 5, 1}, emitter(Rgb(20.0f)));
    add("lamps", lamps);
    MaterialDesc pane = thin_glass(0.0f);
    pane.base_color = {0.9f, 0.5f, 0.2f, 1.0f};
    SceneBuilder tinted = lamps;
    hang(tinted, pane);
    add("tinted pane", tinted);
    MaterialDesc veil = lambertian(Rgb(0.2f, 0.5f, 0.8f));
    veil.alpha_mode = AlphaMode::blend;
    veil.base_color.w = 0.5f;
    SceneBuilder veiled = sky;
    hang(veiled, veil);
    veiled.light(lamp());
    add("veil", veiled);
    return cases;
}

}  // namespace

TEST_CASE("the light meter and mis have the same light", "[equality][light_meter]")
{
    for (const Case& test : cases()) {
        const Scene scene(test.scene.desc);
        const std::vector<double> cards = white_cards(scene, view, {.paths = 512});
        const double metered =
            std::accumulate(cards.begin(), cards.end(), 0.0) / static_cast<double>(cards.size());
        RenderOptions options;
        options.integrator = IntegratorKind::mis;
        options.film.width = 48;
        options.film.height = 48;
        options.sampling.samples = {.begin = 0, .end = 256};
        const Image image = render(scene, view, options).image();
        double seen = 0.0;
        for (const Rgb& pixel : image.pixels) {
            seen +=
                static_cast<double>(luminance(pixel)) / static_cast<double>(image.pixels.size());
        }
        CAPTURE(test.name, metered, seen);
        CHECK(metered == Approx(seen).epsilon(0.01));
    }
}

}  // namespace bdpt::test::meter_agreement_test
