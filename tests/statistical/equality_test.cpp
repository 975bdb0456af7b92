// pt = nee = mis = lt = bdpt: the integrators estimate the same integral by different densities, so
// a wrong density, weight, cosine or factor in any of them makes them differ.

#include "catch.hpp"
#include "equal_means.h"
#include "equality_cases.h"
#include "equality_check.h"
#include "scene_builder.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::test::equality_test {
namespace {

/// `mis`: means of all paths.
void check_light_tracing(const EqualityCase& test, const Scene& scene, TileMeans& mis,
                         std::uint64_t first_seed)
{
    if (!test.seen_by_lt) {
        return;
    }
    RenderOptions seen = options(test, IntegratorKind::lt, first_seed);
    seen.transport.min_depth = *test.seen_by_lt;
    TileMeans lt(scene, test.camera, seen);
    if (seen.transport.min_depth == 1) {
        check_equal(test, "mis = lt", mis, lt, test.detectable_bias_of_light_sampling);
        return;
    }
    RenderOptions part = options(test, IntegratorKind::mis, first_seed + 1);
    part.transport.min_depth = seen.transport.min_depth;
    TileMeans mis_part(scene, test.camera, part);
    check_equal(test, "mis = lt", mis_part, lt, test.detectable_bias_of_light_sampling);
}

/// `first_seed`: cases do not share random numbers, or one unlucky draw would be seen in all.
void check_case(const EqualityCase& test, std::uint64_t first_seed)
{
    const Scene scene(test.scene);
    TileMeans pt(scene, test.camera, options(test, IntegratorKind::pt, first_seed + 1));
    TileMeans mis(scene, test.camera, options(test, IntegratorKind::mis, first_seed + 2));
    TileMeans bdpt(scene, test.camera, options(test, IntegratorKind::bdpt, first_seed + 3));
    check_equal(test, "pt = mis", pt, mis);
    check_equal(test, "mis = bdpt", mis, bdpt);
    // One case in three: that its weights add up to one is tested for each path.
    if (first_seed / 100 % 3 == 0) {
        RenderOptions balance = options(test, IntegratorKind::bdpt, first_seed + 4);
        balance.transport.heuristic = Heuristic::balance;
        TileMeans bdpt_balance(scene, test.camera, balance);
        check_equal(test, "mis = bdpt (balance)", mis, bdpt_balance);
    }
    if (first_seed / 100 % 3 == 1) {
        RenderOptions chosen = options(test, IntegratorKind::bdpt, first_seed + 8);
        chosen.bidirectional.light_paths = 0.25;
        chosen.bidirectional.connections = 4.0;
        chosen.bidirectional.connection_rays = 3.0;
        TileMeans bdpt_chosen(scene, test.camera, chosen);
        check_equal(test, "mis = bdpt (chosen connections)", mis, bdpt_chosen);
    }
    TileMeans nee(scene, test.camera, options(test, IntegratorKind::nee, first_seed + 5));
    check_equal(test, "mis = nee", mis, nee, test.detectable_bias_of_light_sampling);
    check_light_tracing(test, scene, mis, first_seed + 6);
}

/// The same integral by other random numbers.
void check_samplers(const EqualityCase& test, std::uint64_t first_seed)
{
    const Scene scene(test.scene);
    TileMeans reference(scene, test.camera, options(test, IntegratorKind::mis, first_seed + 1));
    TileMeans mis(scene, test.camera, options(test, IntegratorKind::mis, first_seed + 2),
                  SamplerKind::sobol);
    TileMeans bdpt(scene, test.camera, options(test, IntegratorKind::bdpt, first_seed + 3),
                   SamplerKind::sobol);
    check_equal(test, "mis: independent = sobol", reference, mis);
    check_equal(test, "mis: independent = bdpt: sobol", reference, bdpt);
}

/// Every fourth case from `first`: shares that run side by side.
void check_every_fourth(std::size_t first)
{
    const auto cases = equality_cases();
    for (std::size_t i = first; i < cases.size(); i += 4) {
        DYNAMIC_SECTION(cases[i].name)
        {
            check_case(cases[i], 100 * i);
        }
    }
}

/// `seed`: before that of the first case.
void check_cases(const std::vector<EqualityCase>& cases, std::uint64_t seed)
{
    for (const EqualityCase& test : cases) {
        seed += 100;
        DYNAMIC_SECTION(test.name)
        {
            check_case(test, seed);
        }
    }
}

}  // namespace

TEST_CASE("all integrators agree: cases 0, 4, ...", "[equality][cases][long]")
{
    check_every_fourth(0);
}

TEST_CASE("all integrators agree: cases 1, 5, ...", "[equality][cases][long]")
{
    check_every_fourth(1);
}

TEST_CASE("all integrators agree: cases 2, 6, ...", "[equality][cases][long]")
{
    check_every_fourth(2);
}

