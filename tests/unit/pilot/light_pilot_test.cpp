// What a pilot learns about the visibility of an environment, and that it cannot bias an image.

#include "pilot/light_pilot.h"

#include "camera/camera.h"
#include "catch.hpp"
#include "integrator/integrator.h"
#include "make_sample.h"
#include "path/densities.h"
#include "path/random_walk.h"
#include "render/pass.h"
#include "render/view.h"
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
#include <stop_token>
#include <utility>
#include <vector>

namespace bdpt::test::light_pilot_test {
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

/// A closed room with a lamp, whose floor goes on in front of it under sun and sky.
SceneBuilder room_and_terrace()
{
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), plastic(Rgb(0.6f), 0.3f));
    builder.ceiling(lambertian(Rgb(0.7f))).lamp(0.9f, 0.3f, Rgb(40.0f));
    builder.quad({-3, -1, 4}, {3, -1, 4}, {3, -1, 1}, {-3, -1, 1}, lambertian(Rgb(0.5f)));
    builder.light(EnvironmentLightDesc{.radiance = sky_image()});
    builder.light(
        DirectionalLightDesc{.direction = {0.1f, -1.0f, 0.05f}, .illuminance = Rgb(4.0f)});
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

std::shared_ptr<const LearnedLight> learned(const Scene& scene, const RenderOptions& options)
{
    return learned_light(scene.world(), room_camera(), options);
}

const EnvironmentLight& sky_of(const Scene& scene)
{
    const LightSet& lights = scene.world().lights();
    return std::get<EnvironmentLight>(lights[*lights.environment()].model());
}

/// Returns claims about `room_and_terrace` that are all wrong: only what is blocked is visible, on
/// one side of the room; each place has light of another group alone; light paths start at one half
/// of the lamp; light of the sky enters from below, and light of the sun beside the room.
LearnedLight mislead(const Scene& scene)
{
    std::vector<EnvironmentVisibility::Trial> wrong;
    std::vector<GroupShares::Finding> findings;
    std::vector<Escape> escapes;
    std::vector<Escape> wrong_side;  // of the sun
    Random random(6);
    for (int i = 0; i < 20000; ++i) {
        const Vec3 p = 2.0f * Vec3(random.next(), random.next(), random.next()) - 1.0f;
        const auto tile = static_cast<std::uint32_t>(random.next() * EnvironmentTiles::tile_count);
        wrong.push_back({.p = p, .tile = tile, .visible = (tile % 2 == 0) == (p.x > 0.1f)});
        for (std::uint32_t group = 0; group < 3; ++group) {
            const bool only = group == (p.z > 0.0f ? 2U : p.x > 0.0f ? 1U : 0U);
            findings.push_back({.p = p, .group = group, .value = only ? 1.0f : 0.0f});
        }
        const Vec3 down = normalize(Vec3(p.x, -1.0f, p.y));
        escapes.push_back({.p = 0.3f * p,
                           .direction = down,
                           .tile = sky_of(scene).tile_to(down),
                           .throughput = 1.0f});
        wrong_side.push_back({.p = p + Vec3(2.0f, 0.0f, 0.0f),
                              .direction = normalize(Vec3(-0.1f, 1.0f, -0.05f)),
                              .throughput = 1.0f});
    }
    const LightSet& lights = scene.world().lights();
    LightId sun{};
    while (!std::holds_alternative<DirectionalLight>(lights[sun].model())) {
        sun = LightId{static_cast<std::uint32_t>(sun) + 1};
    }
    const std::vector<IndirectLight> half_of_lamp(500, {.light = LightId{0}, .value = 1.0f});
    return {.visibility = EnvironmentVisibility(wrong),
            .groups = GroupShares(findings, 3),
            .starts = learn_starts(half_of_lamp, lights),
            .entries =
                EnvironmentEntries(escapes, sky_of(scene).tiles(), scene.world().bounding_sphere()),
            .suns = {{.sun = sun,
                      .window = EntryWindow(wrong_side, {}, scene.world().bounding_sphere())}}};
}

}  // namespace

