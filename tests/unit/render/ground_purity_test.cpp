// The shadow on the ground has the same bits for all integrators, threads, tiles, parts and crops,
// and nothing else changes with it.

#include <bdpt/render.h>

#include "catch.hpp"
#include "ground_views.h"
#include "moving_scenes.h"
#include "purity.h"
#include "scene_builder.h"

#include <cstddef>
#include <vector>

namespace bdpt::test::ground_purity_test {
namespace {

/// Things that move, shine, let some rays pass and refract each colour in its own way, under a sky.
Scene stage()
{
    SceneBuilder builder = moving_stage();
    MaterialDesc prism = glass(0.0f);
    prism.dispersion = 1.0f;
    builder.sphere({0.3f, -0.5f, 0.5f}, 0.3f, prism, 12);
    MaterialDesc veil = lambertian(Rgb(0.5f));
    veil.alpha_mode = AlphaMode::blend;
    veil.base_color.w = 0.4f;
    builder.sphere({-0.4f, 0.0f, 0.4f}, 0.4f, veil, 12);
    builder.light(sunny_sky());
    return Scene(builder.desc);
}

const CameraDesc view =
    with_lens(camera_at({0.5f, 2.0f, 5.0f}, {0.0f, -0.5f, 0.0f}, 0.9f), 0.1f, 5.0f);

RenderOptions options(IntegratorKind integrator)
{
    RenderOptions result = ground_options(30, 6);
    result.integrator = integrator;
    result.transport.max_depth = 4;
    result.film.ground_height.reset();
    result.film.filter.kind = FilterKind::tent;
    return result;
}

}  // namespace

TEST_CASE("the shadow on the ground is pure, and the same for every integrator", "[purity][ground]")
{
    const Scene scene = stage();
    RenderOptions o = options(IntegratorKind::pt);
    o.system.threads = 1;
    const RenderResult whole = render(scene, view, o);
    const Shadow expected = compute_shadow(whole);
    REQUIRE(compute_mean(expected.opacity) > 0.02);
    o.system.threads = 8;
    o.system.tile_size = 5;
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::mis,
                            IntegratorKind::bdpt, IntegratorKind::lt, IntegratorKind::vcm}) {
        o.integrator = kind;
        CHECK(render(scene, view, o).aovs == whole.aovs);
    }
    o = options(IntegratorKind::pt);
    o.sampling.samples = {.begin = 2, .end = 6};
    RenderResult parts = render(scene, view, o);
    CHECK_FALSE(parts.aovs == whole.aovs);
    o.sampling.samples = {.begin = 0, .end = 2};
    const RenderResult first = render(scene, view, o);
    parts.aovs.merge(first.aovs);
    parts.stats += first.stats;
    CHECK(parts.aovs == whole.aovs);
    CHECK(parts.stats == whole.stats);

    o = options(IntegratorKind::pt);
    o.film.crop = PixelRect{7, 4, 28, 25};
    const Shadow part = compute_shadow(render(scene, view, o));
    const auto cut = [&](const std::vector<float>& values) {
        std::vector<float> result;
        for (int y = o.film.crop->y0; y < o.film.crop->y1; ++y) {
            const auto row = values.begin() + 30 * y;
            result.insert(result.end(), row + o.film.crop->x0, row + o.film.crop->x1);
        }
        return result;
    };
    CHECK(part.opacity == cut(expected.opacity));
    CHECK(part.alpha == cut(expected.alpha));

    o = options(IntegratorKind::pt);
    o.sampling.seed = 1;
    CHECK_FALSE(render(scene, view, o).aovs == whole.aovs);
}

TEST_CASE("a ground changes no bit of the image, and adds its shadow to alpha", "[purity][ground]")
{
    const Scene scene = stage();
    for (const auto kind : {IntegratorKind::mis, IntegratorKind::bdpt, IntegratorKind::vcm}) {
        RenderOptions o = options(kind);
        const RenderResult with = render(scene, view, o);
        o.film.aovs = {Aov::alpha};
        const RenderResult without = render(scene, view, o);
        CHECK(with.film == without.film);
        const Shadow shadow = compute_shadow(with);
        const std::vector<float> coverage = compute_shadow(without).alpha;
        for (std::size_t i = 0; i < coverage.size(); ++i) {
            REQUIRE(shadow.alpha[i] == Approx(coverage[i] + shadow.opacity[i]).margin(1e-6));
        }
    }
}

TEST_CASE("a shadow alone needs no other layer", "[ground]")
{
    const Scene scene = stage();
    RenderOptions o = options(IntegratorKind::pt);
    const Shadow both = compute_shadow(render(scene, view, o));
    o.film.aovs = {Aov::shadow};
    const RenderResult alone = render(scene, view, o);
    CHECK(alone.aovs.develop(alone.film).size() == 1);
    CHECK(compute_shadow(alone).opacity == both.opacity);
}

}  // namespace bdpt::test::ground_purity_test
