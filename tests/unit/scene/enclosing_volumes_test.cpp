#include "scene/enclosing_volumes.h"

#include "catch.hpp"
#include "scene/world.h"
#include "scene_builder.h"

#include <bdpt/error.h>
#include <bdpt/render.h>

#include <cmath>
#include <string>
#include <utility>

namespace bdpt::test::enclosing_volumes_test {
using test::SceneBuilder;

namespace {

/// Absorbs by `absorption` [1/m].
MaterialDesc medium(Rgb absorption, float ior)
{
    MaterialDesc material = test::glass(0.0f);
    material.ior = ior;
    material.attenuation_distance = 1.0f;
    material.attenuation_color = {std::exp(-absorption.r), std::exp(-absorption.g),
                                  std::exp(-absorption.b)};
    return material;
}

const Rgb of_outer(0.5f, 0.2f, 0.1f);
const Rgb of_inner(0.1f, 0.9f, 0.3f);

/// A cube of width 2 with one of width 0.8 in it.
SceneBuilder cubes(float outer_ior, float inner_ior)
{
    SceneBuilder builder;
    builder.cube({}, 1.0f, medium(of_outer, outer_ior));
    builder.cube({0.1f, 0.0f, -0.2f}, 0.4f, medium(of_inner, inner_ior));
    return builder;
}

void check_absorption(const World& world, Vec3 p, Rgb expected)
{
    const Rgb extinction = world.media()[world.medium_at(p)].extinction;
    CHECK(extinction.r == Approx(expected.r));
    CHECK(extinction.g == Approx(expected.g));
    CHECK(extinction.b == Approx(expected.b));
}

/// What a ray straight down meets.
SurfacePoint met(const World& world, Vec3 from)
{
    const auto point = world.intersect({.p = from}, {0.0f, 0.0f, -1.0f}, {});
    REQUIRE(point.has_value());
    return *point;
}

/// Mean over an image of one ray after another straight down.
Rgb seen_down(SceneDesc desc, Vec3 from)
{
    const Scene scene(std::move(desc));
    CameraDesc camera;
    camera.world_from_camera[3] = Vec4(from, 1.0f);
    camera.vertical_fov = 0.001f;
    RenderOptions options;
    options.integrator = IntegratorKind::pt;
    options.film.width = 1;
    options.film.height = 1;
    options.sampling.samples = {0, 4000};
    options.transport.max_depth = 12;
    options.transport.rr_start = options.transport.max_depth;
    return render(scene, camera, options).film.develop().pixels.at(0);
}

/// F at normal incidence.
double fresnel(double a, double b)
{
    return (a - b) * (a - b) / ((a + b) * (a + b));
}

}  // namespace

TEST_CASE("points know which body they are in, the innermost one", "[bodies]")
{
    const World world(std::move(cubes(1.33f, 1.5f).desc));
    check_absorption(world, {0.1f, 0.0f, -0.2f}, of_inner);
    check_absorption(world, {0.8f, 0.7f, 0.6f}, of_outer);
    check_absorption(world, {1.8f, 0.7f, 0.6f}, Rgb(0.0f));
    check_absorption(World(SceneDesc{}), {}, Rgb(0.0f));
}

TEST_CASE("sphere lights do not hide which body a point is in", "[bodies]")
{
    SceneBuilder builder = cubes(1.33f, 1.5f);
    // So many around the first point that each ray from there meets one.
    const Vec3 within(0.1f, 0.0f, -0.2f);
    for (int i = 0; i < 27; ++i) {
        const Vec3 corner(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (corner != Vec3(0.0f)) {
            builder.light(PointLightDesc{.position = within + 0.2f * normalize(corner),
                                         .intensity = Rgb(1.0f),
                                         .radius = 0.11f});
        }
    }
    const World world(std::move(builder.desc));
    check_absorption(world, within, of_inner);
    check_absorption(world, {0.55f, 0.0f, 0.9f}, of_outer);
    check_absorption(world, {0.0f, 0.0f, 1.2f}, Rgb(0.0f));
}

TEST_CASE("a segment has the medium of the body around what it joins", "[bodies]")
{
    SceneBuilder builder = cubes(1.33f, 1.5f);
    builder.cube({-0.6f, 0.0f, 0.5f}, 0.1f, test::lambertian(Rgb(0.5f)));
    builder.cube({-0.6f, 0.0f, 0.0f}, 0.1f, test::lambertian(Rgb(0.5f)));
    builder.cube({-0.6f, 0.0f, 1.0f}, 0.1f, test::lambertian(Rgb(0.5f)));  // half out of it
    const World world(std::move(builder.desc));
    // Two stones in the outer body: neither bounds it.
    const SurfacePoint below = met(world, {-0.6f, 0.0f, 0.3f});
    const auto above = world.intersect({.p = {-0.6f, 0.0f, 0.3f}}, {0, 0, 1}, {});
    REQUIRE(above.has_value());
    const Rgb between = world.transmittance(below.end, above->end, {});
    CHECK(between.r == Approx(std::exp(-of_outer.r * 0.3f)));
    CHECK(between.g == Approx(std::exp(-of_outer.g * 0.3f)));
    CHECK(world.transmittance(above->end, below.end, {}) == between);
    // In the inner body, and from it to the boundary of the outer one.
    const SurfacePoint top = met(world, {0.1f, 0.0f, 0.9f});
    CHECK(world.transmittance({.p = {0.1f, 0.0f, 0.9f}}, top.end, {}).r ==
          Approx(std::exp(-of_outer.r * 0.7f)));
    const SurfacePoint bottom = met(world, {0.1f, 0.0f, 0.0f});
    CHECK(world.transmittance(top.end, bottom.end, {}).g == Approx(std::exp(-of_inner.g * 0.8f)));
    // Where a stone is not wholly within, the other end may know.
    CHECK(met(world, {-0.6f, 0.0f, 2.0f}).end.media.are_clear());
}

TEST_CASE("light through nested bodies is absorbed by each over its own way", "[bodies]")
{
    // All of index 1, so that boundaries cannot be seen.
    SceneBuilder builder = cubes(1.0f, 1.0f);
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1)}}});
    const auto expected = [](float outer, float inner, int channel) {
        return std::exp(-of_outer[channel] * outer - of_inner[channel] * inner);
    };
    const Rgb through = seen_down(builder.desc, {0.1f, 0.0f, 3.0f});
    const Rgb beside = seen_down(builder.desc, {-0.8f, 0.0f, 3.0f});
    const Rgb from_within = seen_down(builder.desc, {0.1f, 0.0f, -0.1f});
    for (int channel = 0; channel < 3; ++channel) {
        CHECK(through[channel] == Approx(expected(1.2f, 0.8f, channel)).epsilon(1e-4));
        CHECK(beside[channel] == Approx(expected(2.0f, 0.0f, channel)).epsilon(1e-4));
        CHECK(from_within[channel] == Approx(expected(0.4f, 0.5f, channel)).epsilon(1e-4));
    }
}

