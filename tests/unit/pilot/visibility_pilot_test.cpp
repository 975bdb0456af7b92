// What a pilot learns about the visibility of an environment, and that it cannot bias an image.

#include "pilot/visibility_pilot.h"

#include "camera/moving_camera.h"
#include "catch.hpp"
#include "integrator/integrator.h"
#include "render/learned_visibility.h"
#include "render/pass.h"
#include "scene/world.h"
#include "scene_builder.h"
#include "statistics.h"

#include <bdpt/options/integrators.h>
#include <bdpt/render.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace bdpt::test::visibility_pilot_test {
namespace {

Image sky_image()
{
    Image sky{.width = 32, .height = 16, .pixels = std::vector<Rgb>(512, Rgb(0.5f))};
    sky.pixels[70] = Rgb(30.0f);
    sky.pixels[300] = Rgb(20.0f);
    return sky;
}

/// A room without ceiling and front: the sky is seen above and in front of it.
SceneBuilder open_room()
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), plastic(Rgb(0.6f), 0.3f));
    builder.sphere({0.3f, -0.5f, 0.0f}, 0.4f, metal(Rgb(0.8f), 0.2f), 12);
    builder.light(EnvironmentLightDesc{.radiance = sky_image()});
    return builder;
}

RenderOptions options_of(IntegratorKind integrator)
{
    RenderOptions options;
    options.integrator = integrator;
    options.film.width = 160;
    options.film.height = 120;
    options.transport.max_depth = 5;
    return options;
}

std::unique_ptr<const EnvironmentVisibility> learned(const Scene& scene,
                                                     const RenderOptions& options)
{
    return learned_visibility(scene.world(), room_camera(), options);
}

const EnvironmentLight& sky_of(const Scene& scene)
{
    const LightSet& lights = scene.world().lights();
    return std::get<EnvironmentLight>(lights[*lights.environment()].model());
}

}  // namespace

TEST_CASE("visibility pilot: the open front is visible, the wall behind is not", "[pilot]")
{
    const Scene scene(open_room().desc);
    const auto visibility = learned(scene, options_of(IntegratorKind::mis));
    REQUIRE(visibility);
    CHECK(visibility->cells() > 20);
    const TileFactors& factors = visibility->at({0.0f, -0.99f, 0.5f});
    const auto factor = [&](Vec3 direction) {
        return factors.of[sky_of(scene).tile_to(normalize(direction))];
    };
    CHECK(factor({0.0f, 0.5f, 1.0f}) > 0.8f);
    CHECK(factor({0.0f, 0.4f, -1.0f}) < 0.4f);
    CHECK(factor({1.0f, 0.2f, 0.0f}) < 0.7f);
}

TEST_CASE("visibility pilot: it learns nothing where nothing can be learned", "[pilot]")
{
    const Scene scene(open_room().desc);
    const RenderOptions options = options_of(IntegratorKind::bdpt);
    REQUIRE(learned(scene, options));
    SECTION("integrators without weights for it")
    {
        for (const auto kind : {IntegratorKind::pt, IntegratorKind::nee, IntegratorKind::lt}) {
            CHECK_FALSE(learned(scene, options_of(kind)));
        }
    }
    SECTION("other ways to sample environments")
    {
        for (const auto sampling : {EnvironmentSampling::plain, EnvironmentSampling::compensated}) {
            RenderOptions other = options;
            other.sampling.environment = sampling;
            CHECK_FALSE(learned(scene, other));
        }
    }
    SECTION("light that is seen directly")
    {
        RenderOptions other = options;
        other.transport.max_depth = 1;
        CHECK_FALSE(learned(scene, other));
    }
    SECTION("no environment")
    {
        SceneBuilder builder = open_room();
        builder.desc.lights = {PointLightDesc{}};
        CHECK_FALSE(learned(Scene(std::move(builder.desc)), options));
    }
    SECTION("fog")
    {
        SceneBuilder builder = open_room();
        builder.desc.fog = MediumDesc{.extinction = Rgb(0.1f)};
        CHECK_FALSE(learned(Scene(std::move(builder.desc)), options));
    }
    SECTION("a floor under the open sky")
    {
        SceneBuilder builder;
        builder.quad({-1, -1, 1}, {1, -1, 1}, {1, -1, -1}, {-1, -1, -1}, lambertian(Rgb(0.5f)));
        builder.light(EnvironmentLightDesc{.radiance = sky_image()});
        CHECK_FALSE(learned(Scene(std::move(builder.desc)), options));
    }
    SECTION("a camera that sees nothing")
    {
        CHECK_FALSE(learned_visibility(
            scene.world(), camera_at({0.0f, 0.0f, 9.0f}, {0.0f, 0.0f, 20.0f}, 0.5f), options));
    }
}

