#include "scene/media.h"

#include "catch.hpp"
#include "scene/world.h"
#include "scene_builder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace bdpt::media_test {
namespace {

const Rgb chromatic(0.5f, 1.0f, 3.0f);
const Vec3 down(0.0f, 0.0f, -1.0f);
const ChannelChoice white(Rgb(1.0f));

Medium scattering(Rgb extinction, float albedo = 0.5f)
{
    return {.extinction = extinction, .scattering = albedo * extinction};
}

SegmentEnd in(MediumId medium, Vec3 p = Vec3(0.0f))
{
    SegmentEnd end;
    end.p = p;
    end.media = SideMedia::around(medium);
    return end;
}

/// On a surface that looks up, with `medium` below it.
SegmentEnd above(MediumId medium, Vec3 p = Vec3(0.0f))
{
    SegmentEnd end = in(MediumId::clear, p);
    end.ng = -down;
    end.media.behind = medium;
    return end;
}

double mean(Rgb value)
{
    return (static_cast<double>(value.r) + static_cast<double>(value.g) +
            static_cast<double>(value.b)) /
           3.0;
}

}  // namespace

TEST_CASE("equal bodies share a medium, which is not that of equal fog", "[media]")
{
    Media media;
    const Medium milk = scattering(chromatic);
    const MediumId fog = media.add_fog(milk, {.center = Vec3(0.0f), .radius = 1.0f});
    const MediumId body = media.add(milk);
    CHECK(body != fog);
    for (int i = 0; i < 3; ++i) {
        CHECK(media.add(milk) == body);
    }
    CHECK(media.add(scattering(chromatic, 0.6f)) != body);
}

TEST_CASE("a medium is known from either end, and the rule is symmetric", "[media]")
{
    Media media;
    const MediumId tint = media.add({.extinction = {1, 2, 0}});
    const SegmentEnd glass = above(tint);
    const SegmentEnd opaque = above(MediumId::clear, {0, 0, -1});
    const Rgb one_way = media.transmission(glass, opaque, down, 1.0f).transmittance;
    CHECK(one_way.r == Approx(std::exp(-1.0f)));
    CHECK(one_way.g == Approx(std::exp(-2.0f)));
    CHECK(one_way.b == 1.0f);
    CHECK(media.transmission(opaque, glass, -down, 1.0f).transmittance == one_way);
    // Leaves on the outside.
    CHECK(media.transmission(glass, opaque, -down, 1.0f).transmittance == Rgb(1.0f));
    CHECK(media.transmission(glass, opaque, down, 1.0f).p_unscattered ==
          1.0f);  // nobody is scattered there
    CHECK_FALSE(media.scatter(glass, opaque, down));
    CHECK(media.add({.extinction = {1, 2, 0}}) == tint);
    CHECK(media.add({}) == MediumId::clear);
}

TEST_CASE("where two ends disagree, the denser medium that scatters counts alone", "[media]")
{
    Media media;
    const MediumId tint = media.add({.extinction = Rgb(9.0f)});
    const MediumId thin = media.add(scattering(Rgb(0.5f)));
    const MediumId dense = media.add(scattering(Rgb(2.0f)));
    const auto transmittance = [&](MediumId a, MediumId b) {
        const float there = media.transmission(in(a), in(b), down, 1.0f).transmittance.r;
        CHECK(media.transmission(in(b), in(a), -down, 1.0f).transmittance.r == there);
        return there;
    };
    CHECK(transmittance(tint, thin) == Approx(std::exp(-0.5f)));
    CHECK(transmittance(dense, thin) == Approx(std::exp(-2.0f)));
    CHECK(transmittance(dense, MediumId::clear) == Approx(std::exp(-2.0f)));
    CHECK(transmittance(tint, MediumId::clear) == Approx(std::exp(-9.0f)));
}