TEST_CASE("a body in one of its own index cannot be seen, another one by the quotient", "[bodies]")
{
    const auto weigh = [](float outer, float inner) {
        const World world(std::move(cubes(outer, inner).desc));
        const SurfacePoint top = met(world, {0.1f, 0.0f, 0.9f});
        // The density of a delta lobe holds its probability, which is F here.
        const auto reflected = top.bsdf.sample(0.0f, {}, TransportMode::radiance);
        const auto passed = top.bsdf.sample(0.9999f, {}, TransportMode::radiance);
        REQUIRE((reflected && passed));
        CHECK(passed->wi.z == Approx(-1.0));
        // Radiance grows by the square of the index.
        CHECK(passed->weight.x == Approx(outer * outer / (inner * inner)).epsilon(1e-4));
        return reflected->wi.z > 0.0f ? reflected->pdf_rev.value : 0.0f;
    };
    CHECK(weigh(1.4f, 1.4f) == 0.0f);
    CHECK(weigh(1.3f, 1.7f) == Approx(fresnel(1.7, 1.3)).epsilon(1e-3));
    // Seen from the denser side its density has the square of that index.
    const double quotient = 1.7 / 1.2;
    CHECK(weigh(1.7f, 1.2f) == Approx(fresnel(1.7, 1.2) * quotient * quotient).epsilon(1e-3));
}