TEST_CASE("light pilot: the open front is visible, the wall behind is not", "[pilot]")
{
    const Scene scene(open_room().desc);
    const auto found = learned(scene, options_of(IntegratorKind::mis));
    REQUIRE(found);
    REQUIRE(found->visibility);
    CHECK_FALSE(found->groups);  // there is but one
    CHECK(found->visibility->cells() > 20);
    const TileFactors& factors = found->visibility->at({0.0f, -0.99f, 0.5f});
    const auto factor = [&](Vec3 direction) {
        return factors.of[sky_of(scene).tile_to(normalize(direction))];
    };
    CHECK(factor({0.0f, 0.5f, 1.0f}) > 0.8f);
    CHECK(factor({0.0f, 0.4f, -1.0f}) < 0.4f);
    CHECK(factor({1.0f, 0.2f, 0.0f}) < 0.7f);
}

TEST_CASE("light pilot: the lamp is chosen within, sky and sun without", "[pilot]")
{
    const Scene scene(room_and_terrace().desc);
    const NextEventLights& lights = scene.world().lights().next_event_lights();
    REQUIRE(lights.group_count() == 3);
    const auto found = learned(scene, options_of(IntegratorKind::mis));
    REQUIRE(found);
    REQUIRE(found->groups);
    CHECK(found->groups->cells() > 10);
    const GroupShares::Shares& within = found->groups->at({0.0f, -0.99f, -0.6f});
    const GroupShares::Shares& without = found->groups->at({0.0f, -0.99f, 1.8f});
    const std::size_t sky = lights.group(*scene.world().lights().environment());
    const std::size_t sun = 1 - sky;
    constexpr std::size_t lamps = 2;
    CHECK(within[lamps] > 0.6f);
    CHECK(within[sun] < 0.05f);
    CHECK(without[lamps] < 0.35f);
    CHECK(without[sun] > 0.2f);
    CHECK(without[sky] > 0.2f);

    SECTION("lamps and a sun without a sky have shares, too")
    {
        SceneBuilder builder = room_and_terrace();
        std::erase_if(builder.desc.lights, [](const LightDesc& light) {
            return std::holds_alternative<EnvironmentLightDesc>(light);
        });
        const Scene dark(std::move(builder.desc));
        const auto of_two = learned(dark, options_of(IntegratorKind::bdpt));
        REQUIRE(of_two);
        CHECK_FALSE(of_two->visibility);
        CHECK(of_two->groups->at({0.0f, -0.99f, -0.6f})[1] > 0.75f);
    }
    SECTION("whoever asks for a choice by power has it")
    {
        RenderOptions by_power = options_of(IntegratorKind::mis);
        by_power.sampling.lights = LightSampling::power;
        const auto none = learned(scene, by_power);
        CHECK((none == nullptr || !none->groups));
    }
}

