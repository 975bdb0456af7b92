#include "light/learned/learned_light.h"

#include "catch.hpp"
#include "chi_square.h"
#include "math/sampler.h"
#include "scene/world.h"
#include "scene_builder.h"
#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace bdpt::environment_visibility_test {
namespace {

using Trial = EnvironmentVisibility::Trial;

constexpr std::size_t tile_count = EnvironmentTiles::tile_count;

/// Rays from the cube [-1, 1]^3: tile k is visible with the probability k / tile_count where x > 0,
/// and the other way round where x < 0.
std::vector<Trial> trials_of_two_halves(int count)
{
    test::Random random(1);
    std::vector<Trial> trials;
    for (int i = 0; i < count; ++i) {
        const Vec3 p = 2.0f * Vec3(random.next(), random.next(), random.next()) - 1.0f;
        const auto tile = static_cast<std::uint32_t>(random.next() * tile_count);
        const float share = static_cast<float>(tile) / tile_count;
        trials.push_back(
            {.p = p, .tile = tile, .visible = random.next() < (p.x > 0.0f ? share : 1.0f - share)});
    }
    return trials;
}

}  // namespace

TEST_CASE("visibility: without trials all is visible", "[light][visibility]")
{
    const EnvironmentVisibility visibility({});
    CHECK(visibility.cells() == 1);
    for (const float factor : visibility.at(Vec3(3.0f, -1e9f, 0.0f)).of) {
        CHECK(factor == 1.0f);
    }
}

TEST_CASE("visibility: a cell has the roots of what its trials and its parents say",
          "[light][visibility]")
{
    // Few trials, so that there is one cell; its parent takes all for visible, for four trials.
    std::vector<Trial> trials;
    for (int i = 0; i < 30; ++i) {
        trials.push_back({.p = Vec3(static_cast<float>(i)), .tile = 7, .visible = i < 12});
        trials.push_back({.p = Vec3(static_cast<float>(-i)), .tile = 90, .visible = false});
    }
    for (int i = 0; i < 700; ++i) {
        trials.push_back({.p = Vec3(0.0f), .tile = 91, .visible = false});
    }
    const EnvironmentVisibility visibility(trials);
    CHECK(visibility.cells() == 1);
    const TileFactors& factors = visibility.at(Vec3(5.0f));
    CHECK(factors.of[7] == Approx(std::sqrt((12.0f + 4.0f) / 34.0f)));
    CHECK(factors.of[90] == Approx(std::sqrt(4.0f / 34.0f)));
    CHECK(factors.of[91] == Approx(std::sqrt(4.0f / 704.0f)));
    CHECK(factors.of[0] == 1.0f);
}

TEST_CASE("visibility: cells know places", "[light][visibility]")
{
    const EnvironmentVisibility visibility(trials_of_two_halves(60000));
    CHECK(visibility.cells() > 60);
    CHECK(visibility.cells() < 60000 / 400 + 1);
    test::Random random(2);
    double error = 0.0;
    constexpr int points = 2000;
    for (int i = 0; i < points; ++i) {
        const Vec3 p = 2.0f * Vec3(random.next(), random.next(), random.next()) - 1.0f;
        const auto tile = static_cast<std::size_t>(random.next() * tile_count);
        const float share = static_cast<float>(tile) / tile_count;
        const float expected = p.x > 0.0f ? share : 1.0f - share;
        const float found = visibility.at(p).of[tile];
        REQUIRE(found >= EnvironmentVisibility::min_factor);
        REQUIRE(found <= 1.0f);
        error += static_cast<double>(std::abs(found * found - expected)) / points;
    }
    CHECK(error < 0.15);  // 0.33 if cells did not know on which side they are
}

TEST_CASE("visibility: what was never visible keeps a share", "[light][visibility]")
{
    std::vector<Trial> trials;
    for (int i = 0; i < 1000000; ++i) {
        trials.push_back({.p = Vec3(static_cast<float>(i % 10)), .tile = 3, .visible = false});
    }
    const EnvironmentVisibility visibility(trials);
    CHECK(visibility.at(Vec3(0.0f)).of[3] == EnvironmentVisibility::min_factor);
}

TEST_CASE("visibility: the order of trials does not matter", "[light][visibility]")
{
    std::vector<Trial> trials = trials_of_two_halves(20000);
    for (std::size_t i = 0; i < trials.size(); i += 3) {
        trials[i].p.y = 0.25f;  // where cells may be split
    }
    const EnvironmentVisibility one(trials);
    std::reverse(trials.begin(), trials.end());
    std::rotate(trials.begin(), trials.begin() + 777, trials.end());
    const EnvironmentVisibility other(trials);
    REQUIRE(one.cells() == other.cells());
    test::Random random(3);
    for (int i = 0; i < 5000; ++i) {
        Vec3 p = 2.4f * Vec3(random.next(), random.next(), random.next()) - 1.2f;
        p.y = i % 4 == 0 ? 0.25f : p.y;
        REQUIRE(one.at(p).of == other.at(p).of);
    }
}