TEST_CASE("a bubble of air in glass reflects in full what comes at a grazing angle", "[bodies]")
{
    const World world(std::move(cubes(1.5f, 1.0f).desc));
    const Vec3 steep = normalize(Vec3{0.5f, 0.0f, -1.0f});  // 27 degrees
    const Vec3 flat = normalize(Vec3{1.5f, 0.0f, -1.0f});   // 56 degrees, beyond 41.8
    const Vec3 target(0.1f, 0.0f, 0.2f);
    for (const Vec3 direction : {steep, flat}) {
        const auto point = world.intersect({.p = target - 0.5f * direction}, direction, {});
        REQUIRE(point.has_value());
        const auto sampled = point->bsdf.sample(0.9999f, {}, TransportMode::radiance);
        REQUIRE(sampled.has_value());
        if (direction == flat) {
            CHECK(sampled->wi.z == Approx(-direction.z));
            CHECK(sampled->wi.x == Approx(direction.x));
        } else {
            CHECK(sampled->wi.x == Approx(1.5f * direction.x));
            CHECK(sampled->wi.z < 0.0f);
        }
    }
}

TEST_CASE("what lies in a body only partly keeps air around it", "[bodies]")
{
    SceneBuilder builder;
    builder.cube({}, 1.0f, medium(of_outer, 1.33f));
    builder.cube({0.0f, 0.0f, 1.0f}, 0.3f, medium(of_inner, 1.31f));
    const World world(std::move(builder.desc));
    const SurfacePoint top = met(world, {0.0f, 0.0f, 2.0f});
    const auto reflected = top.bsdf.sample(0.0f, {}, TransportMode::radiance);
    REQUIRE(reflected.has_value());
    CHECK(reflected->pdf_fwd.value == Approx(fresnel(1.31, 1.0)).epsilon(1e-3));
    CHECK(top.end.media.behind != MediumId::clear);
    CHECK(top.end.media.ahead == MediumId::clear);
}

TEST_CASE("a turned mesh that stands in a body is not within it", "[bodies]")
{
    // Each sector has a triangle of the bottom, which is in the water, two of the side, and one of
    // the top.
    constexpr unsigned sectors = 64;
    MeshDesc stem;
    stem.positions = {{0.0f, -0.2f, 0.0f}, {0.0f, 3.0f, 0.0f}};
    for (unsigned i = 0; i < sectors; ++i) {
        const float turn = 6.2831853f * static_cast<float>(i) / sectors;
        for (const float y : {-0.2f, 3.0f}) {
            stem.positions.emplace_back(0.3f * std::cos(turn), y, -0.3f * std::sin(turn));
        }
        const unsigned a = 2 + 2 * i;
        const unsigned b = 2 + 2 * ((i + 1) % sectors);
        stem.triangles.insert(stem.triangles.end(),
                              {{0, b, a}, {a, b, b + 1}, {a, b + 1, a + 1}, {1, a + 1, b + 1}});
    }
    SceneBuilder builder;
    builder.cube({}, 1.0f, medium(of_outer, 1.33f));
    builder.place(builder.add_mesh(std::move(stem)), medium(of_inner, 1.5f), Mat4(1.0f));
    builder.light(PointLightDesc{});
    const World world(std::move(builder.desc));
    CHECK(world.warnings().empty());
    const auto top = world.intersect({.p = {0.1f, 4.0f, 0.1f}}, {0, -1, 0}, {});
    REQUIRE(top.has_value());
    CHECK(top->end.p.y == Approx(3.0f));
    CHECK(top->end.media.ahead == MediumId::clear);
}