TEST_CASE("light pilot: light paths from sky and sun enter the room", "[pilot]")
{
    SceneBuilder builder = open_room();
    builder.quad({-9, -1, -9}, {9, -1, -9}, {9, -1, 2}, {-9, -1, 2}, lambertian(Rgb(0.5f)));
    const bool is_sunny = GENERATE(false, true);
    if (is_sunny) {
        builder.desc.lights = {
            DirectionalLightDesc{.direction = {0.1f, -1.0f, 0.05f}, .illuminance = Rgb(4.0f)}};
    }
    const Scene scene(std::move(builder.desc));
    const auto found = learned(scene, options_of(IntegratorKind::bdpt));
    REQUIRE(found);
    REQUIRE(found->entries.has_value() == !is_sunny);
    REQUIRE(found->suns.size() == (is_sunny ? 1 : 0));
    const Camera camera(room_camera(), 16, 12);
    const auto fraction_inside = [&](const LearnedLight* table) {
        int inside = 0;
        Subpath path(2);
        RayCounts rays;
        for (int i = 0; i < 4000; ++i) {
            SampleContext sample = make_sample(scene.world(), camera,
                                               {SamplerKind::independent, 3, i % 16, 0, i}, rays);
            trace_light_subpath(sample, {.max_vertices = 2}, {.learned = table}, path);
            if (path.size() == 2) {
                const Vec3 p = abs(path[1].end.p);
                inside += p.x < 1.01f && p.y < 1.01f && p.z < 1.01f ? 1 : 0;
                const auto densities_at = [&](Vec3 offset) {
                    auto end = path[1].end;
                    end.p += offset;
                    return light_densities(sample, path[0], end, {.learned = table});
                };
                const auto agrees = [&](Vec3 offset) {
                    return densities_at(offset).to_next.value ==
                           Approx(path[1].pdf_fwd.value).epsilon(2e-3);
                };
                REQUIRE(densities_at(Vec3(0.0f)).emit.value ==
                        Approx(path[0].pdf_fwd.value).epsilon(1e-4));
                // Rounding may move a point at the edge of a cell into the next one.
                constexpr float near = 1e-5f;
                REQUIRE((agrees(Vec3(0.0f)) || agrees({near, 0, 0}) || agrees({-near, 0, 0}) ||
                         agrees({0, 0, near}) || agrees({0, 0, -near}) || agrees({0, near, 0}) ||
                         agrees({0, -near, 0})));
            }
        }
        return inside / 4000.0;
    };
    const double uniform = fraction_inside(nullptr);
    CHECK(uniform < 0.05);
    CHECK(fraction_inside(found.get()) > 6.0 * uniform);
}

TEST_CASE("light pilot: light paths start where the image's indirect light comes from", "[pilot]")
{
    // A closed room in full daylight; on the wide ground below, the sky has nearly all power.
    const auto dim_lamp_by_day = [](const MaterialDesc& front) {
        SceneBuilder builder;
        builder.walls(lambertian(Rgb(0.7f)), lambertian(Rgb(0.6f)));
        builder.ceiling(lambertian(Rgb(0.7f))).lamp(0.9f, 0.1f, Rgb(1.0f));
        builder.front(front);
        builder.quad({-9, -9, -9}, {9, -9, -9}, {9, -9, 9}, {-9, -9, 9}, lambertian(Rgb(0.5f)));
        builder.light(EnvironmentLightDesc{.radiance = sky_image()});
        return builder;
    };
    const CameraDesc inside = camera_at({0.0f, 0.0f, 0.9f}, {0.0f, 0.0f, 0.0f}, 1.2f);
    const auto probability_of_sky = [&](const MaterialDesc& front) {
        const Scene scene(dim_lamp_by_day(front).desc);
        const LightSet& lights = scene.world().lights();
        const LightId sky = *lights.environment();
        REQUIRE(lights.emission_probability(sky) > 0.99f);
        const auto found = learned_light(scene.world(), inside, options_of(IntegratorKind::bdpt));
        REQUIRE(found);
        REQUIRE(found->starts);
        const Camera camera(inside, 16, 12);
        Subpath path(3);
        RayCounts rays;
        int starts = 0;
        constexpr int count = 4000;
        for (int i = 0; i < count; ++i) {
            SampleContext sample = make_sample(scene.world(), camera,
                                               {SamplerKind::independent, 3, i % 16, 0, i}, rays);
            trace_light_subpath(sample, {.max_vertices = 3}, {.learned = found.get()}, path);
            REQUIRE(path.size() >= 1);
            starts += path[0].light == sky ? 1 : 0;
            if (path.size() >= 2) {
                const LightDensities densities =
                    light_densities(sample, path[0], path[1].end, {.learned = found.get()});
                REQUIRE(densities.emit.value == Approx(path[0].pdf_fwd.value).epsilon(1e-4));
            }
        }
        const float probability = lights.emission_probability(sky, found.get());
        CHECK(starts / static_cast<double>(count) == Approx(probability).margin(0.03));
        return probability;
    };
    CHECK(probability_of_sky(lambertian(Rgb(0.7f))) < 0.2f);
    // Light samples do not find the sky behind a window, but camera paths do.
    MaterialDesc window = thin_glass(0.0f);
    window.specular_color.x = 0.9f;  // no clear sheet, which light samples pass
    CHECK(probability_of_sky(window) > 0.7f);
}