TEST_CASE("walks are scattered with the density that is told", "[media]")
{
    const Rgb beta = GENERATE(Rgb(2.0f), Rgb(0.5f, 0.2f, 0.3f), Rgb(0.0f, 1.0f, 1.0f));
    const ChannelChoice channels(beta);
    Media media;
    const MediumId id = media.add(scattering(chromatic));
    const SegmentEnd start = in(id);
    const SegmentEnd end = in(id, {0, 0, -1.5f});
    constexpr int bins = 30;
    constexpr int count = 300000;
    std::vector<double> counts(bins + 1);
    for (int i = 0; i < count; ++i) {
        constexpr int channel_numbers = 30;
        const Vec2 u((static_cast<float>(i) + 0.5f) / count,
                     (static_cast<float>(i % channel_numbers) + 0.5f) / channel_numbers);
        const auto event = media.draw_event(start, end, down, 1.5f, channels, u);
        if (event) {
            REQUIRE(event->medium == id);
            REQUIRE(event->distance <= 1.5f);
        }
        counts[event ? static_cast<std::size_t>(event->distance / 1.5f * bins) : bins] += 1.0;
    }
    std::vector<double> probabilities(bins + 1);
    constexpr int steps = 64;
    for (int i = 0; i < bins * steps; ++i) {
        const float distance = 1.5f * (static_cast<float>(i) + 0.5f) / (bins * steps);
        const SegmentEnd there = in(id, distance * down);
        const SegmentTransmission transmission = media.transmission(start, there, down, distance);
        const float density =
            media.walk_density(start, there, down, transmission.transmittance, channels, true);
        if (beta == Rgb(2.0f)) {
            REQUIRE(transmission.pdf_scatter == Approx(density));
        }
        // Distances do not change the sum of the throughput.
        const Rgb after = beta * transmission.transmittance * media[id].extinction / density;
        REQUIRE(mean(after) == Approx(mean(beta)));
        probabilities[static_cast<std::size_t>(i / steps)] +=
            static_cast<double>(density) * 1.5 / (bins * steps);
    }
    const SegmentTransmission whole = media.transmission(start, end, down, 1.5f);
    const float through =
        media.walk_density(start, end, down, whole.transmittance, channels, false);
    probabilities[bins] = static_cast<double>(through);
    CHECK(mean(beta * whole.transmittance / through) == Approx(mean(beta)));
    CHECK(whole.p_unscattered == Approx(mean(whole.transmittance)));
    CHECK(whole.transmittance.b == Approx(std::exp(-4.5f)));
    double sum = 0.0;
    for (std::size_t i = 0; i <= bins; ++i) {
        sum += probabilities[i];
        // Even numbers: far less noise than that of counting.
        CHECK(counts[i] / count == Approx(probabilities[i]).margin(5e-5));
    }
    CHECK(sum == Approx(1.0).epsilon(1e-4));
}

TEST_CASE("the mean free path is one over the extinction", "[media]")
{
    Media media;
    const MediumId id = media.add(scattering(Rgb(4.0f), 1.0f));
    double sum = 0.0;
    constexpr int count = 100000;
    for (int i = 0; i < count; ++i) {
        const Vec2 u((static_cast<float>(i) + 0.5f) / count, 0.4f);
        const auto event =
            media.draw_event(in(id), {}, down, std::numeric_limits<float>::max(), white, u);
        REQUIRE(event.has_value());
        sum += static_cast<double>(event->distance) / count;
    }
    CHECK(sum == Approx(0.25).epsilon(1e-3));
    // Nothing gets through.
    const SegmentTransmission out =
        media.transmission(in(id), {}, down, std::numeric_limits<float>::max());
    CHECK(out.transmittance == Rgb(0.0f));
    CHECK(out.p_unscattered == 0.0f);
}

TEST_CASE("fog ends at its sphere, from wherever one looks", "[media]")
{
    Media media;
    const MediumId fog = media.add_fog(scattering(Rgb(0.5f)), {.center = {0, 0, 1}, .radius = 2});
    // As dense, but not fog: it has no end.
    const MediumId body = media.add(scattering(Rgb(0.5f)));
    CHECK(body != fog);
    const auto depth = [&](MediumId medium, Vec3 from, Vec3 to) {
        const float distance = glm::distance(from, to);
        const Vec3 along = to - from;
        const float left =
            media.transmission(in(medium, from), in(medium, to), along, distance).transmittance.g;
        CHECK(media.transmission(in(medium, to), in(medium, from), -along, distance)
                  .transmittance.g == Approx(left).epsilon(1e-5));
        return -std::log(left) / 0.5f;
    };
    CHECK(depth(fog, {0, 0, 9}, {0, 0, -9}) == Approx(4.0f).epsilon(1e-4));
    CHECK(depth(fog, {0, 0, 9}, {0, 0, 1}) == Approx(2.0f).epsilon(1e-4));
    CHECK(depth(fog, {0, 1, 0}, {0, 1, 1}) == Approx(1.0f).epsilon(1e-4));
    CHECK(depth(fog, {0, 2.1f, 9}, {0, 2.1f, -9}) == 0.0f);
    CHECK(depth(fog, {0, 0, 5}, {0, 0, 4}) == 0.0f);
    CHECK(depth(body, {0, 0, 9}, {0, 0, -9}) == Approx(18.0f).epsilon(1e-4));
    const SegmentEnd far = in(fog, {0, 0, 100});
    const auto event =
        media.draw_event(far, {}, down, std::numeric_limits<float>::max(), white, {0.25f, 0.0f});
    REQUIRE(event.has_value());
    CHECK(event->distance == Approx(97.0 + 2.0 * -std::log(0.75)));
    CHECK_FALSE(
        media.draw_event(far, {}, -down, std::numeric_limits<float>::max(), white, {0.999f, 0}));
}

