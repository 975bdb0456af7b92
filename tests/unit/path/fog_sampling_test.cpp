#include "path/fog_sampling.h"

#include "catch.hpp"
#include "even_bins.h"
#include "scene_builder.h"

#include <glm/geometric.hpp>

#include <random>
#include <utility>
#include <vector>

namespace bdpt::fog_sampling_test {
namespace {

/// A room with lights of all kinds, as `lights` says how they are chosen.
test::SceneBuilder room()
{
    test::SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.5f)), test::lambertian(Rgb(0.5f)));
    builder.lamp(0.9f, 0.7f, Rgb(4.0f));
    builder.light(PointLightDesc{.position = {0.3f, 0.1f, 0.2f}, .intensity = Rgb(2.0f)});
    builder.light(
        PointLightDesc{.position = {-0.5f, 0.3f, 0.2f}, .intensity = Rgb(2.0f), .radius = 0.2f});
    builder.light(DirectionalLightDesc{.direction = {0, -1, 0}, .illuminance = Rgb(1.0f)});
    builder.desc.fog = MediumDesc{.extinction = Rgb(0.5f), .albedo = Rgb(0.9f)};
    return builder;
}

FogSegment segment(Vec3 origin, Vec3 towards, float begin, float end)
{
    return {.origin = origin, .direction = normalize(towards - origin), .span = {begin, end}};
}

/// Beside lights, through them, away from them, and far away.
std::vector<FogSegment> segments()
{
    return {segment({-0.9f, 0, 0}, {0.9f, 0.2f, 0.3f}, 0.0f, 1.8f),
            segment({-0.9f, 0.1f, 0.2f}, {0.3f, 0.1f, 0.2f}, 0.2f, 1.7f),
            segment({0.2f, 0.1f, 0.2f}, {-0.7f, -0.2f, 0.1f}, 0.0f, 1.0f),
            segment({0, 0, 3000}, {0.1f, 0.2f, 0}, 2998.0f, 3001.0f),
            segment({0, 0, 3000}, {0, 0, 4000}, 10.0f, 10.5f)};
}

}  // namespace

TEST_CASE("points of fog have the density that is told of them", "[media]")
{
    const World world(room().desc);
    const FogSampling sampling(world, LightSampling::automatic);
    constexpr int bins = 40;
    constexpr int count = 200000;
    std::mt19937 engine(7);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    for (const FogSegment& fog : segments()) {
        const auto [begin, end] = fog.span;
        for (std::uint32_t i = 0; i < world.lights().size(); ++i) {
            CAPTURE(i, begin, end, fog.origin.x);
            std::vector<double> counts(bins);
            for (int j = 0; j < count; ++j) {
                const float distance = sampling.sample_distance(fog, LightId{i}, uniform(engine));
                REQUIRE(distance >= begin);
                REQUIRE(distance <= end);
                const double part = static_cast<double>((distance - begin) / (end - begin));
                counts[test::find_bin(std::array{part}, bins)] += 1.0;
            }
            std::vector<double> probabilities(bins);
            constexpr int steps = 2000;
            for (int j = 0; j < bins * steps; ++j) {
                const float part = (static_cast<float>(j) + 0.5f) / (bins * steps);
                const float distance = begin + part * (end - begin);
                probabilities[static_cast<std::size_t>(j / steps)] +=
                    static_cast<double>(sampling.pdf_distance(fog, LightId{i}, distance) *
                                        (end - begin)) /
                    (bins * steps);
            }
            test::check_counts(counts, probabilities);
        }
    }
}

TEST_CASE("the density of a point of fog is that of the light and of the distance", "[media]")
{
    const World world(room().desc);
    for (const LightSampling lights : {LightSampling::power, LightSampling::tree}) {
        const FogSampling sampling(world, lights);
        for (const FogSegment& fog : segments()) {
            double sum = 0.0;
            for (int i = 0; i < 200; ++i) {
                const auto part = (static_cast<float>(i) + 0.5f) / 200.0f;
                const auto sample =
                    sampling.sample(fog, {part, 0.3f}, 0.6f, [part] { return Vec2(part, 0.5f); });
                REQUIRE(sample.has_value());
                CHECK(sample->pdf == sampling.pdf(fog, sample->light, sample->distance));
                CHECK(sample->distance == sampling.sample_distance(fog, sample->light, 0.6f));
            }
            // All lights together, anywhere on the segment.
            for (std::uint32_t i = 0; i < world.lights().size(); ++i) {
                constexpr int steps = 40000;
                const float length = fog.span.end - fog.span.begin;
                for (int j = 0; j < steps; ++j) {
                    const float part = (static_cast<float>(j) + 0.5f) / steps;
                    sum += static_cast<double>(
                        sampling.pdf(fog, LightId{i}, fog.span.begin + part * length) * length /
                        steps);
                }
            }
            CHECK(sum == Approx(1.0).epsilon(0.01));
        }
    }
}

TEST_CASE("fog is sampled where the lamp is near", "[media]")
{
    const World world(room().desc);
    const FogSampling sampling(world, LightSampling::automatic);
    const FogSegment fog = segment({-0.9f, 0.0f, 0.2f}, {0.9f, 0.0f, 0.2f}, 0.0f, 1.8f);
    const LightId point{2};
    const LightId sun{4};
    // It is 0.1 m from the ray, 1.2 m from its origin.
    CHECK(sampling.pdf_distance(fog, point, 1.2f) / sampling.pdf_distance(fog, point, 1.3f) ==
          Approx(2.0f).epsilon(1e-3));
    CHECK(sampling.pdf_distance(fog, sun, 1.2f) == Approx(1.0f / 1.8f));
}

}  // namespace bdpt::fog_sampling_test
