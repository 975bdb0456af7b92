// What a pilot knows of light that camera paths find so rarely that its own do not.

#include "catch.hpp"
#include "pilot/pilot.h"
#include "render/view.h"
#include "scene_builder.h"

#include <bdpt/render.h>

#include <cmath>
#include <utility>

namespace bdpt::test::merged_paths_test {
namespace {

constexpr float albedo = 0.5f;
constexpr float radiance = 100.0f;

/// Thin glass that is no clear sheet, as its reflection has a colour: rays do not pass it.
MaterialDesc scattering_pane()
{
    MaterialDesc pane = thin_glass(0.0f);
    pane.specular_color.z = 0.9f;
    return pane;
}

/// A floor that is seen and lit through such a pane: only camera paths that hit the lamp
/// by chance find light.
Scene under_glass(float half_width_of_lamp)
{
    SceneBuilder builder;
    constexpr float w = 3.0f;
    const float h = half_width_of_lamp;
    constexpr float x = 0.8f;  // its reflection is not in view
    builder.quad({-w, -1, w}, {w, -1, w}, {w, -1, -w}, {-w, -1, -w}, lambertian(Rgb(albedo)));
    builder.quad({-w, 0, w}, {w, 0, w}, {w, 0, -w}, {-w, 0, -w}, scattering_pane());
    builder.quad({x - h, 1, -h}, {x + h, 1, -h}, {x + h, 1, h}, {x - h, 1, h},
                 emitter(Rgb(radiance)));
    return Scene(std::move(builder.desc));
}

CameraDesc from_above()
{
    return camera_at({0.0f, 0.7f, 0.0f}, {0.0f, -1.0f, 0.001f}, 0.4f);
}

RenderOptions options_of(int side)
{
    RenderOptions options;
    options.film.width = side;
    options.film.height = side;
    options.sampling.planned_samples = 0;
    options.transport.max_depth = 4;
    options.transport.rr_start = 100;
    return options;
}

PilotMeasurements pilot_of(const Scene& scene)
{
    const RenderOptions options = options_of(256);
    return measure(scene.world(), open_camera(scene.world(), from_above(), options), options);
}

}  // namespace

TEST_CASE("a pilot knows by merging what rare hits of a lamp bring", "[pilot][long]")
{
    const Scene scene = under_glass(0.07f);
    RenderOptions options = options_of(16);
    options.integrator = IntegratorKind::mis;
    options.sampling.samples = {.begin = 0, .end = 4096};
    const Image image = render(scene, from_above(), options).film.develop();
    double mean = 0.0;
    for (const Rgb& pixel : image.pixels) {
        mean += static_cast<double>(pixel.g) / static_cast<double>(image.pixels.size());
    }
    // Each hit brings the same, so relMSE of one sample is one over the probability of one.
    const double hits = mean / static_cast<double>(albedo * radiance);
    CAPTURE(hits);
    CHECK(hits > 0.0001);
    CHECK(hits < 0.002);
    constexpr double with_unseen = 1.2;
    constexpr double noise = 1.25;
    for (const double error : pilot_of(scene).errors) {
        CHECK(error < noise * with_unseen / hits);
        CHECK(error > with_unseen / hits / noise);
    }
}

TEST_CASE("a pilot excludes light that no render of usual length finds", "[pilot]")
{
    // One in a hundred million samples hits it.
    for (const double error : pilot_of(under_glass(0.0003f)).errors) {
        CHECK(error < 1.0);
    }
}

}  // namespace bdpt::test::merged_paths_test