TEST_CASE("all integrators agree: cases 3, 7, ...", "[equality][cases][long]")
{
    check_every_fourth(3);
}

TEST_CASE("all integrators agree: layered materials", "[equality][cases][layers][long]")
{
    check_cases(layer_cases(), 300000);
}

TEST_CASE("all integrators agree: sixty materials", "[equality][cases][layers][long]")
{
    check_cases(any_material_cases(), 340000);
}

TEST_CASE("all integrators agree: bodies in bodies", "[equality][cases][bodies][long]")
{
    check_cases(volume_cases(), 320000);
}

TEST_CASE("all integrators agree: steep normal maps", "[equality][cases][layers][long]")
{
    check_cases(normal_map_cases(), 310000);
}

TEST_CASE("all integrators agree: silhouettes of coarse meshes", "[equality][cases][long]")
{
    check_cases(silhouette_cases(), 330000);
}

TEST_CASE("all integrators agree: many lights", "[equality][cases][tree][long]")
{
    check_cases(many_light_cases(), 400000);
}

TEST_CASE("a tree of lights changes noise only", "[equality][tree][long]")
{
    std::uint64_t seed = 410000;
    for (const EqualityCase& test : many_light_cases()) {
        const Scene scene(test.scene);
        for (const auto kind : {IntegratorKind::mis, IntegratorKind::bdpt}) {
            RenderOptions power = options(test, kind, ++seed);
            power.sampling.lights = LightSampling::power;
            RenderOptions tree = options(test, kind, ++seed);
            tree.sampling.lights = LightSampling::tree;
            TileMeans by_power(scene, test.camera, power);
            TileMeans by_tree(scene, test.camera, tree);
            check_equal(test, "power = tree", by_power, by_tree);
        }
    }
}

TEST_CASE("all integrators agree: what moves", "[equality][cases][motion][long]")
{
    check_cases(motion_cases(), 420000);
}

TEST_CASE("all integrators agree: media", "[equality][cases][media][long]")
{
    check_cases(media_cases(), 450000);
}

TEST_CASE("all integrators agree: light profiles", "[equality][cases][profiles][long]")
{
    check_cases(profile_cases(), 430000);
}

TEST_CASE("all integrators agree: mip-mapped textures", "[equality][cases][textures][long]")
{
    check_cases(mip_map_cases(), 440000);
}

namespace {

/// A room with a rough sphere of glass, under a lamp of one colour.
Scene glass_under(Rgb light, float ior, float dispersion)
{
    MaterialDesc material = glass(0.35f);
    material.ior = ior;
    material.dispersion = dispersion;
    SceneBuilder builder;
    builder.walls(lambertian(Rgb(0.7f)), lambertian(Rgb(0.5f))).ceiling(lambertian(Rgb(0.7f)));
    builder.lamp(0.98f, 0.85f, light);
    builder.sphere({0.0f, -0.4f, 0.0f}, 0.55f, material);
    return Scene(std::move(builder.desc));
}

/// A sphere of smooth glass in front of a sky of one colour that is bright on one side.
Scene glass_before_sky(Rgb light, float ior, float dispersion)
{
    MaterialDesc material = glass(0.0f);
    material.ior = ior;
    material.dispersion = dispersion;
    SceneBuilder builder;
    builder.sphere({0.0f, 0.0f, 0.0f}, 0.8f, material);
    Image sky{.width = 16, .height = 2, .pixels = {}};
    for (int i = 0; i < 32; ++i) {
        sky.pixels.push_back((i % 4 < 2 ? 1.0f : 0.05f) * light);
    }
    builder.light(EnvironmentLightDesc{.radiance = std::move(sky)});
    return Scene(std::move(builder.desc));
}

}  // namespace

TEST_CASE("each channel of a sky behind glass refracts as if there were no other",
          "[equality][layers]")
{
    // Indices of 1.25 and 1.75.
    const auto [light, ior] =
        GENERATE(std::pair(Rgb(4.0f, 0.0f, 0.0f), 1.25f), std::pair(Rgb(0.0f, 0.0f, 4.0f), 1.75f));
    const Scene alone = glass_before_sky(light, ior, 0.0f);
    const Scene dispersing = glass_before_sky(light, 1.5f, 20.0f);
    EqualityCase test;
    test.name = "sky behind glass of index " + std::to_string(ior);
    test.camera = room_camera();
    test.detectable_bias = 0.04;
    TileMeans expected(alone, test.camera, options(test, IntegratorKind::pt, 8011));
    TileMeans pt(dispersing, test.camera, options(test, IntegratorKind::pt, 8012));
    TileMeans bdpt(dispersing, test.camera, options(test, IntegratorKind::bdpt, 8013));
    check_equal(test, "no dispersion = pt", expected, pt);
    check_equal(test, "no dispersion = bdpt", expected, bdpt);
}