TEST_CASE("light pilot: light paths start at the lamp of the room that is seen", "[pilot]")
{
    // A closed room, and outside of it a floodlight or sign that has nearly all power.
    const auto room = [] {
        SceneBuilder builder;
        builder.walls(lambertian(Rgb(0.7f)), lambertian(Rgb(0.6f)));
        builder.ceiling(lambertian(Rgb(0.7f))).front(lambertian(Rgb(0.7f)));
        builder.quad({-9, -9, -9}, {9, -9, -9}, {9, -9, 9}, {-9, -9, 9}, lambertian(Rgb(0.5f)));
        return builder;
    };
    const CameraDesc inside = camera_at({0.0f, 0.0f, 0.9f}, {0.0f, 0.0f, 0.0f}, 1.2f);
    // Of all lights but the first `within`.
    const auto probability_of_outside = [&](const Scene& scene, std::uint32_t within) {
        const LightSet& lights = scene.world().lights();
        const auto found = learned_light(scene.world(), inside, options_of(IntegratorKind::bdpt));
        REQUIRE(found);
        CHECK_FALSE(found->groups);
        REQUIRE(found->starts);
        float by_power = 0.0f;
        float by_starts = 0.0f;
        for (std::uint32_t i = within; i < lights.size(); ++i) {
            by_power += lights.emission_probability(LightId{i});
            by_starts += lights.emission_probability(LightId{i}, found.get());
        }
        REQUIRE(by_power > 0.9f);
        return by_starts;
    };
    SECTION("two lights")
    {
        SceneBuilder builder = room();
        builder.lamp(0.9f, 0.1f, Rgb(1.0f));
        builder.light(PointLightDesc{.position = {0.0f, 5.0f, 0.0f}, .intensity = Rgb(100.0f)});
        CHECK(probability_of_outside(Scene(std::move(builder.desc)), 2) < 0.35f);
    }
    SECTION("a mesh of two lamps")
    {
        SceneBuilder builder = room();
        builder.lamp(0.9f, 0.1f, Rgb(1.0f));
        MeshDesc& lamps = builder.desc.meshes.back();
        constexpr std::uint32_t parts = 12;
        const auto corner = static_cast<std::uint32_t>(lamps.positions.size());
        for (std::uint32_t i = 0; i <= parts; ++i) {
            const float x = 7.0f + 0.2f * static_cast<float>(i);
            lamps.positions.emplace_back(x, 5.0f, i < parts ? 7.0f : 9.0f);
            lamps.uvs[0].emplace_back(0.0f);
        }
        for (std::uint32_t i = 0; i + 1 < parts; ++i) {
            lamps.triangles.push_back({corner + i, corner + i + 1, corner + parts});
        }
        CHECK(probability_of_outside(Scene(std::move(builder.desc)), 2) < 0.35f);
    }
}

TEST_CASE("light pilot: direct light brings no light paths", "[pilot]")
{
    // The sun shines on a dark terrace alone, which reflects little of it into the room; the lamp
    // shines upwards.
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.8f)), lambertian(Rgb(0.8f)));
    builder.ceiling(lambertian(Rgb(0.8f)));
    builder.quad({-0.3f, 0.5f, 0.3f}, {0.3f, 0.5f, 0.3f}, {0.3f, 0.5f, -0.3f}, {-0.3f, 0.5f, -0.3f},
                 emitter(Rgb(3.0f)));
    builder.quad({-3, -1, 4}, {3, -1, 4}, {3, -1, 1}, {-3, -1, 1}, lambertian(Rgb(0.02f)));
    builder.light(
        DirectionalLightDesc{.direction = {0.0f, -1.0f, 0.0f}, .illuminance = Rgb(20.0f)});
    const Scene scene(std::move(builder.desc));
    const auto found =
        learned_light(scene.world(), camera_at({0.0f, 2.0f, 6.0f}, {0.0f, -0.5f, 1.0f}, 0.75f),
                      options_of(IntegratorKind::bdpt));
    REQUIRE(found);
    REQUIRE(found->starts);
    const LightSet& lights = scene.world().lights();
    const LightId sun = lights.next_event_lights().infinite().front();
    CHECK(lights.emission_probability(sun) > 0.9f);
    CHECK(lights.emission_probability(sun, found.get()) < 0.45f);
}

