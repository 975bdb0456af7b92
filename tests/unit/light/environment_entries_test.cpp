#include "light/learned/entries.h"

#include "catch.hpp"
#include "chi_square.h"
#include "light/delta_lights.h"
#include "light/environment_light.h"
#include "math/frame.h"
#include "statistics.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace bdpt::environment_entries_test {
namespace {

constexpr BoundingSphere bounds{.center = {1.0f, 2.0f, -1.0f}, .radius = 5.0f};

EnvironmentLight even_sky()
{
    const Image radiance{.width = 32, .height = 16, .pixels = std::vector(512, Rgb(1.0f))};
    return {EnvironmentLightDesc{.radiance = radiance}, bounds};
}

/// Paths that leave a box with an opening: its ceiling between x = 1 and x = 2, z = -1 and z = 0.
std::vector<Escape> through_opening(const EnvironmentLight& sky, int count)
{
    test::Random random(1);
    std::vector<Escape> escapes;
    for (int i = 0; i < count; ++i) {
        const Vec3 on_floor = Vec3(4.0f * random.next(), 0.0f, 2.0f * random.next() - 1.0f);
        const Vec3 opening = Vec3(1.0f + random.next(), 3.0f, -random.next());
        const Vec3 direction = normalize(opening - on_floor);
        escapes.push_back({.p = on_floor,
                           .direction = direction,
                           .tile = sky.tile_to(direction),
                           .throughput = 0.5f + random.next()});
    }
    return escapes;
}

/// Returns where a ray through `p` crosses the plane through the centre perpendicular to it, in
/// units of the radius.
Vec2 on_disk(Vec3 p, Vec3 direction)
{
    const Frame frame = Frame::from_normal(direction);
    const Vec3 offset = (p - bounds.center) / bounds.radius;
    return {dot(offset, frame.x), dot(offset, frame.y)};
}

Vec3 from_disk(Vec2 at, Vec3 direction)
{
    const Frame frame = Frame::from_normal(direction);
    return bounds.center + bounds.radius * (at.x * frame.x + at.y * frame.y);
}

}  // namespace

TEST_CASE("entries: samples follow their density", "[light][entries]")
{
    const EnvironmentLight sky = even_sky();
    const EnvironmentEntries entries(through_opening(sky, 20000), sky.tiles(), bounds);
    for (const Vec3 to_light : {Vec3(0.1f, 1.0f, 0.05f), Vec3(-0.5f, 1.0f, 0.3f),
                                Vec3(0.6f, 0.9f, -0.2f), Vec3(0.3f, -1.0f, 0.2f)}) {
        const Vec3 direction = -normalize(to_light);
        const EntryWindow& window = entries.window(sky.tile_to(-direction));
        constexpr std::size_t side = 24;  // bins
        constexpr int fine = 40;          // points of a bin, in each direction
        constexpr float bin = 2.0f / side;
        std::vector<double> expected(side * side);
        double sum = 0.0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            for (int k = 0; k < fine * fine; ++k) {
                const Vec2 within = (Vec2(k % fine, k / fine) + 0.5f) / static_cast<float>(fine);
                const Vec2 at = bin * (Vec2(i % side, i / side) + within) - 1.0f;
                if (dot(at, at) < 1.0f) {
                    const float pdf = window.pdf(from_disk(at, direction), direction).value;
                    expected[i] += static_cast<double>(pdf * bin * bin * bounds.radius *
                                                       bounds.radius / (fine * fine));
                }
            }
            sum += expected[i];
        }
        CHECK(sum == Approx(1.0).epsilon(2e-3));
        for (double& probability : expected) {
            probability /= sum;
        }
        test::Random random(2);
        std::vector<double> counts(expected.size());
        double nearest = bounds.radius;
        for (int i = 0; i < 20000; ++i) {
            const auto entry = window.sample(direction, random.next_2d());
            REQUIRE(entry.pdf.value == window.pdf(entry.p, direction).value);
            nearest =
                std::min(nearest, -static_cast<double>(dot(entry.p - bounds.center, direction)));
            const Vec2 at = (on_disk(entry.p, direction) + 1.0f) / bin;
            const auto index = [](float x) {
                return std::clamp<std::size_t>(static_cast<std::size_t>(x), 0, side - 1);
            };
            counts[index(at.y) * side + index(at.x)] += 1.0;
        }
        CHECK(nearest == Approx(bounds.radius).epsilon(1e-4));  // in front of the scene
        CAPTURE(to_light.x, to_light.y, to_light.z);
        CHECK(test::chi_square(counts, expected).p_value > 1e-3);
    }
}

TEST_CASE("entries: light starts where it came through an opening", "[light][entries]")
{
    const EnvironmentLight sky = even_sky();
    const EnvironmentEntries entries(through_opening(sky, 20000), sky.tiles(), bounds);
    test::Random random(3);
    int steep = 0;
    int through = 0;
    constexpr int count = 20000;
    for (int i = 0; i < count; ++i) {
        const auto emitted = sky.sample_emission(random.next_2d(), random.next_2d(), entries);
        REQUIRE(emitted);
        const Vec3 d = emitted->direction;
        steep += -d.y > 0.5f ? 1 : 0;
        if (d.y < 0.0f) {
            const Vec3 p = emitted->end.p + (3.0f - emitted->end.p.y) / d.y * d;
            through += p.x > 1.0f && p.x < 2.0f && p.z > -1.0f && p.z < 0.0f ? 1 : 0;
        }
    }
    CHECK(steep > 0.55 * count);  // 0.25 of uniform directions
    // 0.7 % of light that is uniform over the sphere and the disk.
    CHECK(through > 0.2 * count);
}

