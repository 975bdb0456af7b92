// The shadow on the ground is what a Lambertian floor shows, lit directly, with things over it and
// without them.

#include <bdpt/render.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "catch.hpp"
#include "ground_views.h"
#include "math/rgb.h"
#include "scene_builder.h"

namespace bdpt::test::ground_shadow_test {
namespace {

constexpr int side = 24;
constexpr int tile = 4;  // [pixels]

struct Case {
    std::string name;
    SceneBuilder lights;
};

SceneBuilder lamps()
{
    SceneBuilder builder;
    for (int i = 0; i < 6; ++i) {
        const auto x = static_cast<float>(i - 3);
        builder.light(PointLightDesc{.position = {x, 2.0f + 0.3f * x, 1.0f - 0.5f * x},
                                     .intensity = Rgb(3.0f, 2.0f, 1.0f)});
    }
    builder.light(SpotLightDesc{.position = {2.0f, 3.0f, 0.0f},
                                .direction = {-0.5f, -1.0f, 0.0f},
                                .intensity = Rgb(20.0f)});
    builder.light(
        DirectionalLightDesc{.direction = {-1.0f, -2.0f, -1.0f}, .illuminance = Rgb(1.0f)});
    return builder;
}

SceneBuilder bulb()
{
    MaterialDesc shining = emitter(Rgb(9.0f));
    shining.double_sided = true;
    SceneBuilder builder;
    builder.sphere({1.2f, 1.6f, -0.5f}, 0.3f, shining, 12);
    return builder;
}

std::vector<Case> cases()
{
    SceneBuilder sky;
    sky.light(sunny_sky());
    SceneBuilder globe;
    globe.light(
        PointLightDesc{.position = {1.0f, 2.0f, 0.5f}, .intensity = Rgb(5.0f), .radius = 0.4f});
    SceneBuilder all = lamps();
    all.light(sunny_sky());
    return {{"sky", sky},
            {"lamps", lamps()},
            {"sky and lamps", all},
            {"globe", globe},
            {"bulb", bulb()}};
}

void add_things(SceneBuilder& builder)
{
    builder.sphere({-0.3f, 0.5f, 0.0f}, 0.5f, lambertian(Rgb(0.5f)), 24);
    MaterialDesc veil = lambertian(Rgb(0.5f));
    veil.alpha_mode = AlphaMode::blend;
    veil.base_color.w = 0.6f;
    builder.quad({0.2f, 0.4f, 0.8f}, {1.2f, 0.4f, 0.8f}, {1.2f, 1.2f, 0.2f}, {0.2f, 1.2f, 0.2f},
                 veil);
}

void add_floor(SceneBuilder& builder)
{
    builder.quad({-40, 0, 40}, {40, 0, 40}, {40, 0, -40}, {-40, 0, -40}, lambertian(Rgb(0.5f)));
}

const CameraDesc view = camera_at({0.5f, 3.0f, 4.0f}, {0.3f, 0.0f, 0.2f}, 0.6f);

Image direct_light(const SceneBuilder& builder)
{
    RenderOptions options = ground_options(side, 256);
    options.integrator = IntegratorKind::mis;
    options.film.aovs = {};
    options.transport.min_depth = 2;
    options.transport.max_depth = 2;
    options.sampling.seed = 17;
    return render(Scene(builder.desc), view, options).film.develop();
}

/// Of a tile, over those pixels that show the ground alone.
struct Sums {
    double bare = 0.0;
    double real = 0.0;
    double predicted = 0.0;
};

}  // namespace

TEST_CASE("the shadow on the ground is that of a floor under direct light", "[ground]")
{
    for (const Case& test : cases()) {
        SceneBuilder things = test.lights;
        add_things(things);
        const Shadow shadow = compute_shadow(things.desc, view, ground_options(side, 256));
        SceneBuilder bare_floor = test.lights;
        add_floor(bare_floor);
        const Image bare = direct_light(bare_floor);
        add_floor(things);
        const Image real = direct_light(things);
        std::vector<Sums> tiles(side / tile * (side / tile));
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const auto i = static_cast<std::size_t>(y * side + x);
                if (shadow.alpha[i] > shadow.opacity[i]) {
                    continue;
                }
                Sums& sums = tiles[static_cast<std::size_t>(y / tile * (side / tile) + x / tile)];
                const auto light = static_cast<double>(luminance(bare.at(x, y)));
                sums.bare += light;
                sums.real += static_cast<double>(luminance(real.at(x, y)));
                sums.predicted += light * (1.0 - static_cast<double>(shadow.opacity[i]));
            }
        }
        double worst = 0.0;
        double mean = 0.0;
        double darkest = 1.0;
        int counted = 0;
        for (const Sums& sums : tiles) {
            if (sums.bare > 0.0) {
                const double difference = (sums.real - sums.predicted) / sums.bare;
                worst = std::max(worst, std::abs(difference));
                mean += difference;
                darkest = std::min(darkest, sums.real / sums.bare);
                ++counted;
            }
        }
        mean /= counted;
        CAPTURE(test.name, worst, mean, darkest, counted);
        CHECK(counted > 25);
        CHECK(darkest < 0.8);  // of some shadow
        CHECK(worst < 0.04);
        CHECK(std::abs(mean) < 0.004);
    }
}

TEST_CASE("a pixel has the mean shadow of the pixels that it could be", "[ground][long]")
{
    // Under an even sky all of the ground gets as much light, so opacities add up. Where a ray
    // meets the ground must not tell which light it looks for.
    SceneBuilder builder;
    builder.place(builder.add_mesh(disk_above(1.0f, 1.0f, 64)), lambertian(Rgb(0.5f)),
                  glm::translate(Mat4(1.0f), Vec3(2.6f, 0.0f, 0.0f)));
    builder.light(even_sky());
    double sum = 0.0;
    constexpr std::uint64_t seeds = 64;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        RenderOptions one = ground_options(1, 8192);
        one.sampling.seed = seed;
        sum += compute_mean(compute_shadow(builder.desc, camera_above(), one).opacity) / seeds;
    }
    const Shadow many = compute_shadow(builder.desc, camera_above(), ground_options(64, 128));
    CHECK(sum == Approx(compute_mean(many.opacity)).epsilon(0.01));
}

}  // namespace bdpt::test::ground_shadow_test
