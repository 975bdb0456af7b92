#include "light/light_tree.h"

#include "catch.hpp"
#include "statistics.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace bdpt::light_tree_test {
namespace {

using test::Random;

/// Does the cone have the direction, or nearly?
bool has(const DirectionCone& cone, Vec3 w)
{
    return dot(cone.axis, w) >= cone.cos_angle - 1e-5f;
}

/// Within an angle of the axis, and on its edge every other time.
Vec3 direction_in(const DirectionCone& cone, Random& random)
{
    const float most = std::acos(cone.cos_angle);
    const float angle = random.next() < 0.5f ? most : most * random.next();
    Vec3 other = random.direction();
    while (std::abs(dot(other, cone.axis)) > 0.9f) {
        other = random.direction();
    }
    const Vec3 across = normalize(other - dot(other, cone.axis) * cone.axis);
    return std::cos(angle) * cone.axis + std::sin(angle) * across;
}

LightBounds point_at(Vec3 p, double intensity = 1.0)
{
    return {.min = p, .max = p, .normals = {}, .intensity = intensity};
}

double sum_of_probabilities(const LightTree& tree, const LightSampleContext& receiver)
{
    double sum = 0.0;
    for (std::uint32_t i = 0; i < tree.size(); ++i) {
        sum += static_cast<double>(tree.probability(i, receiver));
    }
    return sum;
}

}  // namespace

TEST_CASE("a cone around two has the directions of both", "[light][tree]")
{
    Random random(1);
    for (int i = 0; i < 20000; ++i) {
        // Narrow and wide ones, near and far from each other, equal and opposite axes.
        const auto cone = [&](Vec3 near) {
            const float spread = i % 3 == 0 ? 2.0f : i % 3 == 1 ? 0.1f : 0.0f;
            return DirectionCone{.axis = normalize(near + spread * random.direction()),
                                 .cos_angle = i % 5 == 0 ? 1.0f : 1.0f - 2.0f * random.next()};
        };
        const DirectionCone a = cone(random.direction());
        const DirectionCone b = cone(i % 7 == 0 ? -a.axis : a.axis);
        const DirectionCone both = merged(a, b);
        CAPTURE(i, a.cos_angle, b.cos_angle, dot(a.axis, b.axis));
        REQUIRE(dot(both.axis, both.axis) == Approx(1.0f));
        for (int k = 0; k < 4; ++k) {
            REQUIRE(has(both, direction_in(a, random)));
            REQUIRE(has(both, direction_in(b, random)));
        }
    }
    // No wider than it has to be: half of the way from edge to edge.
    const DirectionCone up{.axis = {0, 0, 1}, .cos_angle = std::cos(0.2f)};
    const DirectionCone right{.axis = {1, 0, 0}, .cos_angle = std::cos(0.3f)};
    const DirectionCone both = merged(up, right);
    CHECK(std::acos(both.cos_angle) ==
          Approx(0.5f * (0.2f + 0.5f * 3.14159265f + 0.3f)).epsilon(1e-4));
    CHECK(merged(up, {.axis = {0, 0, -1}, .cos_angle = 1.0f}).is_whole());  // in no plane
    CHECK(merged({.axis = {0, 0, 1}, .cos_angle = -0.5f}, {.axis = {0, 0, -1}, .cos_angle = -0.5f})
              .is_whole());
}

TEST_CASE("many unions of cones lose no direction", "[light][tree]")
{
    // Each is a little beyond all before: the errors of rounding have every chance to add up.
    DirectionCone all{.axis = {0, 0, 1}, .cos_angle = 1.0f};
    for (int i = 0; i <= 20000; ++i) {
        const float angle = 1e-4f * static_cast<float>(i);
        all = merged(all, {.axis = {std::sin(angle), 0.0f, std::cos(angle)}, .cos_angle = 1.0f});
    }
    for (int i = 0; i <= 20000; i += 100) {
        const float angle = 1e-4f * static_cast<float>(i);
        CHECK(dot(all.axis, Vec3(std::sin(angle), 0.0f, std::cos(angle))) >= all.cos_angle);
    }
}

TEST_CASE("orientation is measured by the cosine beyond the cone", "[light][tree]")
{
    // By quadrature: 1 within the cone, then the cosine of the angle from its edge.
    const auto expected = [](double spread, double falloff) {
        constexpr double pi_ = 3.14159265358979;
        const double end = std::min(pi_, spread + falloff);
        constexpr int steps = 20000;
        double sum = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double angle = end * (i + 0.5) / steps;
            sum += std::sin(angle) * (angle < spread ? 1.0 : std::cos(angle - spread));
        }
        return 2.0 * pi_ * sum * end / steps;
    };
    for (const float spread : {0.0f, 0.3f, 1.0f, 2.0f, 3.0f}) {
        for (const float falloff : {0.1f, 0.7f, 1.5707963f}) {
            CAPTURE(spread, falloff);
            const LightBounds bounds{.normals = {.cos_angle = std::cos(spread)},
                                     .cos_falloff = std::cos(falloff)};
            const double measure = static_cast<double>(orientation_measure(bounds));
            CHECK(measure ==
                  Approx(expected(static_cast<double>(spread), static_cast<double>(falloff)))
                      .epsilon(1e-3)
                      .margin(1e-4));
        }
    }
    LightBounds plane{.normals = {.cos_angle = 1.0f}, .cos_falloff = 0.0f};
    const float one_sided = orientation_measure(plane);
    plane.sides = EmittingSides::both;
    CHECK(orientation_measure(plane) == Approx(2.0f * one_sided));
}