TEST_CASE("visibility: points that are all one are one cell", "[light][visibility]")
{
    const std::vector<Trial> trials(5000, Trial{.p = Vec3(1.0f), .tile = 1, .visible = true});
    const EnvironmentVisibility visibility(trials);
    CHECK(visibility.cells() == 1);
    CHECK(visibility.at(Vec3(-2.0f)).of[1] == 1.0f);
}

TEST_CASE("visibility: samples of tiles have the density that is told", "[light][visibility]")
{
    constexpr int width = 64;
    constexpr int height = 32;
    test::Random random(4);
    std::vector<float> weights;
    for (int i = 0; i < width * height; ++i) {
        weights.push_back(i == 700 ? 300.0f : random.next());
    }
    const EnvironmentTiles tiles(
        {.width = width, .height = height, .of_row = [&weights](int y, std::span<float> row) {
             std::copy_n(weights.begin() + std::ptrdiff_t{y} * width, row.size(), row.begin());
         }});
    std::vector<TileFactors> tables(3);
    for (std::size_t tile = 0; tile < tile_count; ++tile) {
        tables[0].of[tile] = EnvironmentVisibility::min_factor;
        tables[1].of[tile] = std::max(EnvironmentVisibility::min_factor, random.next());
        tables[2].of[tile] = tile == 20 ? 1.0f : EnvironmentVisibility::min_factor;
    }
    const std::vector<std::optional<Vec3>> normals{std::nullopt, Vec3(0.0f, 1.0f, 0.0f),
                                                   random.direction()};
    constexpr int tests = 9;
    for (const TileFactors& factors : tables) {
        for (const std::optional<Vec3>& normal : normals) {
            std::vector<double> expected;
            double sum = 0.0;
            for (int y = 0; y < height; ++y) {
                for (int x = 0; x < width; ++x) {
                    expected.push_back(static_cast<double>(tiles.pdf(x, y, normal, &factors)) /
                                       (width * height));
                    sum += expected.back();
                }
            }
            CHECK(sum == Approx(1.0).epsilon(1e-5));
            std::vector<double> counts(expected.size(), 0.0);
            for (int i = 0; i < 60000; ++i) {
                const auto sample = tiles.sample(random.next_2d(), normal, &factors);
                REQUIRE(sample.has_value());
                REQUIRE(sample->pdf == tiles.pdf(sample->column, sample->row, normal, &factors));
                counts[static_cast<std::size_t>(sample->row * width + sample->column)] += 1.0;
            }
            CHECK(test::chi_square(counts, expected).p_value > test::sidak(1e-4, tests));
        }
    }
    // Equal factors change nothing; one great factor attracts.
    const Vec3 up(0.0f, 1.0f, 0.0f);
    CHECK(tiles.pdf(5, 3, up, tables.data()) == Approx(tiles.pdf(5, 3, up)).epsilon(1e-5));
    int attracted = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float with = tiles.pdf(x, y, std::nullopt, &tables[2]);
            const float without = tiles.pdf(x, y, std::nullopt);
            attracted += with > without ? 1 : 0;
            REQUIRE((with > without) == (tiles.find_tile(x, y) == 20 && without > 0.0f));
        }
    }
    CHECK(attracted > 0);
}

TEST_CASE("visibility: next-event estimation prefers what is visible from the receiver",
          "[light][visibility]")
{
    test::SceneBuilder builder;
    builder.sphere({0, 0, 0}, 1.0f, test::lambertian(Rgb(0.5f)));
    builder.light(EnvironmentLightDesc{
        .radiance = Image{.width = 32, .height = 16, .pixels = std::vector<Rgb>(512, Rgb(1.0f))}});
    const Scene scene(builder.desc);
    const LightSet& lights = scene.world().lights();
    const auto& sky = std::get<EnvironmentLight>(lights[*lights.environment()].model());
    const LearnedLight learned{.visibility = EnvironmentVisibility(trials_of_two_halves(200000))};
    const NextEventSampling sampling{.environments = EnvironmentSampling::learned,
                                     .lights = LightSampling::automatic,
                                     .learned = &learned};
    const auto mean_tile = [&](Vec3 p) {
        double sum = 0.0;
        for (int i = 0; i < 1000; ++i) {
            Sampler sampler(SamplerKind::independent, 5, i, 0, 0);
            sampler.start(SampleUse::next_event);
            const Vec2 u = sampler.next_2d();
            const LightSet::NextEvent next = lights.sample_next_event(
                {.p = p}, u, [&sampler] { return sampler.next_fine(); }, sampling, 0.0f);
            REQUIRE(next.incident);
            sum += static_cast<double>(sky.tile_to(next.incident->wi)) / 1000.0;
        }
        return sum;
    };
    CHECK(mean_tile({0.6f, 0.1f, 0.2f}) > mean_tile({-0.6f, 0.1f, 0.2f}) + 0.1 * tile_count);
}

}  // namespace bdpt::environment_visibility_test
