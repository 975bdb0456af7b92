#include <bdpt/render.h>

#include "catch.hpp"
#include "scene_builder.h"

#include <cstddef>
#include <utility>

namespace bdpt {
namespace {

/// Nothing but fog so thin that one walk of hundreds is scattered in it, beside a lamp that is not seen.
Scene thin_fog()
{
    test::SceneBuilder builder;
    builder.light(PointLightDesc{.position = {0.7f, 0.1f, 0.0f}, .intensity = Rgb(3.0f)});
    builder.desc.fog = MediumDesc{.extinction = Rgb(1e-3f), .albedo = Rgb(1.0f)};
    return Scene(std::move(builder.desc));
}

RenderResult rendered(const Scene& scene, IntegratorKind integrator, int samples)
{
    RenderOptions options;
    options.integrator = integrator;
    options.film = {.width = 8, .height = 8};
    options.sampling.samples.end = samples;
    options.transport.max_depth = 2;
    return render(scene, test::camera_at({0, 0, 3}, {0, 0, 0}, 0.3f), options);
}

}  // namespace

TEST_CASE("a lamp in thin fog has no noise, for points of the fog are chosen for it", "[media]")
{
    const Scene scene = thin_fog();
    const auto kind = GENERATE(IntegratorKind::nee, IntegratorKind::mis);
    const RenderResult few = rendered(scene, kind, 2);
    const RenderResult many = rendered(scene, kind, 256);
    CHECK(few.stats.rays.shadow >= few.stats.paths.camera);
    const Image image = few.film.develop();
    const Image reference = many.film.develop();
    double found = 0.0;
    double expected = 0.0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        found += static_cast<double>(image.pixels[i].g);
        expected += static_cast<double>(reference.pixels[i].g);
    }
    CHECK(expected > 0.0);
    CHECK(found == Approx(expected).epsilon(0.03));
}

}  // namespace bdpt