TEST_CASE("a tree of one light chooses it, one of none nothing", "[light][tree]")
{
    const LightTree empty;
    CHECK(empty.empty());
    CHECK_FALSE(empty.sample({}, 0.5).has_value());
    const std::vector<LightBounds> one{point_at({1, 2, 3})};
    const LightTree tree(one);
    const auto choice = tree.sample({.p = {1, 2, 3}}, 0.3);
    REQUIRE(choice.has_value());
    CHECK(choice->light == 0);
    CHECK(choice->probability == 1.0f);
    CHECK(tree.probability(0, {.p = {-5, 0, 0}}) == 1.0f);
}

TEST_CASE("near lights are chosen by intensity over squared distance", "[light][tree]")
{
    const std::vector<LightBounds> two{point_at({-1, 0, 0}, 1.0), point_at({2, 0, 0}, 8.0)};
    const LightTree tree(two);
    CHECK(tree.probability(0, {}) == Approx(1.0 / 3.0));
    CHECK(tree.probability(1, {}) == Approx(2.0 / 3.0));
    // Light from below the receiver does not count, and the cosine does.
    CHECK(tree.probability(0, {.normal = Vec3(1, 0, 0)}) == 0.0f);
    CHECK(tree.probability(1, {.normal = Vec3(1, 0, 0)}) == 1.0f);
    const Vec3 slanted = normalize(Vec3(-0.5f, 1.0f, 0.0f));
    CHECK(tree.probability(0, {.p = {0, -1, 0}, .normal = slanted}) >
          tree.probability(0, {.p = {0, -1, 0}}));
}

TEST_CASE("surfaces shine to their front, or to both sides", "[light][tree]")
{
    LightBounds panel{.min = {-0.1f, -0.1f, 0.0f},
                      .max = {0.1f, 0.1f, 0.0f},
                      .normals = {.axis = {0, 0, 1}, .cos_angle = 1.0f},
                      .cos_falloff = 0.0f,
                      .intensity = 1.0};
    const std::vector<LightBounds> one_sided{panel, point_at({5, 0, 0})};
    panel.sides = EmittingSides::both;
    const std::vector<LightBounds> two_sided{panel, point_at({5, 0, 0})};
    for (const float z : {-2.0f, 2.0f}) {
        CHECK((LightTree(one_sided).probability(0, {.p = {0, 0, z}}) > 0.0f) == (z > 0.0f));
        CHECK(LightTree(two_sided).probability(0, {.p = {0, 0, z}}) > 0.8f);
    }
}

TEST_CASE("lights in any number and place make a tree", "[light][tree]")
{
    Random random(5);
    std::vector<LightBounds> lights;
    SECTION("all at one place")
    {
        lights.assign(1000, point_at({1, 1, 1}));
    }
    SECTION("ever closer together, which splits off one at a time")
    {
        for (int i = 0; i < 100; ++i) {
            lights.push_back(point_at({std::ldexp(1.0f, -i), 0, 0}));
        }
    }
    SECTION("of intensities that are far apart")
    {
        for (int i = -30; i <= 30; ++i) {
            lights.push_back(point_at(random.direction(), std::pow(10.0, 0.5 * i)));
        }
    }
    SECTION("on a line, with panels among them")
    {
        for (int i = 0; i < 500; ++i) {
            const Vec3 p(0.0f, 0.01f * static_cast<float>(i), 0.0f);
            lights.push_back({.min = p,
                              .max = p,
                              .normals = {.axis = random.direction(), .cos_angle = 1.0f},
                              .cos_falloff = 0.0f,
                              .sides = i % 2 == 0 ? EmittingSides::front : EmittingSides::both,
                              .intensity = 1.0});
        }
    }
    const LightTree tree(lights);
    CHECK(tree.size() == lights.size());
    for (int i = 0; i < 20; ++i) {
        const LightSampleContext receiver{.p = 3.0f * random.direction()};
        const double sum = sum_of_probabilities(tree, receiver);
        CHECK(sum <= 1.0 + 1e-4);
        CHECK(sum > 0.5);
        for (int k = 0; k < 100; ++k) {
            const auto choice =
                tree.sample(receiver, (k + static_cast<double>(random.next())) / 100.0);
            if (choice) {
                REQUIRE(choice->light < lights.size());
                REQUIRE(choice->probability ==
                        Approx(tree.probability(choice->light, receiver)).epsilon(1e-6));
            }
        }
    }
}

TEST_CASE("among lights that shine along their row all behind are seen", "[light][tree]")
{
    // Narrow spots one after another: from within a group its centre says nothing about where its
    // lights are.
    std::vector<LightBounds> spots;
    for (int i = 0; i < 300; ++i) {
        const Vec3 p(0.0f, 0.0f, static_cast<float>(i));
        spots.push_back({.min = p,
                         .max = p,
                         .normals = {.axis = {0, 0, -1}, .cos_angle = 0.999f},
                         .cos_falloff = 0.999f,
                         .intensity = 1.0});
    }
    const LightTree tree(spots);
    for (int i = 0; i < 299; ++i) {
        const LightSampleContext receiver{.p = {0.0f, 0.0f, static_cast<float>(i) + 0.5f},
                                          .normal = Vec3(0, 0, 1)};
        for (int light = i + 1; light < 300; ++light) {
            CAPTURE(i, light);
            REQUIRE(tree.probability(static_cast<std::uint32_t>(light), receiver) > 0.0f);
        }
        CHECK(tree.probability(static_cast<std::uint32_t>(i + 1), receiver) > 0.1f);
    }
}

}  // namespace bdpt::light_tree_test