TEST_CASE("each channel refracts as if there were no other", "[equality][layers][long]")
{
    // Indices of 1.25, 1.5 and 1.75.
    const auto [light, ior] =
        GENERATE(std::pair(Rgb(4.0f, 0.0f, 0.0f), 1.25f), std::pair(Rgb(0.0f, 4.0f, 0.0f), 1.5f),
                 std::pair(Rgb(0.0f, 0.0f, 4.0f), 1.75f));
    const Scene alone = glass_under(light, ior, 0.0f);
    const Scene dispersing = glass_under(light, 1.5f, 20.0f);
    EqualityCase test;
    test.name = "glass of index " + std::to_string(ior);
    test.camera = room_camera();
    test.detectable_bias = 0.04;
    TileMeans expected(alone, test.camera, options(test, IntegratorKind::mis, 8001));
    TileMeans mis(dispersing, test.camera, options(test, IntegratorKind::mis, 8002));
    RenderOptions two_light_paths = options(test, IntegratorKind::bdpt, 8003);
    two_light_paths.bidirectional.light_paths = 2;  // both of the colour of their sample
    TileMeans bdpt(dispersing, test.camera, two_light_paths);
    RenderOptions shared = options(test, IntegratorKind::bdpt, 8004);
    shared.bidirectional.light_paths = 0.5;
    shared.bidirectional.connections = 1.5;
    TileMeans sharing(dispersing, test.camera, shared);
    check_equal(test, "no dispersion = mis", expected, mis);
    check_equal(test, "no dispersion = bdpt", expected, bdpt);
    check_equal(test, "no dispersion = bdpt with shared light paths", expected, sharing);
}

/// Camera paths and splats see pixels through the same filter, at the border of the image too: a
/// wide one makes most of the tiles border.
TEST_CASE("mis and bdpt agree through every pixel filter", "[equality][filter]")
{
    const auto cases = equality_cases();
    const EqualityCase& test = cases.front();
    const Scene scene(test.scene);
    std::uint64_t seed = 7000;
    for (const FilterOptions filter : {FilterOptions{.kind = FilterKind::gaussian},
                                       {.kind = FilterKind::gaussian, .radius = 8.0f},
                                       {.kind = FilterKind::tent, .radius = 0.4f},
                                       {.kind = FilterKind::blackman_harris, .radius = 6.0f}}) {
        RenderOptions mis_options = options(test, IntegratorKind::mis, ++seed);
        RenderOptions bdpt_options = options(test, IntegratorKind::bdpt, ++seed);
        mis_options.film.filter = filter;
        bdpt_options.film.filter = filter;
        TileMeans mis(scene, test.camera, mis_options);
        TileMeans bdpt(scene, test.camera, bdpt_options);
        check_equal(test, "mis = bdpt, filtered", mis, bdpt);
    }
}

TEST_CASE("a tiny sphere lights like a point", "[equality]")
{
    const auto scene_with = [](float radius) {
        SceneBuilder builder;
        builder.walls(lambertian(Rgb(0.7f)), lambertian({0.7f, 0.5f, 0.3f}));
        builder.ceiling(lambertian(Rgb(0.7f)));
        builder.sphere({0.4f, -0.6f, 0.0f}, 0.4f, plastic({0.6f, 0.1f, 0.1f}, 0.5f));
        builder.light(PointLightDesc{
            .position = {-0.3f, 0.5f, 0.3f}, .intensity = Rgb(2.0f), .radius = radius});
        return Scene(std::move(builder.desc));
    };
    const Scene point = scene_with(0.0f);
    for (const float radius : {1e-3f, 1e-6f}) {
        const Scene ball = scene_with(radius);
        std::uint64_t seed = 5000;
        for (const auto kind : {IntegratorKind::mis, IntegratorKind::bdpt}) {
            // The camera looks past the sphere, which it would see as a very bright pixel.
            EqualityCase test;
            test.name = "tiny sphere";
            test.max_depth = 2;
            test.camera = camera_at({0.0f, 0.0f, 3.4f}, {0.1f, -0.5f, 0.0f}, 0.3f);
            TileMeans expected(point, test.camera, options(test, kind, ++seed));
            TileMeans found(ball, test.camera, options(test, kind, ++seed));
            check_equal(test, "point = sphere", expected, found);
        }
    }
}

TEST_CASE("Sobol points and independent numbers agree", "[equality][long]")
{
    const auto cases = equality_cases();
    for (const char* name : {"area light", "all kinds of light", "half transmission"}) {
        DYNAMIC_SECTION(name)
        {
            const auto test = std::find_if(cases.begin(), cases.end(),
                                           [&](const auto& c) { return c.name == name; });
            REQUIRE(test != cases.end());
            check_samplers(*test, 100000);
        }
    }
}

}  // namespace bdpt::test::equality_test
