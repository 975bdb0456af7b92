#include "many_lights.h"

#include "catch.hpp"
#include "chi_square.h"
#include "math/rgb.h"
#include "scene/world.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace bdpt::many_lights_test {
namespace {

using test::Random;
using test::SceneBuilder;

constexpr auto by_tree = LightSampling::tree;

/// With light from infinity too.
SceneDesc everything(std::uint64_t seed, int count)
{
    SceneBuilder builder = test::random_lights(seed, count);
    builder.light(DirectionalLightDesc{.direction = {0.3f, -1.0f, 0.2f}, .illuminance = Rgb(0.5f)});
    builder.light(DirectionalLightDesc{.direction = {1.0f, 0.0f, 0.0f}, .illuminance = Rgb(0.1f)});
    builder.light(PointLightDesc{.intensity = Rgb(0.0f)});
    builder.desc.profiles.push_back({.polar_angles = {0.0f, 0.5f, 1.2f},
                                     .azimuths = {0.0f},
                                     .intensities = {1.0f, 2.0f, 0.5f}});
    builder.light(ProfileLightDesc{.position = {0.2f, 0.5f, -0.3f}, .scale = Rgb(3.0f)});
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1)}}});
    return std::move(builder.desc);
}

/// Somewhere about the cube; every third time within a light's own box or very near to it.
LightSampleContext random_context(const World& world, Random& random)
{
    Vec3 p = 1.5f * Vec3(random.next(), random.next(), random.next()) - 0.75f;
    const auto id =
        static_cast<std::uint32_t>(random.next() * static_cast<float>(world.lights().size()));
    if (const auto bounds = world.lights()[LightId{id}].bounds(); bounds && random.next() < 0.33f) {
        const float near = std::pow(10.0f, -6.0f * random.next());
        p = mix(bounds->min, bounds->max, Vec3(random.next(), random.next(), random.next())) +
            near * random.direction();
    }
    LightSampleContext receiver{.p = p};
    if (random.next() < 0.7f) {
        receiver.normal = random.direction();
    }
    return receiver;
}

std::vector<double> probabilities(const World& world, const LightSampleContext& receiver)
{
    std::vector<double> result;
    for (std::uint32_t id = 0; id < world.lights().size(); ++id) {
        result.push_back(static_cast<double>(
            world.lights().context_probability(LightId{id}, receiver, by_tree)));
    }
    return result;
}

}  // namespace

TEST_CASE("no light is lost that can shine at a point", "[light][tree]")
{
    int contributions = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const World world(everything(seed, 90));
        const LightSet& lights = world.lights();
        Random random(100 + seed);
        for (int i = 0; i < 60; ++i) {
            const LightSampleContext receiver = random_context(world, random);
            for (std::uint32_t id = 0; id < lights.size(); ++id) {
                const float chosen = lights.context_probability(LightId{id}, receiver, by_tree);
                for (int k = 0; k < 8; ++k) {
                    const auto incident = lights[LightId{id}].sample_incident(
                        receiver, random.next_2d(), EnvironmentSampling::plain, 0.0f);
                    const bool brings =
                        incident && !is_black(incident->weight) &&
                        (!receiver.normal || dot(*receiver.normal, incident->wi) > 0.0f);
                    contributions += brings ? 1 : 0;
                    if (brings && !(chosen > 0.0f)) {
                        CAPTURE(seed, i, id, incident->distance, incident->weight.g);
                        FAIL("a light that shines has the probability 0");
                    }
                }
            }
        }
    }
    CHECK(contributions > 100000);
}

TEST_CASE("lights are chosen as often as their probabilities say", "[light][tree]")
{
    constexpr int samples = 40000;
    constexpr double significance = 1e-4;
    int several = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const World world(everything(seed, 60));
        Random random(200 + seed);
        for (int i = 0; i < 12; ++i) {
            const LightSampleContext receiver = random_context(world, random);
            std::vector<double> expected = probabilities(world, receiver);
            std::vector<double> counts(expected.size() + 1, 0.0);
            for (int k = 0; k < samples; ++k) {
                const auto choice =
                    world.lights().choose_for_context(receiver, random.next_2d(), by_tree);
                const std::size_t id =
                    choice ? static_cast<std::size_t>(choice->id) : expected.size();
                if (choice) {
                    REQUIRE(static_cast<double>(choice->probability) ==
                            Approx(expected[id]).epsilon(1e-6));
                }
                counts[id] += 1.0;
            }
            double sum = 0.0;
            for (const double p : expected) {
                sum += p;
            }
            CHECK(sum <= 1.0 + 1e-5);
            // What is left is the chance that no light is chosen.
            expected.push_back(std::max(0.0, 1.0 - sum));
            if (expected.back() < 1e-6) {
                CHECK(counts.back() == 0.0);
                expected.pop_back();
                counts.pop_back();
            }
            const test::ChiSquare result = test::chi_square(counts, expected);
            if (result.degrees >= 1) {
                ++several;
                CAPTURE(seed, i, result.statistic, result.degrees);
                CHECK(result.p_value > test::sidak(significance, 36));
                CHECK(result.min_detectable(test::sidak(significance, 36)) < 0.1);
            }
        }
    }
    CHECK(several > 30);
}

