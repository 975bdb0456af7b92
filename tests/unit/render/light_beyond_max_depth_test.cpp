// How much light a limit of the length of paths leaves out, against closed forms.

#include "catch.hpp"
#include "furnace.h"
#include "scene_builder.h"

#include <bdpt/render.h>

#include <cmath>

namespace bdpt::test::light_beyond_max_depth_test {
namespace {

RenderOptions small(int max_depth)
{
    RenderOptions options;
    options.film.width = 48;
    options.film.height = 32;
    options.transport.max_depth = max_depth;
    return options;
}

const CameraDesc inside = camera_at({0.1f, 0.0f, 0.3f}, {0.0f, 0.1f, -1.0f}, 0.9f);

}  // namespace

TEST_CASE("a limit of k edges leaves a^(k-1) of reflected light out in a furnace", "[depth]")
{
    // Paths of n edges bring a^(n-1); those of one are not reflected.
    const float a = GENERATE(0.5f, 0.8f);
    const Scene scene = furnace_sphere(Rgb(1.0f), Rgb(a));
    for (const int k : {2, 4, 8}) {
        CAPTURE(a, k);
        const double share = light_beyond_max_depth(scene, inside, small(k));
        const double expected = std::pow(static_cast<double>(a), k - 1);
        CHECK(share == Approx(expected).epsilon(0.1));
    }
}

TEST_CASE("the default length of paths leaves nothing out, nor do limits without effect", "[depth]")
{
    const Scene furnace = furnace_sphere(Rgb(1.0f), Rgb(0.8f));
    CHECK(light_beyond_max_depth(furnace, inside, RenderOptions{}) == 0.0);
    // Nothing is reflected twice before an open sky by a single plane.
    SceneBuilder builder;
    builder.quad({-1, -1, -2}, {1, -1, -2}, {1, 1, -2}, {-1, 1, -2}, lambertian(Rgb(0.8f)));
    builder.light(PointLightDesc{.position = {0.3f, 0, 1}, .intensity = Rgb(1.0f)});
    const Scene open(builder.desc);
    const CameraDesc camera = camera_at({0, 0, 1}, {0, 0, -1}, 0.9f);
    CHECK(light_beyond_max_depth(open, camera, small(2)) == 0.0);
    CHECK(light_beyond_max_depth(open, camera, small(1)) == 1.0);
}

TEST_CASE("the light beyond a limit does not depend on threads, seeds or samples", "[depth]")
{
    const Scene scene = furnace_sphere(Rgb(1.0f), Rgb(0.7f));
    const double share = light_beyond_max_depth(scene, inside, small(3));
    RenderOptions other = small(3);
    other.system.threads = 3;
    other.sampling.seed = 5;
    other.sampling.samples = {.begin = 7, .end = 9};
    other.integrator = IntegratorKind::pt;
    CHECK(light_beyond_max_depth(scene, inside, other) == share);
}

}  // namespace bdpt::test::light_beyond_max_depth_test
