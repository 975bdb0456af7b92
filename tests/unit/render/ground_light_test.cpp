// What the ground knows of its light before any ray: which directions the scene may block, what the
// sky brings from all others, and how often lamps are worth a sample.

#include "render/ground/ground_light.h"
#include "catch.hpp"
#include "ground_views.h"
#include "math/rgb.h"
#include "moving_scenes.h"
#include "render/ground/ground_occluders.h"
#include "scene/world.h"
#include "scene_builder.h"
#include "statistics.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

namespace bdpt::test::ground_light_test {
namespace {

SceneBuilder table()
{
    SceneBuilder builder;
    builder.quad({-1.0f, 1.0f, 0.6f}, {1.0f, 1.0f, 0.6f}, {1.0f, 1.0f, -0.6f}, {-1.0f, 1.0f, -0.6f},
                 lambertian(Rgb(0.5f)));
    builder.sphere({0.8f, 0.3f, 0.4f}, 0.2f, lambertian(Rgb(0.5f)), 12);
    builder.light(
        PointLightDesc{.position = {-0.5f, 1.6f, 0.0f}, .intensity = Rgb(5.0f), .radius = 0.3f});
    return builder;
}

/// Near the scene for the most part, and up to a hundred times its size away.
Vec3 ground_point(Random& random, float height)
{
    const float reach = std::pow(10.0f, 3.0f * random.next() - 1.0f);
    return {reach * (2.0f * random.next() - 1.0f), height, reach * (2.0f * random.next() - 1.0f)};
}

Vec3 upward(Random& random)
{
    const Vec3 direction = random.direction();
    return {direction.x, std::abs(direction.y), direction.z};
}

const EnvironmentLight& environment(const World& world)
{
    return std::get<EnvironmentLight>(world.lights()[*world.lights().environment()].model());
}

}  // namespace

TEST_CASE("nothing blocks light from where nothing is known to stand", "[ground][long]")
{
    // At its height some things are below the ground or reach through it.
    const auto [builder, height] = GENERATE(std::pair{table(), 0.0f}, std::pair{table(), 0.25f},
                                            std::pair{moving_stage(), -1.5f});
    const World world{SharedSceneDesc(builder.desc)};
    const GroundOccluders occluders(world.geometry(), height);
    Random random(7);
    int blocked = 0;
    int suspected = 0;
    constexpr int rays = 200000;
    for (int i = 0; i < rays; ++i) {
        const Vec3 p = ground_point(random, height);
        // Half of them towards the scene.
        Vec3 direction = upward(random);
        if (random.next() < 0.5f) {
            const Vec3 goal = 1.5f * random.direction() + Vec3(0.0f, height + 0.8f, 0.0f);
            direction = normalize(goal - p);
        }
        if (!(direction.y > 0.0f)) {
            continue;
        }
        SegmentKey segment{static_cast<std::uint64_t>(i)};
        segment.time = random.next();
        const SegmentEnd from{.p = p, .error = 1e-5f, .ng = {0.0f, 1.0f, 0.0f}};
        const bool may = occluders.may_block(occluders.place(p), direction);
        suspected += may ? 1 : 0;
        if (world.first_hit(from, direction, segment)) {
            ++blocked;
            CAPTURE(p.x, p.z, direction.x, direction.y, direction.z, segment.time);
            REQUIRE(may);
        }
    }
    CHECK(blocked > rays / 50);
    CHECK(suspected < 5 * blocked / 2);
}

TEST_CASE("all of the sky's light is open or sampled", "[ground]")
{
    SceneBuilder builder = table();
    EnvironmentLightDesc sky = sunny_sky();
    const bool turned = GENERATE(false, true);
    if (turned) {
        sky.world_from_environment =
            Mat3(glm::rotate(Mat4(1.0f), 0.7f, normalize(Vec3(1.0f, 2.0f, 0.5f))));
    }
    builder.light(sky);
    const World world{SharedSceneDesc(builder.desc)};
    const GroundOccluders occluders(world.geometry(), 0.0f);
    const EnvironmentLight& light = environment(world);
    const GroundSky ground(light, occluders);

    // By itself, from a grid that is much finer than the texels.
    const auto sum_over = [&](const auto& counts) {
        constexpr int rows = 600;
        constexpr int columns = 2400;
        double sum = 0.0;
        for (int y = 0; y < rows; ++y) {
            const double theta = 1.5707963267948966 * (y + 0.5) / rows;
            for (int x = 0; x < columns; ++x) {
                const double phi = 6.283185307179586 * (x + 0.5) / columns;
                const Vec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                             std::sin(theta) * std::cos(phi));
                if (counts(d)) {
                    sum += std::sin(theta) * std::cos(theta) *
                           static_cast<double>(luminance(light.radiance(d)));
                }
            }
        }
        return sum * 1.5707963267948966 / rows * 6.283185307179586 / columns;
    };
    const double all = sum_over([](Vec3) { return true; });
    CHECK(static_cast<double>(ground.irradiance()) == Approx(all).epsilon(1e-4));

