// Embree's moving triangles against ours, and both against arithmetic in double precision that
// knows nothing of either.

#include "geometry/motion.h"

#include <bdpt/motion.h>

#include "catch.hpp"
#include "geometry/embree_scene.h"
#include "moving_scenes.h"
#include "statistics.h"
#include "traced.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace bdpt::geometry_motion_test {
namespace {

using test::SceneBuilder;
using test::Traced;

/// Of values at equally spaced times, by the definition.
template <typename Value>
auto line(const Value& value, std::size_t steps, double time)
{
    const double scaled = time * static_cast<double>(steps);
    const auto index = std::min(static_cast<std::size_t>(scaled), steps - 1);
    const double u = scaled - static_cast<double>(index);
    return (1.0 - u) * value(index) + u * value(index + 1);
}

std::array<glm::dvec3, 3> corners_of(const SceneDesc& desc, std::size_t i, std::uint32_t triangle,
                                     double time)
{
    const InstanceDesc& instance = desc.instances[i];
    const MeshDesc& mesh = desc.meshes[static_cast<std::size_t>(instance.mesh)];
    const auto transform = [&](std::size_t step) {
        return glm::dmat4(step == 0 || instance.motion.empty() ? instance.world_from_object
                                                               : instance.motion[step - 1]);
    };
    std::array<glm::dvec3, 3> result;
    for (int c = 0; c < 3; ++c) {
        const std::size_t vertex = mesh.triangles[triangle][c];
        const auto placed = [&](const glm::dmat4& m, const Vec3& p) {
            return glm::dvec3(m * glm::dvec4(glm::dvec3(p), 1.0));
        };
        auto& corner = result[static_cast<std::size_t>(c)];
        if (!mesh.motion.empty()) {
            corner = line(
                [&](std::size_t step) {
                    return placed(transform(step), step == 0
                                                       ? mesh.positions[vertex]
                                                       : mesh.motion[step - 1].positions[vertex]);
                },
                mesh.motion.size(), time);
        } else if (!instance.motion.empty()) {
            corner = placed(line(transform, instance.motion.size(), time), mesh.positions[vertex]);
        } else {
            corner = placed(transform(0), mesh.positions[vertex]);
        }
    }
    return result;
}

struct Found {
    std::uint32_t instance;
    std::uint32_t triangle;
    double t;
    glm::dvec2 barycentrics;
    double margin;  ///< of the barycentrics from an edge
};

/// The nearest triangle, by testing all of them [Moeller and Trumbore 1997].
std::optional<Found> nearest(const SceneDesc& desc, const Ray& ray)
{
    std::optional<Found> found;
    const glm::dvec3 origin(ray.origin);
    const glm::dvec3 direction(ray.direction);
    for (std::uint32_t i = 0; i < desc.instances.size(); ++i) {
        const auto& mesh = desc.meshes[static_cast<std::size_t>(desc.instances[i].mesh)];
        for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
            const auto [a, b, c] = corners_of(desc, i, k, static_cast<double>(ray.segment.time));
            const glm::dvec3 p = cross(direction, c - a);
            const double determinant = dot(b - a, p);
            const glm::dvec3 s = origin - a;
            const double u = dot(s, p) / determinant;
            const glm::dvec3 q = cross(s, b - a);
            const double v = dot(direction, q) / determinant;
            const double t = dot(c - a, q) / determinant;
            const double margin = std::min({u, v, 1.0 - u - v});
            if (margin >= 0.0 && t > 0.0 && (!found || t < found->t)) {
                found = Found{i, k, t, {u, v}, margin};
            }
        }
    }
    return found;
}

Mat4 spun(float t)
{
    return glm::scale(glm::rotate(test::translation({3.0f + t, -2.0f * t, 0.5f}), 1.6f * t,
                                  Vec3(0.6f, 0.0f, 0.8f)),
                      Vec3(-0.5f - t, 0.7f, 0.4f + 0.5f * t));
}

}  // namespace