TEST_CASE("light pilot: it learns nothing where nothing can be learned", "[pilot]")
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
    SECTION("a sun, of which mis starts no light")
    {
        SceneBuilder builder = open_room();
        builder.desc.lights = {DirectionalLightDesc{.direction = {0.1f, -1.0f, 0.05f}}};
        const Scene sunny(std::move(builder.desc));
        CHECK_FALSE(learned(sunny, options_of(IntegratorKind::mis)));
        CHECK(learned(sunny, options));
    }
    SECTION("two lamps, which mis has no light paths from")
    {
        SceneBuilder builder = open_room();
        builder.desc.lights = {PointLightDesc{}, PointLightDesc{}};
        const Scene two(std::move(builder.desc));
        CHECK_FALSE(learned(two, options_of(IntegratorKind::mis)));
        RenderOptions by_power = options;
        by_power.sampling.lights = LightSampling::power;
        CHECK_FALSE(learned(two, by_power));
        CHECK(learned(two, options));
    }
    SECTION("one lamp of several triangles")
    {
        SceneBuilder builder = open_room();
        builder.lamp(0.9f, 0.3f, Rgb(40.0f));
        builder.desc.lights.clear();
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
        CHECK_FALSE(learned_light(
            scene.world(), camera_at({0.0f, 0.0f, 9.0f}, {0.0f, 0.0f, 20.0f}, 0.5f), options));
    }
}

TEST_CASE("light pilot: threads, crop, samples and seed do not matter", "[pilot]")
{
    const Scene scene(room_and_terrace().desc);
    const RenderOptions options = options_of(IntegratorKind::mis);
    const auto first = learned(scene, options);
    REQUIRE(first);
    std::vector<RenderOptions> others(4, options);
    others[0].system.threads = 1;
    others[1].film.crop = PixelRect{.x0 = 30, .y0 = 20, .x1 = 50, .y1 = 90};
    others[2].sampling.samples = {.begin = 40, .end = 50};
    others[3].sampling.seed = 77;
    for (const RenderOptions& other : others) {
        // A scene of its own, which remembers nothing.
        const auto again = learned(Scene(room_and_terrace().desc), other);
        REQUIRE(again);
        REQUIRE(again->visibility->cells() == first->visibility->cells());
        REQUIRE(again->groups->cells() == first->groups->cells());
        REQUIRE(again->entries->factors().of == first->entries->factors().of);
        Random random(5);
        for (int i = 0; i < 1000; ++i) {
            const Vec3 p = 2.0f * Vec3(random.next(), random.next(), random.next()) - 1.0f;
            REQUIRE(again->visibility->at(p).of == first->visibility->at(p).of);
            REQUIRE(again->groups->at(p) == first->groups->at(p));
            const Vec3 d = normalize(p);
            const auto tile = static_cast<std::size_t>(i) % EnvironmentTiles::tile_count;
            REQUIRE(again->entries->window(tile).pdf(p, d).value ==
                    first->entries->window(tile).pdf(p, d).value);
            REQUIRE(again->suns.front().window.pdf(p, d).value ==
                    first->suns.front().window.pdf(p, d).value);
        }
        for (std::size_t light = 0; light < first->starts->size(); ++light) {
            REQUIRE(again->starts->probability(light) == first->starts->probability(light));
        }
    }
}