TEST_CASE("walks scatter until they are absorbed or leave the body", "[media]")
{
    const Medium milk{.extinction = Rgb(10.0f), .scattering = Rgb(9.0f)};
    CHECK(milk.mean_scatterings(0.0f) == 1.0f);
    CHECK(milk.mean_scatterings(0.1f) == Approx(1.9f));     // leaves
    CHECK(milk.mean_scatterings(100.0f) == Approx(10.0f));  // is absorbed
    Medium forward = milk;
    forward.anisotropy = 0.5f;
    CHECK(forward.mean_scatterings(0.1f) == Approx(1.45f));
    CHECK(forward.mean_scatterings(100.0f) == Approx(5.5f));
    const Medium bright{.extinction = Rgb(10.0f), .scattering = Rgb(10.0f)};
    CHECK(bright.mean_scatterings(0.1f) == Approx(2.0f));
    CHECK(bright.mean_scatterings(100.0f) == Approx(30.0f));
    const Medium red{.extinction = {10.0f, 10.0f, 0.0f}, .scattering = {9.0f, 0.0f, 0.0f}};
    CHECK(red.mean_scatterings(100.0f) == Approx((10.0f + 1.0f + 1.0f) / 3.0f));
}

TEST_CASE("media know the largest body that they fill", "[media]")
{
    test::SceneBuilder builder;
    MaterialDesc milk = test::glass(0.0f);
    milk.attenuation_color = Rgb(0.5f);
    milk.attenuation_distance = 0.5f;
    milk.volume_scatter.color = Rgb(0.8f);
    builder.cube({-4, 0, 0}, 0.1f, milk);
    builder.cube({4, 0, 0}, 1.0f, milk);
    builder.cube({0, 0, 0}, 0.2f, milk);
    builder.desc.instances.back().world_from_object *= 0.5f;
    builder.desc.instances.back().world_from_object[3][3] = 1.0f;
    builder.desc.fog = MediumDesc{.extinction = Rgb(0.1f), .albedo = Rgb(0.9f)};
    const World world(std::move(builder.desc));
    const Media& media = world.media();
    const MediumId id = world.medium_at({4, 0, 0});
    REQUIRE(world.medium_at({-4, 0, 0}) == id);
    // A cube of edge 2 has a mean chord of 4/3.
    CHECK(media.mean_scatterings(id) == Approx(media[id].mean_scatterings(4.0f / 3.0f)));
    CHECK(media.mean_scatterings(id) > 1.5f);
    CHECK(media.mean_scatterings(media.fog()) == 1.0f);
    CHECK(media.mean_scatterings(MediumId::clear) == 1.0f);
}

TEST_CASE("fog is around bodies and lights, and what bodies hold within them", "[media]")
{
    test::SceneBuilder builder;
    builder.cube({}, 1.0f, test::glass(0.0f));
    MaterialDesc milk = test::glass(0.0f);
    milk.attenuation_color = Rgb(0.5f);
    milk.attenuation_distance = 0.1f;
    milk.volume_scatter = {.color = Rgb(0.8f), .anisotropy = 0.3f};
    builder.cube({4, 0, 0}, 1.0f, milk);
    // A shade that lets light through, but holds nothing: no fog gets in.
    MaterialDesc shade = test::lambertian(Rgb(0.5f));
    shade.thickness = 1.0f;
    shade.diffuse_transmission.factor = 1.0f;
    builder.cube({-4, 0, 0}, 1.0f, shade);
    builder.cube({-4, 0, 0}, 0.2f, test::lambertian(Rgb(0.5f)));
    builder.light(PointLightDesc{.position = {-4, 0.5f, 0}, .intensity = Rgb(1.0f)});
    builder.light(PointLightDesc{.position = {0, 3, 0}, .intensity = Rgb(1.0f)});
    builder.light(DirectionalLightDesc{.illuminance = Rgb(1.0f)});
    builder.desc.fog = MediumDesc{.extinction = Rgb(0.1f), .albedo = Rgb(0.9f)};
    const World world(std::move(builder.desc));
    const auto extinction = [&world](MediumId id) { return world.media()[id].extinction.g; };
    CHECK(extinction(world.medium_at({0, 0, 2})) == 0.1f);
    CHECK(extinction(world.medium_at({0, 0, 0})) == 0.0f);
    CHECK(extinction(world.medium_at({4, 0, 0})) == Approx(std::log(2.0) / 0.1));
    CHECK(world.media()[world.medium_at({4, 0, 0})].anisotropy == 0.3f);
    CHECK(extinction(world.medium_at({-4, 0.5f, 0})) == 0.0f);
    const auto side_of = [&](Vec3 from) {
        const auto hit = world.intersect({.p = from}, {0, -1, 0}, {});
        REQUIRE(hit.has_value());
        return extinction(hit->end.media.ahead);
    };
    CHECK(side_of({0, 3, 0}) == 0.1f);
    CHECK(side_of({-4, 0.5f, 0}) == 0.0f);  // the thing within the shade
    const LightSet& lights = world.lights();
    CHECK(extinction(lights[LightId{0}].media().ahead) == 0.0f);
    CHECK(extinction(lights[LightId{1}].media().ahead) == 0.1f);
    CHECK(extinction(lights[LightId{2}].media().ahead) == 0.1f);
}

}  // namespace bdpt::media_test