    for (const Vec3 p :
         {Vec3(0.1f, 0.0f, 0.2f), Vec3(1.5f, 0.0f, -0.5f), Vec3(-9.0f, 0.0f, 4.0f)}) {
        const std::size_t place = occluders.place(p);
        const GroundSky::Shares shares = ground.shares(place);
        CAPTURE(turned, p.x, p.z, shares.open, shares.exposed);
        CHECK(static_cast<double>(shares.open) + static_cast<double>(shares.exposed) ==
              Approx(all).epsilon(1e-4));
        const auto is_east = [](Vec3 d) { return d.x > 0.3f * d.z; };
        int outside = 0;  // rounding takes few directions over the edge of a strip
        Moments exposed;
        Moments eastern;
        Random random(3);
        for (int i = 0; i < 200000; ++i) {
            const GroundSky::Sample sample = ground.sample(place, random.next_2d());
            outside += occluders.may_block(place, sample.to_light) ? 0 : 1;
            const auto value = static_cast<double>(luminance(ground.irradiance(sample)));
            exposed.add(value);
            eastern.add(is_east(sample.to_light) ? value : 0.0);
        }
        CHECK(outside < 100);
        CHECK(exposed.standard_error() < 0.001 * all);
        CHECK(std::abs(exposed.mean() - static_cast<double>(shares.exposed)) <
              5e-4 * all + 4.0 * exposed.standard_error());
        const double expected =
            sum_over([&](Vec3 d) { return is_east(d) && occluders.may_block(place, d); });
        CHECK(std::abs(eastern.mean() - expected) < 2e-3 * all + 4.0 * eastern.standard_error());
    }
}

TEST_CASE("lamps that bring next to nothing are sampled seldom", "[ground]")
{
    const World world{SharedSceneDesc(table().desc)};
    const GroundOccluders occluders(world.geometry(), 0.0f);
    const std::size_t near = occluders.place({-0.5f, 0.0f, 0.0f});
    const std::size_t far = occluders.place({90.0f, 0.0f, 0.0f});
    const GroundLamps alone(world.lights(), occluders, 0.0f, 0.0f);
    CHECK(alone.chance(near) == 1.0f);
    CHECK(alone.chance(far) == 1.0f);
    const GroundLamps beside(world.lights(), occluders, 0.0f, 5.0f);  // 5 / 1.6^2 lx at most
    CHECK(beside.chance(near) == 1.0f);
    CHECK(beside.chance(far) == 1.0f / 128.0f);
    const GroundLamps at_dusk(world.lights(), occluders, 0.0f, 10.0f);
    CHECK(at_dusk.chance(near) > 0.5f);
    CHECK(at_dusk.chance(near) < 1.0f);
    const GroundLamps by_day(world.lights(), occluders, 0.0f, 1e5f);
    CHECK(by_day.chance(near) == 1.0f / 128.0f);
}

TEST_CASE("shadow rays go where a shadow may be", "[ground]")
{
    SceneBuilder builder = table();
    builder.light(sunny_sky());
    builder.light(DirectionalLightDesc{.direction = {1.0f, -1.0f, 0.0f}, .illuminance = Rgb(3.0f)});
    const Scene scene(builder.desc);
    const auto rays_of_samples = [&](float x) {
        CameraDesc camera = camera_above();
        camera.world_from_camera[3].x = x;
        const RenderResult result = render(scene, camera, ground_options(32, 16));
        return static_cast<double>(result.stats.rays.aov) / (32.0 * 32.0 * 16.0);
    };
    CHECK(rays_of_samples(0.0f) > 1.8);
    CHECK(rays_of_samples(20.0f) < 1.1);
}

}  // namespace bdpt::test::ground_light_test