TEST_CASE("light pilot: all renders of a view learn once", "[pilot]")
{
    const Scene scene(open_room().desc);
    RenderOptions asked = options_of(IntegratorKind::automatic);
    asked.film.width = 24;
    asked.film.height = 18;
    std::stop_source source;
    source.request_stop();
    RenderOptions named = asked;
    named.integrator = IntegratorKind::mis;
    CHECK_FALSE(learned_light(scene.world(), room_camera(), named, source.get_token()));
    const RenderOptions chosen = chosen_options(scene, room_camera(), asked);
    const auto first = learned(scene, chosen);
    REQUIRE(first);
    std::vector<RenderOptions> same(3, named);
    same[0].integrator = IntegratorKind::bdpt;
    same[1].film.crop = PixelRect{.x0 = 3, .y0 = 2, .x1 = 5, .y1 = 9};
    same[2].sampling.seed = 5;
    for (const RenderOptions& options : same) {
        CHECK(learned(scene, options) == first);
    }
    // Kept is what was learned last.
    std::vector<RenderOptions> others(3, named);
    others[0].film.width = 25;
    others[1].transport.max_depth = 4;
    others[2].transport.rr_start = 1;
    for (const RenderOptions& options : others) {
        CHECK(learned(scene, options) != first);
    }
    CHECK(learned_light(scene.world(), camera_at({0.2f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 0.8f),
                        others[2]) != learned(scene, others[2]));
    // That of an edited scene is its own.
    CHECK(learned(scene.with_environment(EnvironmentLightDesc{.radiance = sky_image()}), named) !=
          learned(scene, named));
}

TEST_CASE("light pilot: a learned light sample has the density of a hit of the same point",
          "[pilot]")
{
    const Scene scene(room_and_terrace().desc);
    const LightSet& lights = scene.world().lights();
    const LearnedLight learned = mislead(scene);
    const NextEventSampling sampling{.environments = EnvironmentSampling::learned,
                                     .lights = LightSampling::automatic,
                                     .learned = &learned};
    Random random(12);
    int of_sky = 0;
    int of_lamp = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vec3 p = 2.0f * Vec3(random.next(), random.next(), random.next()) - 1.0f;
        LightSampleContext receiver{.p = p};
        if (i % 2 == 0) {
            receiver.normal = normalize(Vec3(p.z, 1.0f, p.x));
        }
        Sampler sampler(SamplerKind::independent, 12, i, 0, 0);
        sampler.start(SampleUse::next_event);
        const Vec2 u = sampler.next_2d();
        const LightSet::NextEvent next = lights.sample_next_event(
            receiver, u, [&sampler] { return sampler.next_fine(); }, sampling, 0.0f);
        if (!next.incident || lights[next.light].is_delta()) {
            continue;
        }
        const bool is_sky = next.light == lights.environment();
        ++(is_sky ? of_sky : of_lamp);
        const LightPoint met{.p = is_sky ? next.incident->wi : next.incident->end.p,
                             .ng = next.incident->end.ng,
                             .barycentrics = next.incident->barycentrics};
        const float of_hit = lights.next_event_pdf(next.light, met, receiver, sampling).value;
        CHECK(of_hit == Approx(next.pdf().value).epsilon(1e-4));
    }
    CHECK(of_sky > 500);
    CHECK(of_lamp > 500);
}

TEST_CASE("light pilot: the image is right whatever was learned", "[pilot]")
{
    const Scene scene(room_and_terrace().desc);
    const World& world = scene.world();
    const MovingCamera camera(room_camera(), Camera(room_camera(), 16, 12));
    const LearnedLight misled = mislead(scene);
    for (const auto kind : {IntegratorKind::mis, IntegratorKind::bdpt}) {
        RenderOptions options = options_of(kind);
        const auto right = learned(scene, options);
        REQUIRE(right);
        REQUIRE(right->entries);
        REQUIRE(right->starts);
        REQUIRE(right->suns.size() == 1);
        options.film.width = 16;
        options.film.height = 12;
        std::array<Moments, 3> means;
        const std::array<const LearnedLight*, 3> tables{nullptr, right.get(), &misled};
        for (std::size_t k = 0; k < tables.size(); ++k) {
            for (std::uint64_t seed = 0; seed < 60; ++seed) {
                options.sampling.seed = seed * 3 + k;
                options.sampling.samples.end = 8;
                const auto integrator = make_integrator(world, camera, options, tables[k]);
                RenderResult part{.identity = {},
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
            CHECK(error < 0.012 * means[0].mean());
            CHECK(std::abs(means[k].mean() - means[0].mean()) < 4.0 * error);
        }
    }
}

}  // namespace bdpt::test::light_pilot_test
