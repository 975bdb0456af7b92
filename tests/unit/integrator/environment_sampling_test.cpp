#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <utility>
#include <vector>

namespace bdpt::environment_sampling_test {
namespace {

using test::SceneBuilder;

/// A room that is open to a sky with a bright spot in it.
Scene open_room()
{
    SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.7f)), test::plastic(Rgb(0.6f), 0.3f));
    builder.sphere({0.3f, -0.5f, 0.0f}, 0.4f, test::metal(Rgb(0.8f), 0.2f), 12);
    Image sky{.width = 8, .height = 4, .pixels = std::vector<Rgb>(32, Rgb(0.5f))};
    sky.pixels[9] = Rgb(20.0f);
    builder.light(EnvironmentLightDesc{.radiance = std::move(sky)});
    return Scene(std::move(builder.desc));
}

RenderOptions options_of(IntegratorKind integrator)
{
    RenderOptions options;
    options.integrator = integrator;
    options.film.width = 12;
    options.film.height = 12;
    options.transport.max_depth = 4;
    options.sampling.samples.end = 4;
    return options;
}

/// Is the image the same to the bit, however environments are sampled?
bool is_always_plain(const Scene& scene, RenderOptions options)
{
    options.sampling.environment = EnvironmentSampling::plain;
    const Film plain = render(scene, test::room_camera(), options).film;
    const auto differs = [&](EnvironmentSampling sampling) {
        options.sampling.environment = sampling;
        return !(plain == render(scene, test::room_camera(), options).film);
    };
    const bool by_compensation = differs(EnvironmentSampling::compensated);
    const bool by_learning = differs(EnvironmentSampling::learned);
    CHECK(by_compensation == by_learning);
    return !by_compensation;
}

}  // namespace

TEST_CASE("environment sampling is compensated only where s = 0 finds the rest", "[integrator]")
{
    const Scene scene = open_room();
    SECTION("with all strategies")
    {
        CHECK_FALSE(is_always_plain(scene, options_of(IntegratorKind::mis)));
        CHECK_FALSE(is_always_plain(scene, options_of(IntegratorKind::bdpt)));
    }
    SECTION("not with light sampling alone, or without any")
    {
        CHECK(is_always_plain(scene, options_of(IntegratorKind::nee)));
        CHECK(is_always_plain(scene, options_of(IntegratorKind::pt)));
        CHECK(is_always_plain(scene, options_of(IntegratorKind::lt)));
    }
    SECTION("not when a strategy is left out that it relies on")
    {
        RenderOptions options = options_of(IntegratorKind::bdpt);
        options.bidirectional.disabled = {{.s = 0, .t = 5}};
        CHECK(is_always_plain(scene, options));
        options.bidirectional.disabled = {{.s = 0, .t = 3}};
        CHECK(is_always_plain(scene, options));
        // Nothing relies on these.
        options.bidirectional.disabled = {{.s = 0, .t = 4}, {.s = 1, .t = 3}, {.s = 2, .t = 2}};
        CHECK_FALSE(is_always_plain(scene, options));
    }
    SECTION("not when camera paths are shorter than what light sampling completes")
    {
        RenderOptions options = options_of(IntegratorKind::bdpt);
        options.bidirectional.max_camera_depth = 3;
        CHECK(is_always_plain(scene, options));
        options.bidirectional.max_camera_depth = 4;
        CHECK_FALSE(is_always_plain(scene, options));
    }
    SECTION("with every length that is measured, whichever is the shortest")
    {
        RenderOptions options = options_of(IntegratorKind::bdpt);
        options.transport.min_depth = 3;
        CHECK_FALSE(is_always_plain(scene, options));
    }
}

}  // namespace bdpt::environment_sampling_test