TEST_CASE("of too many bodies it is said that air is around them", "[bodies]")
{
    const auto count_warnings = [](std::size_t bodies) {
        SceneBuilder builder;
        builder.cube({}, 1.0f, medium(of_outer, 1.33f));
        builder.desc.instances.resize(bodies, builder.desc.instances.front());
        builder.light(PointLightDesc{});
        const World world(std::move(builder.desc));
        CHECK((world.medium_at({0.1f, 0.2f, 0.3f}) != MediumId::clear) ==
              (bodies <= EnclosingVolumes::most));
        return world.warnings().size();
    };
    CHECK(count_warnings(EnclosingVolumes::most) == 0);
    CHECK(count_warnings(EnclosingVolumes::most + 1) == 1);
}

TEST_CASE("bodies with holes are judged by most rays", "[bodies]")
{
    SceneBuilder builder = cubes(1.33f, 1.5f);
    builder.desc.meshes[0].triangles.erase(builder.desc.meshes[0].triangles.begin() + 2);
    builder.light(PointLightDesc{});
    const World world(std::move(builder.desc));
    check_absorption(world, {0.8f, 0.7f, 0.6f}, of_outer);
    check_absorption(world, {1.8f, 0.7f, 0.6f}, Rgb(0.0f));
    CHECK(world.warnings().size() == 1);
}

TEST_CASE("bodies that lie one in the other are found, up to a limit of their number", "[bodies]")
{
    const auto nested = [](int count) {
        SceneBuilder builder;
        for (int i = 0; i < count; ++i) {
            const Rgb absorption(0.1f + 0.01f * static_cast<float>(i));
            builder.cube({}, 1.0f - 0.9f * static_cast<float>(i) / static_cast<float>(count),
                         medium(absorption, 1.3f));
        }
        return std::move(builder.desc);
    };
    const int most = static_cast<int>(EnclosingVolumes::max_depth);
    const World world(nested(most));
    check_absorption(world, Vec3(0.01f), Rgb(0.1f + 0.01f * static_cast<float>(most - 1)));
    check_absorption(world, {0.995f, 0.0f, 0.0f}, Rgb(0.1f));
    try {
        const World too_deep(nested(1000));
        FAIL("was not refused");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(std::string(error.what()).find("but the limit is 64") != std::string::npos);
    }
}

TEST_CASE("bonded bodies enclose what they enclosed", "[enclosing]")
{
    // Three cubes in a row, with one boundary for each two, and a ball in the middle one.
    SceneBuilder builder;
    builder.cube({-2.0f, 0.0f, 0.0f}, 1.0f, medium(of_outer, 1.5f));
    builder.cube({0.0f, 0.0f, 0.0f}, 1.0f, medium(of_inner, 1.3f));
    builder.cube({2.0f, 0.0f, 0.0f}, 1.0f, medium(of_outer, 1.5f));
    builder.cube({0.0f, 0.1f, 0.0f}, 0.3f, medium(Rgb(0.7f), 2.0f));
    const World world(builder.desc);
    REQUIRE(world.geometry().contacts.bonded_pairs == 2);
    check_absorption(world, {-2.0f, 0.3f, 0.2f}, of_outer);
    check_absorption(world, {0.7f, 0.3f, 0.2f}, of_inner);
    check_absorption(world, {2.0f, 0.3f, 0.2f}, of_outer);
    check_absorption(world, {0.1f, 0.2f, 0.1f}, Rgb(0.7f));
    check_absorption(world, {0.0f, 1.2f, 0.0f}, Rgb(0.0f));
    check_absorption(world, {3.2f, 0.0f, 0.0f}, Rgb(0.0f));
    // The ball has the middle cube around it, and so has the boundary of the first.
    const Media& media = world.media();
    CHECK(media[met(world, {0.05f, 0.12f, 0.9f}).end.media.ahead].extinction.r ==
          Approx(of_inner.r));
    const auto boundary = world.intersect({.p = {-0.5f, 0.7f, 0.3f}}, {-1.0f, 0.0f, 0.0f}, {});
    REQUIRE(boundary.has_value());
    CHECK(media[boundary->end.media.ahead].extinction.g == Approx(of_inner.g));
    CHECK(media[boundary->end.media.behind].extinction.g == Approx(of_outer.g));
}

}  // namespace bdpt::test::enclosing_volumes_test