TEST_CASE("times are found among steps as Embree finds them", "[motion]")
{
    CHECK(time_step(0.0f, 1).index == 0);
    CHECK(time_step(0.0f, 1).fraction == 0.0f);
    CHECK(time_step(0.75f, 4).index == 3);
    CHECK(time_step(0.75f, 4).fraction == 0.0f);
    CHECK(time_step(0.625f, 4).index == 2);
    CHECK(time_step(0.625f, 4).fraction == 0.5f);
    CHECK(time_step(1.0f, 4).index == 3);
    CHECK(time_step(1.0f, 4).fraction == 1.0f);
    const std::vector<Vec3> later{{1, 0, 0}, {1, 4, 0}};
    CHECK(at_time(Vec3(0.0f), std::span<const Vec3>(later), 0.25f) == Vec3(0.5f, 0, 0));
    CHECK(at_time(Vec3(0.0f), std::span<const Vec3>(later), 0.75f) == Vec3(1, 2, 0));
    CHECK(at_time(Vec3(7.0f), std::span<const Vec3>(), 0.75f) == Vec3(7.0f));
}

TEST_CASE("what goes through a matrix without an inverse cannot move", "[motion]")
{
    const auto turned = [](float degrees) {
        return glm::rotate(Mat4(1.0f), glm::radians(degrees), Vec3(0.6f, 0.0f, 0.8f));
    };
    CHECK(can_move(Mat4(1.0f), turned(90.0f)));
    CHECK(can_move(Mat4(1.0f), turned(119.0f)));
    CHECK_FALSE(can_move(Mat4(1.0f), turned(121.0f)));
    CHECK_FALSE(can_move(Mat4(1.0f), turned(180.0f)));
    CHECK_FALSE(can_move(Mat4(1.0f), glm::scale(Mat4(1.0f), Vec3(-1, 1, 1))));
    CHECK(can_move(glm::scale(Mat4(1.0f), Vec3(-1, 1, 1)),
                   glm::scale(Mat4(1.0f), Vec3(-3, 0.2f, 1))));
    CHECK_FALSE(can_move(Mat4(1.0f), glm::scale(Mat4(1.0f), Vec3(1, 0, 1))));
    CHECK_FALSE(can_move(Mat4(1.0f), Mat4(std::numeric_limits<float>::quiet_NaN())));
    const std::vector<Mat4> there_and_back{turned(100.0f), Mat4(1.0f)};
    CHECK(can_move(Mat4(1.0f), there_and_back));
    CHECK_FALSE(can_move(turned(-100.0f), there_and_back));
    CHECK(can_turn({0, 0, -2}, {3, 0, -0.1f}));
    CHECK_FALSE(can_turn({0, 0, -2}, {3, 0, 0}));
    CHECK_FALSE(can_turn({0, 0, -2}, {0, 0, 1}));
}

TEST_CASE("bounds of inverses hold on the way", "[motion]")
{
    test::Random random(3);
    int moved = 0;
    for (int i = 0; i < 300; ++i) {
        const auto any = [&random] {
            return glm::scale(glm::rotate(Mat4(1.0f), 1.5f * random.next(), random.direction()),
                              Vec3(0.01f) + Vec3(random.next(), random.next(), random.next()));
        };
        const Mat4 a = any();
        const Mat4 b = any();
        const MotionBounds bounds = motion_bounds(a, b);
        if (bounds.min_determinant == 0.0) {
            CHECK_FALSE(can_move(a, b));
            continue;
        }
        ++moved;
        for (int k = 0; k <= 64; ++k) {
            const double u = k / 64.0;
            const glm::dmat3 m = (1.0 - u) * glm::dmat3(a) + u * glm::dmat3(b);
            REQUIRE(std::abs(determinant(m)) >= 0.999999 * bounds.min_determinant);
            const glm::dmat3 n = inverse(m);
            const glm::dvec3 rows = abs(n[0]) + abs(n[1]) + abs(n[2]);
            REQUIRE(std::max({rows.x, rows.y, rows.z}) <= 1.000001 * bounds.inverse_stretch);
        }
    }
    CHECK(moved > 200);
}

