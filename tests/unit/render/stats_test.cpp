#include <bdpt/render.h>

#include "catch.hpp"
#include "furnace.h"
#include "scene_builder.h"

#include <cmath>

namespace bdpt::stats_test {
namespace {

constexpr std::uint64_t samples = 4;
constexpr std::uint64_t pixels = 20 * 10;
constexpr std::uint64_t camera_paths = samples * pixels;

RenderOptions options(IntegratorKind integrator, int max_depth)
{
    RenderOptions result;
    result.integrator = integrator;
    result.film.width = 20;
    result.film.height = 10;
    result.sampling.samples = {.begin = 0, .end = samples};
    result.transport.max_depth = max_depth;
    return result;
}

RenderStats stats_of(const Scene& scene, const RenderOptions& options)
{
    return render(scene, test::room_camera(), options).stats;
}

/// A floor that fills the view of a camera that looks down, under a point light.
SceneDesc floor_and_light()
{
    test::SceneBuilder builder;
    builder.quad({-100, -1, 100}, {100, -1, 100}, {100, -1, -100}, {-100, -1, -100},
                 test::lambertian(Rgb(0.5f)));
    builder.light(PointLightDesc{.position = {0.0f, 3.0f, 0.0f}});
    return builder.desc;
}

const CameraDesc from_above = [] {
    CameraDesc camera;
    camera.world_from_camera =
        glm::rotate(Mat4(1.0f), -1.5707963f, Vec3(1.0f, 0.0f, 0.0f));  // at the origin
    return camera;
}();

}  // namespace

TEST_CASE("roulette compares camera paths with what the first surface leaves", "[stats]")
{
    // All surfaces keep a: the second of them ends none but the part 1 - a of the walks, however
    // dark the first one has made the pixel.
    constexpr float a = 0.1f;
    const Scene scene = test::furnace_sphere(Rgb(1.0f), Rgb(a));
    const auto camera = test::camera_at({0.1f, 0.0f, 0.3f}, {0.0f, 0.1f, -1.0f}, 0.9f);
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::bdpt}) {
        RenderOptions o = options(kind, 4);
        o.transport.rr_start = 2;
        o.sampling.samples = {.begin = 0, .end = 64};
        const RenderStats stats = render(scene, camera, o).stats;
        const double rays =
            static_cast<double>(stats.rays.camera) / static_cast<double>(stats.paths.camera);
        INFO("integrator " << static_cast<int>(kind));
        CHECK(rays == Approx(2.0 + a + a * a).epsilon(0.01));
    }
}

TEST_CASE("rays and paths are counted by kind", "[stats]")
{
    const Scene scene(floor_and_light());
    const auto count = [&](IntegratorKind kind, int max_depth, AovSet aovs = {}) {
        RenderOptions o = options(kind, max_depth);
        o.film.aovs = aovs;
        return render(scene, from_above, o).stats;
    };
    SECTION("paths of one edge see lights only")
    {
        const RenderStats stats = count(IntegratorKind::mis, 1);
        CHECK(stats.rays == RayCounts{.camera = camera_paths, .light = 0, .shadow = 0, .aov = 0});
        CHECK(stats.paths == PathCounts{.camera = camera_paths, .light = 0});
        CHECK(stats.rays.total() == camera_paths);
    }
    SECTION("direct light takes a shadow ray and, to look for lamps, another camera ray")
    {
        for (const auto kind : {IntegratorKind::mis, IntegratorKind::pt}) {
            CHECK(count(kind, 2).rays ==
                  RayCounts{
                      .camera = 2 * camera_paths, .light = 0, .shadow = camera_paths, .aov = 0});
        }
    }
    SECTION("bidirectional paths take light rays too")
    {
        const RenderStats stats = count(IntegratorKind::bdpt, 2);
        CHECK(stats.paths == PathCounts{.camera = camera_paths, .light = camera_paths});
        CHECK(stats.rays.camera == 2 * camera_paths);
        CHECK(stats.rays.light == camera_paths);
        // s = 1 from each point that the camera sees; t = 1 from what light hits in the view.
        CHECK(stats.rays.shadow > camera_paths);
        CHECK(stats.rays.shadow < 2 * camera_paths);
    }
    SECTION("AOVs of surfaces take a ray a sample")
    {
        CHECK(count(IntegratorKind::pt, 1, {Aov::depth, Aov::normal}).rays.aov == camera_paths);
        CHECK(count(IntegratorKind::pt, 1, {Aov::variance, Aov::sample_count}).rays.aov == 0);
    }
}

TEST_CASE("counts do not depend on threads and tiles", "[stats][purity]")
{
    test::SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.7f)), test::plastic(Rgb(0.6f), 0.3f));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    builder.sphere({0.4f, -0.7f, 0.4f}, 0.3f, test::glass(0.0f), 16);
    const Scene scene(builder.desc);
    for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::mis}) {
        RenderOptions o = options(kind, 6);
        o.system.threads = 1;
        const RenderStats expected = stats_of(scene, o);
        CHECK(expected.rays.shadow > 0);
        o.system.threads = 8;
        o.system.tile_size = 3;
        CHECK(stats_of(scene, o) == expected);
    }
}

TEST_CASE("a crop takes the camera rays of its pixels and the light rays of the image", "[stats]")
{
    const Scene scene(floor_and_light());
    RenderOptions o = options(IntegratorKind::bdpt, 2);
    const RenderStats whole = render(scene, from_above, o).stats;
    o.film.crop = PixelRect{3, 2, 8, 6};
    const RenderStats crop = render(scene, from_above, o).stats;
    CHECK(crop.paths == PathCounts{.camera = samples * 20, .light = camera_paths});
    CHECK(crop.rays.camera == 2 * samples * 20);
    CHECK(crop.rays.light == whole.rays.light);
    CHECK(crop.rays.shadow < whole.rays.shadow);
    o.integrator = IntegratorKind::mis;
    CHECK(render(scene, from_above, o).stats.paths ==
          PathCounts{.camera = samples * 20, .light = 0});
}

}  // namespace bdpt::stats_test