TEST_CASE("visibility pilot: threads, crop, samples and seed do not matter", "[pilot]")
{
    const Scene scene(open_room().desc);
    const RenderOptions options = options_of(IntegratorKind::mis);
    const auto visibility = learned(scene, options);
    REQUIRE(visibility);
    std::vector<RenderOptions> others(4, options);
    others[0].system.threads = 1;
    others[1].film.crop = PixelRect{.x0 = 30, .y0 = 20, .x1 = 50, .y1 = 90};
    others[2].sampling.samples = {.begin = 40, .end = 50};
    others[3].sampling.seed = 77;
    for (const RenderOptions& other : others) {
        const auto again = learned(scene, other);
        REQUIRE(again);
        REQUIRE(again->cells() == visibility->cells());
        Random random(5);
        for (int i = 0; i < 1000; ++i) {
            const Vec3 p = 2.0f * Vec3(random.next(), random.next(), random.next()) - 1.0f;
            REQUIRE(again->at(p).of == visibility->at(p).of);
        }
    }
}

TEST_CASE("visibility pilot: the image is right whatever was learned", "[pilot]")
{
    // Also what is wrong on purpose: that only what is blocked is visible, on one side of the room.
    const Scene scene(open_room().desc);
    const World& world = scene.world();
    const MovingCamera camera(room_camera(), Camera(room_camera(), 16, 12));
    std::vector<EnvironmentVisibility::Trial> wrong;
    Random random(6);
    for (int i = 0; i < 20000; ++i) {
        const Vec3 p = 2.0f * Vec3(random.next(), random.next(), random.next()) - 1.0f;
        const auto tile = static_cast<std::uint32_t>(random.next() * EnvironmentTiles::tile_count);
        wrong.push_back({.p = p, .tile = tile, .visible = (tile % 2 == 0) == (p.x > 0.1f)});
    }
    const EnvironmentVisibility misled(wrong);
    for (const auto kind : {IntegratorKind::mis, IntegratorKind::bdpt}) {
        RenderOptions options = options_of(kind);
        const auto right = learned(scene, options);
        REQUIRE(right);
        options.film.width = 16;
        options.film.height = 12;
        std::array<Moments, 3> means;
        const std::array<const EnvironmentVisibility*, 3> tables{nullptr, right.get(), &misled};
        for (std::size_t k = 0; k < tables.size(); ++k) {
            for (std::uint64_t seed = 0; seed < 60; ++seed) {
                options.sampling.seed = seed * 3 + k;
                options.sampling.samples.end = 8;
                const auto integrator = make_integrator(world, camera, options, tables[k]);
                RenderPart part{.identity = {},
                                .samples = {},
                                .film = Film(film_layout(options)),
                                .aovs = {},
                                .ids = {},
                                .strategies = {},
                                .stats = {}};
                const AovPass no_aovs(world, camera, options);
                const std::function<void(const PathContribution&)> nobody;
                render_pass({.integrator = *integrator, .aov_pass = no_aovs, .on_path = nobody},
                            options, options.sampling.samples, part);
                double sum = 0.0;
                const Image image = part.film.develop();
                for (const Rgb& pixel : image.pixels) {
                    sum += static_cast<double>(pixel.r + pixel.g + pixel.b);
                }
                means[k].add(sum / static_cast<double>(image.pixels.size()));
            }
        }
        for (std::size_t k = 1; k < tables.size(); ++k) {
            const double error = std::hypot(means[0].standard_error(), means[k].standard_error());
            CAPTURE(info(kind).name, k, means[0].mean(), means[k].mean());
            CHECK(error < 0.004 * means[0].mean());
            CHECK(std::abs(means[k].mean() - means[0].mean()) < 4.0 * error);
        }
    }
}

}  // namespace bdpt::test::visibility_pilot_test