TEST_CASE("Embree hits what moves where it is at the ray's time", "[motion][geometry]")
{
    for (const int steps : {1, 3, 8}) {
        SceneBuilder builder;
        const MeshId shared = builder.sphere_mesh(10);
        builder.place(shared, test::lambertian(Rgb(0.5f)), test::translation({0.0f, 2.0f, 0.0f}));
        builder.place(shared, test::lambertian(Rgb(0.5f)), Mat4(1.0f));
        test::move_last(builder, steps, spun);
        builder.place(builder.sphere_mesh(8), test::lambertian(Rgb(0.5f)), Mat4(1.0f));
        test::move_last(builder, steps, [](float t) {
            return glm::rotate(test::translation({-2.0f, 3.0f * t, 0.0f}), 1.2f * t, Vec3(0, 0, 1));
        });
        const auto wave = [](Vec3 p, float t) {
            return p * (1.0f + 0.4f * std::sin(3.0f * t + 2.0f * p.x));
        };
        const MeshId jelly = builder.sphere_mesh(10);
        test::deform(builder.desc.meshes.back(), steps, wave);
        builder.place(jelly, test::lambertian(Rgb(0.5f)), test::translation({0.0f, -2.0f, 1.0f}));
        builder.place(jelly, test::lambertian(Rgb(0.5f)), Mat4(1.0f));
        test::move_last(builder, steps, [](float t) {
            return glm::scale(test::translation({-3.0f + t, -2.5f, 0.0f}), Vec3(1.0f, -0.6f, 1.0f));
        });
        const Traced scene(std::move(builder.desc));
        test::Random random(static_cast<std::uint64_t>(steps));
        std::array<int, 5> hits{};
        int different = 0;
        for (int i = 0; i < 2000; ++i) {
            Ray ray;
            ray.origin = 8.0f * random.direction();
            const Vec3 target = 4.0f * random.next() * random.direction();
            ray.direction = normalize(target - ray.origin);
            ray.segment.time = random.next();
            const auto expected = nearest(scene.desc, ray);
            const auto hit = scene.embree->intersect(ray);
            if (expected && expected->margin < 1e-4) {
                continue;  // within rounding of an edge
            }
            if (expected.has_value() != hit.has_value() ||
                (hit &&
                 (hit->instance != expected->instance || hit->triangle != expected->triangle))) {
                ++different;
                continue;
            }
            if (!hit) {
                continue;
            }
            ++hits[hit->instance];
            const glm::dvec3 p = glm::dvec3(ray.origin) + expected->t * glm::dvec3(ray.direction);
            REQUIRE(distance(p, glm::dvec3(hit->at.point.p)) < 2e-5);
            REQUIRE(distance(expected->barycentrics, glm::dvec2(hit->at.barycentrics)) < 2e-4);
            const auto [a, b, c] = corners_of(scene.desc, hit->instance, hit->triangle,
                                              static_cast<double>(ray.segment.time));
            const double sign = scene.placed[hit->instance].front_sign();
            const glm::dvec3 normal = sign * cross(b - a, c - a);
            REQUIRE(distance(normalize(normal), glm::dvec3(hit->at.ng)) <
                    1e-5 + 1e-6 / length(normal));
            // The same point by its barycentrics, as lights sample it.
            const PlacedMesh& mesh = scene.placed[hit->instance];
            const BoundedPoint again =
                mesh.point(hit->triangle, hit->at.barycentrics, ray.segment.time);
            REQUIRE(again.p == hit->at.point.p);
            REQUIRE(distance(normalize(mesh.area_normal(hit->triangle, ray.segment.time)),
                             hit->at.ng) < 1e-6f);
            Ray up_to = ray;
            up_to.t_max = static_cast<float>(expected->t * 1.001);
            REQUIRE(scene.embree->occluded(up_to));
            up_to.t_max = static_cast<float>(expected->t * 0.999);
            REQUIRE_FALSE(scene.embree->occluded(up_to));
        }
        CAPTURE(steps, hits[0], hits[1], hits[2], hits[3], hits[4]);
        CHECK(different == 0);
        for (const int count : hits) {
            CHECK(count > 20);
        }
    }
}