TEST_CASE("lights are chosen as often as learned shares of their groups say", "[light][tree]")
{
    const World world(everything(4, 30));
    const LightSet& lights = world.lights();
    const std::size_t groups = lights.next_event_lights().group_count();
    REQUIRE(groups == 4);  // two suns, a sky, and all others
    std::vector<GroupShares::Finding> findings;
    for (std::uint32_t group = 0; group < groups; ++group) {
        findings.push_back({.group = group, .value = static_cast<float>(group + 1)});
    }
    const LearnedLight learned{.groups = GroupShares(findings, groups)};
    const NextEventSampling sampling{.lights = by_tree, .learned = &learned};
    const LightSampleContext receiver{.p = {0.1f, -0.2f, 0.3f}};
    std::vector<double> expected;
    double sum = 0.0;
    for (std::uint32_t id = 0; id < lights.size(); ++id) {
        expected.push_back(
            static_cast<double>(lights.next_event_probability(LightId{id}, receiver, sampling)));
        sum += expected.back();
    }
    REQUIRE(sum == Approx(1.0));
    std::vector<double> counts(expected.size(), 0.0);
    Random random(7);
    for (int i = 0; i < 40000; ++i) {
        const LightSet::NextEvent next = lights.sample_next_event(
            receiver, random.next_2d(), [&random] { return random.next_2d(); }, sampling, 0.0f);
        REQUIRE(next.probability > 0.0f);
        counts[static_cast<std::size_t>(next.light)] += 1.0;
    }
    const test::ChiSquare result = test::chi_square(counts, expected);
    CAPTURE(result.statistic, result.degrees);
    CHECK(result.degrees > 10);
    CHECK(result.p_value > 1e-4);
    CHECK(result.min_detectable(1e-4) < 0.1);
}

TEST_CASE("light from infinity has a share of its own", "[light][tree]")
{
    const World world(everything(3, 30));
    const LightSet& lights = world.lights();
    Random random(6);
    double placed = 0.0;
    std::vector<double> infinite;
    for (const double share : {0.0, 1.0}) {
        const LightSampleContext receiver{.p = Vec3(static_cast<float>(share))};
        placed = 0.0;
        infinite.clear();
        for (std::uint32_t id = 0; id < lights.size(); ++id) {
            const auto p =
                static_cast<double>(lights.context_probability(LightId{id}, receiver, by_tree));
            if (lights[LightId{id}].is_infinite()) {
                infinite.push_back(p);
            } else {
                placed += p;
            }
        }
        REQUIRE(infinite.size() == 3);
        const double sum = infinite[0] + infinite[1] + infinite[2];
        // Half of the choice is even among them and all placed lights, the other half is by power.
        constexpr double even = 0.5 / 4.0;
        CHECK(infinite[1] > even);
        CHECK(sum <= 1.0 - even);
        CHECK((infinite[0] - even) / (infinite[1] - even) == Approx(5.0));
        CHECK(placed + sum <= 1.0 + 1e-5);
    }
}

TEST_CASE("scenes of lights at infinity, or at places, alone", "[light][tree]")
{
    SceneBuilder sun;
    sun.light(DirectionalLightDesc{});
    const World far(std::move(sun.desc));
    CHECK(far.lights().context_probability(LightId{0}, LightSampleContext{}, by_tree) == 1.0f);
    CHECK(
        far.lights().choose_for_context(LightSampleContext{}, {0.9f, 0.0f}, by_tree)->probability ==
        1.0f);
    SceneBuilder dark;
    dark.light(PointLightDesc{.intensity = Rgb(0.0f)});
    const World black(std::move(dark.desc));
    CHECK(black.lights().context_probability(LightId{0}, LightSampleContext{}, by_tree) == 0.0f);
    CHECK_FALSE(
        black.lights().choose_for_context(LightSampleContext{}, {0.5f, 0.0f}, by_tree).has_value());
    SceneBuilder lamp;
    lamp.light(PointLightDesc{.position = {1, 0, 0}});
    const World near(std::move(lamp.desc));
    CHECK(near.lights().context_probability(LightId{0}, LightSampleContext{}, by_tree) == 1.0f);
}

TEST_CASE("few lights are chosen by power, many by the tree", "[light][tree]")
{
    for (const int count : {2, 300}) {
        const World world(std::move(test::random_lights(9, count).desc));
        const LightSet& lights = world.lights();
        const LightSampleContext receiver{.p = {0.2f, 0.3f, 0.4f}};
        bool differs = false;
        for (std::uint32_t id = 0; id < lights.size(); ++id) {
            const auto p = [&](LightSampling sampling) {
                return lights.context_probability(LightId{id}, receiver, sampling);
            };
            CHECK(p(LightSampling::automatic) ==
                  p(count == 2 ? LightSampling::power : LightSampling::tree));
            CHECK(p(LightSampling::power) == lights.emission_probability(LightId{id}));
            differs = differs || p(LightSampling::tree) != p(LightSampling::power);
        }
        CHECK(differs);
    }
}

TEST_CASE("a lamp beside the sun is chosen often enough, however large the scene is",
          "[light][tree]")
{
    SceneBuilder builder;
    builder.quad({-100, 0, 100}, {100, 0, 100}, {100, 0, -100}, {-100, 0, -100},
                 test::lambertian(Rgb(0.5f)));
    builder.light(PointLightDesc{.position = {0.0f, 2.0f, 0.0f}, .intensity = Rgb(20.0f)});
    builder.light(DirectionalLightDesc{.direction = {0.3f, -1.0f, 0.2f}, .illuminance = Rgb(3.0f)});
    builder.light(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1)}}});
    const World world(std::move(builder.desc));
    const LightSampleContext below_lamp{.p = {0.5f, 0.0f, 0.0f}, .normal = Vec3(0.0f, 1.0f, 0.0f)};
    const auto p = [&](std::uint32_t id) {
        return world.lights().context_probability(LightId{id}, below_lamp,
                                                  LightSampling::automatic);
    };
    for (const std::uint32_t id : {0U, 1U, 2U}) {
        CHECK(p(id) >= 1.0f / 6.0f);
    }
    CHECK(p(0) + p(1) + p(2) == Approx(1.0f));
}

}  // namespace bdpt::many_lights_test