TEST_CASE("entries: all light can start, with the density that weights assume", "[light][entries]")
{
    const EnvironmentLight sky = even_sky();
    const EnvironmentEntries entries(through_opening(sky, 5000), sky.tiles(), bounds);
    const auto [least, most] =
        std::minmax_element(entries.factors().of.begin(), entries.factors().of.end());
    CHECK(*least == EnvironmentEntries::min_factor);
    CHECK(*most == 1.0f);
    // The flux through a small sphere, wherever it is: pi^2 r^2 L.
    for (const Vec3 place : {Vec3(1.5f, 3.0f, -0.5f), Vec3(3.0f, 4.0f, 1.0f)}) {
        constexpr float radius = 1.0f;
        test::Random random(4);
        test::Moments flux;
        for (int i = 0; i < 400000; ++i) {
            const auto emitted = sky.sample_emission(random.next_2d(), random.next_2d(), entries);
            REQUIRE(emitted);
            const LightPoint x0{.p = -emitted->direction};
            const auto pdf = sky.pdf_emission(x0.p, emitted->end.p, entries);
            REQUIRE(pdf.direction.value == Approx(emitted->pdf_position.value).epsilon(1e-4));
            REQUIRE(pdf.entry.value == emitted->pdf_entry.value);
            const Vec3 offset = place - emitted->end.p;
            const float along = dot(offset, emitted->direction);
            const bool hits = dot(offset, offset) - along * along < radius * radius;
            flux.add(hits ? static_cast<double>(emitted->weight.g) : 0.0);
        }
        const double expected = 4.0 * M_PI * M_PI * static_cast<double>(radius * radius);
        CHECK(flux.standard_error() < 0.02 * expected);
        CHECK(std::abs(flux.mean() - expected) < 4.0 * flux.standard_error());
    }
}

TEST_CASE("entries: all light of a sun can start, most of it where it came through an opening",
          "[light][entries]")
{
    const Vec3 direction = normalize(Vec3(0.2f, -1.0f, 0.1f));
    const DirectionalLight sun({.direction = direction, .illuminance = Rgb(2.0f)}, bounds);
    std::vector<Escape> escapes;
    test::Random from_opening(6);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 opening(1.0f + from_opening.next(), 3.0f, -from_opening.next());
        escapes.push_back(
            {.p = opening + 3.0f * direction, .direction = -direction, .throughput = 1.0f});
    }
    const EntryWindow window(escapes, bounds.center, bounds);
    // The flux through small spheres: in the opening, and beside it.
    for (const auto& [place, radius] :
         {std::pair(Vec3(1.5f, 3.0f, -0.5f), 0.3f), std::pair(Vec3(-1.0f, 1.0f, 1.0f), 0.9f)}) {
        test::Random random(7);
        test::Moments flux;
        int hits = 0;
        constexpr int count = 200000;
        for (int i = 0; i < count; ++i) {
            const auto emitted = sun.sample_emission(random.next_2d(), 0.0f, window);
            REQUIRE(emitted.direction == direction);
            REQUIRE(emitted.pdf_position.value == 1.0f);
            REQUIRE(emitted.pdf_entry.value == window.pdf(emitted.end.p, direction).value);
            const Vec3 offset = place - emitted.end.p;
            const float along = dot(offset, direction);
            const bool is_hit = dot(offset, offset) - along * along < radius * radius;
            hits += is_hit ? 1 : 0;
            flux.add(is_hit ? static_cast<double>(emitted.weight.g) : 0.0);
        }
        const double expected = 2.0 * M_PI * static_cast<double>(radius * radius);
        CAPTURE(place.x, hits);
        CHECK(std::abs(flux.mean() - expected) < 4.0 * flux.standard_error());
        CHECK(flux.standard_error() < 0.05 * expected);
        CHECK((place.x < 0.0f || hits > 0.15 * count));  // 0.4 % of light that is uniform
    }
}

TEST_CASE("entries: without escapes light starts everywhere alike", "[light][entries]")
{
    const EnvironmentLight sky = even_sky();
    const std::vector<Escape> black{{.p = Vec3(1.0f), .direction = {0, 1, 0}, .tile = 3}};
    for (const auto& escapes : {std::vector<Escape>{}, black}) {
        const EnvironmentEntries entries(escapes, sky.tiles(), bounds);
        for (const float factor : entries.factors().of) {
            CHECK(factor == 1.0f);
        }
        CHECK(entries.window(3).pdf(bounds.center, {0, -1, 0}).value == bounds.pdf_disk().value);
    }
}

TEST_CASE("entries: a tile of all directions is safe", "[light][entries]")
{
    // An image of one pixel has tiles from pole to pole.
    const EnvironmentLight sky(
        EnvironmentLightDesc{.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(1.0f)}}},
        bounds);
    test::Random random(5);
    std::vector<Escape> escapes;
    for (int i = 0; i < 4000; ++i) {
        const Vec3 direction =
            normalize(2.0f * Vec3(random.next(), random.next(), random.next()) - Vec3(0.999f));
        escapes.push_back({.p = bounds.center + random.next(),
                           .direction = direction,
                           .tile = sky.tile_to(direction),
                           .throughput = 1.0f});
    }
    const EnvironmentEntries entries(escapes, sky.tiles(), bounds);
    for (int i = 0; i < 20000; ++i) {
        const auto emitted = sky.sample_emission(random.next_2d(), random.next_2d(), entries);
        REQUIRE(emitted);
        REQUIRE(std::isfinite(emitted->weight.g));
        REQUIRE(emitted->pdf_entry.value >= EntryWindow::uniform_part * bounds.pdf_disk().value);
        REQUIRE(emitted->pdf_entry.value < 1e3f);
    }
}

}  // namespace bdpt::environment_entries_test