TEST_CASE("Embree hits spheres that move where they are at the ray's time", "[motion][geometry]")
{
    test::Random random(9);
    std::vector<std::vector<Vec3>> motions;
    std::vector<Sphere> spheres;
    for (int i = 0; i < 12; ++i) {
        std::vector<Vec3>& motion = motions.emplace_back();
        for (int step = 0; step < i % 4; ++step) {
            motion.push_back(4.0f * random.direction());
        }
    }
    for (const std::vector<Vec3>& motion : motions) {
        spheres.push_back({.center = 4.0f * random.direction(), .radius = 0.3f, .motion = motion});
    }
    std::vector<PlacedMesh> nothing;
    const EmbreeScene embree({}, nothing, 0, spheres);
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        Ray ray;
        ray.origin = 8.0f * random.direction();
        ray.direction = normalize(4.0f * random.next() * random.direction() - ray.origin);
        ray.segment.time = random.next();
        float nearest = std::numeric_limits<float>::infinity();
        std::uint32_t expected = no_sphere;
        for (std::uint32_t k = 0; k < spheres.size(); ++k) {
            const auto& [center, radius, motion] = spheres[k];
            const Sphere then{
                .center = motion.empty() ? center : at_time(center, motion, ray.segment.time),
                .radius = radius};
            const auto hit = intersect(then, ray, 0.0f);
            if (hit && hit->t < nearest) {
                nearest = hit->t;
                expected = k;
            }
        }
        const auto hit = embree.intersect(ray);
        REQUIRE((hit ? hit->sphere : no_sphere) == expected);
        REQUIRE(embree.occluded(ray) == hit.has_value());
        hits += hit ? 1 : 0;
    }
    CHECK(hits > 200);
}

TEST_CASE("normals and tangents follow what moves", "[motion][geometry]")
{
    // A triangle that is stretched and tilts: its normals stay at right angles to it.
    SceneBuilder builder;
    MeshDesc mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, Vec3(0, 0, 1));
    mesh.tangents.assign(3, Vec4(1, 0, 0, 1));
    mesh.triangles = {{0, 1, 2}};
    builder.place(builder.add_mesh(mesh), test::lambertian(Rgb(0.5f)), Mat4(1.0f));
    test::move_last(builder, 2, spun);
    MeshDesc turning = mesh;
    MeshPose pose{{{0, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {}, {}};
    pose.normals.assign(3, Vec3(1, 0, 0));
    pose.tangents.assign(3, Vec4(0, 0, -1, 1));
    turning.motion = {pose};
    builder.place(builder.add_mesh(turning), test::lambertian(Rgb(0.5f)), Mat4(1.0f));
    const Traced scene(std::move(builder.desc));
    for (const float time : {0.0f, 0.3f, 0.5f, 0.9f}) {
        CAPTURE(time);
        const Vec3 ng = normalize(scene.placed[0].area_normal(0, time));
        CHECK(dot(scene.placed[0].shading_normal(0, {0.2f, 0.3f}, time), ng) == Approx(1.0f));
        const Vec4 tangent = scene.placed[0].tangent(0, {0.2f, 0.3f}, 0, time);
        const auto [a, b, c] = scene.placed[0].corners(0, time);
        CHECK(dot(normalize(Vec3(tangent)), normalize(b - a)) == Approx(1.0f));
        CHECK(tangent.w == -1.0f);  // mirrored
        const Vec3 n = scene.placed[1].shading_normal(0, {0.2f, 0.3f}, time);
        const Vec3 expected = normalize(Vec3(time, 0.0f, 1.0f - time));
        CHECK(dot(n, expected) == Approx(1.0f));
        CHECK(dot(normalize(Vec3(scene.placed[1].tangent(0, {0.2f, 0.3f}, 0, time))),
                  normalize(Vec3(1.0f - time, 0.0f, -time))) == Approx(1.0f));
    }
}

}  // namespace bdpt::geometry_motion_test
