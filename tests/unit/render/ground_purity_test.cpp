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

TEST_CASE("pixels beside the scene skip rays that find no shadow, and no bit changes",
          "[purity][ground][long]")
{
    SceneBuilder builder;
    builder.quad({-1.0f, 1.0f, 0.6f}, {1.0f, 1.0f, 0.6f}, {1.0f, 1.0f, -0.6f}, {-1.0f, 1.0f, -0.6f},
                 lambertian(Rgb(0.5f)));
    builder.sphere({0.8f, 0.3f, 0.4f}, 0.2f, lambertian(Rgb(0.5f)), 12);
    builder.light(sunny_sky());
    const bool has_lamp = GENERATE(false, true);
    if (has_lamp) {
        builder.light(PointLightDesc{.position = {-0.5f, 1.6f, 0.0f}, .intensity = Rgb(5.0f)});
    }
    const Scene scene(builder.desc);
    const CameraDesc above = in_parallel(camera_above(), 12.0f);
    // The others see the horizon, and the last has the scene to its left. Their axes are those of
    // the world, so that motion rounds no matrix.
    const auto ahead = [](Vec3 from) {
        return camera_at(from, from - Vec3(0.0f, 0.0f, 1.0f), 0.9f);
    };
    for (const CameraDesc& camera : {above, ahead({1.0f, 2.0f, 6.0f}), ahead({5.0f, 2.0f, 6.0f})}) {
        RenderOptions o = options(IntegratorKind::pt);
        o.film.ground_height = 0.0f;
        o.film.aovs = {Aov::alpha, Aov::shadow, Aov::opacity, Aov::depth, Aov::object};
        const RenderResult some = render(scene, camera, o);
        // No pixel of a moving camera is known to be beside the scene.
        CameraDesc moving = camera;
        moving.motion = {camera.world_from_camera};
        const RenderResult all = render(scene, moving, o);
        CHECK(some.aovs == all.aovs);
        CHECK(some.ids == all.ids);
        CHECK(compute_mean(compute_shadow(some).opacity) > 0.0);
        const double ratio =
            static_cast<double>(some.stats.rays.aov) / static_cast<double>(all.stats.rays.aov);
        CAPTURE(has_lamp, ratio);
        CHECK(ratio < 0.85);
    }
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
