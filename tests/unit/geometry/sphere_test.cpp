#include "geometry/sphere.h"

#include "catch.hpp"
#include "geometry/embree_scene.h"
#include "scene_builder.h"
#include "statistics.h"

#include <glm/geometric.hpp>

#include <vector>

namespace bdpt::sphere_test {
namespace {

/// Two instances of one mesh, which Embree gets as instances, and some spheres.
struct Traced {
    explicit Traced(std::vector<Sphere> balls) : spheres(std::move(balls))
    {
        test::SceneBuilder builder;
        const MeshId mesh = builder.sphere_mesh(16);
        builder.place(mesh, test::lambertian(Rgb(0.5f)),
                      glm::translate(Mat4(1.0f), Vec3(0.0f, 0.0f, -5.0f)));
        builder.place(mesh, test::lambertian(Rgb(0.5f)),
                      glm::translate(Mat4(1.0f), Vec3(0.0f, 0.0f, -50.0f)));
        desc = std::move(builder.desc);
        for (const InstanceDesc& instance : desc.instances) {
            placed.emplace_back(desc.meshes[0], instance.world_from_object);
        }
        embree = std::make_unique<EmbreeScene>(desc.instances, placed, desc.meshes.size(), spheres);
    }

    std::vector<Sphere> spheres;
    SceneDesc desc;
    std::vector<PlacedMesh> placed;
    std::unique_ptr<EmbreeScene> embree;
};

}  // namespace

TEST_CASE("spheres are met from outside and from inside", "[geometry]")
{
    const Sphere sphere{.center = {1.0f, 2.0f, 3.0f}, .radius = 2.0f};
    const Ray outside{.origin = {1.0f, 2.0f, 9.0f}, .direction = {0.0f, 0.0f, -0.5f}};
    const auto front = intersect(sphere, outside, 0.0f);
    REQUIRE(front.has_value());
    CHECK(front->t == Approx(8.0f));
    CHECK(front->normal.z == Approx(1.0f));
    const auto back =
        intersect(sphere, {.origin = sphere.center, .direction = {0.0f, 3.0f, 0.0f}}, 0.0f);
    REQUIRE(back.has_value());
    CHECK(back->t == Approx(2.0f / 3.0f));
    CHECK(back->normal.y == Approx(1.0f));
    // Beyond its end, beside it, behind it, and before its start.
    CHECK_FALSE(intersect(
        sphere, {.origin = outside.origin, .direction = outside.direction, .t_max = 7.9f}, 0.0f));
    CHECK_FALSE(
        intersect(sphere, {.origin = {3.1f, 2.0f, 9.0f}, .direction = {0.0f, 0.0f, -1.0f}}, 0.0f));
    CHECK_FALSE(intersect(sphere, {.origin = outside.origin, .direction = {0, 0, 1}}, 0.0f));
    CHECK_FALSE(intersect(sphere, outside, 16.1f));
}

TEST_CASE("rays find the nearest of spheres and instances", "[geometry]")
{
    const Traced scene({{.center = {0, 0, 5}, .radius = 1.0f},
                        {.center = {0, 0, -20}, .radius = 0.5f},
                        {.center = {0, 0, 0}, .radius = 1.5f},
                        {.center = {0.9f, 0.0f, -4.35f}, .radius = 0.1f}});
    const auto first = [&](float z, float direction) {
        return scene.embree->intersect(
            {.origin = {0.1f, 0.2f, z}, .direction = {0.0f, 0.0f, direction}});
    };
    REQUIRE(first(9.0f, -1.0f).has_value());
    CHECK(first(9.0f, -1.0f)->sphere == 0);
    CHECK(first(9.0f, -1.0f)->at.ng.z > 0.9f);
    CHECK(first(2.0f, -1.0f)->sphere == 2);
    CHECK(first(-2.0f, -1.0f)->sphere == no_sphere);
    CHECK(first(-2.0f, -1.0f)->instance == 0);
    CHECK(first(-10.0f, -1.0f)->sphere == 1);
    // An instance whose box is met first, but that is hit behind the sphere, leaves no trace.
    const auto before_instance =
        scene.embree->intersect({.origin = {0.9f, 0.0f, -3.0f}, .direction = {0.0f, 0.0f, -1.0f}});
    REQUIRE(before_instance.has_value());
    CHECK(before_instance->sphere == 3);
    CHECK(first(-40.0f, 1.0f)->sphere == 1);
    CHECK(first(-30.0f, -1.0f)->instance == 1);
    CHECK_FALSE(first(7.0f, 1.0f).has_value());
}

TEST_CASE("spheres occlude, but not the ray that ignores them", "[geometry]")
{
    const Traced scene({{.center = {0, 0, 5}, .radius = 1.0f}, {.center = {0, 0, 9}, .radius = 1}});
    const Ray ray{.origin = {0, 0, 11}, .direction = {0, 0, -1}, .t_max = 5.5f};
    CHECK(scene.embree->occluded(ray));
    Ray free = ray;
    free.ignored_sphere = 1;
    CHECK(scene.embree->occluded(free));  // by the other
    free.t_max = 4.9f;
    CHECK_FALSE(scene.embree->occluded(free));
    CHECK(scene.embree->intersect(ray)->sphere == 1);
    CHECK(scene.embree
              ->intersect({.origin = ray.origin, .direction = ray.direction, .ignored_sphere = 1})
              ->sphere == 0);
}

TEST_CASE("tiny spheres far away keep their outline", "[geometry]")
{
    // Rays are aimed just inside and just outside of the outline: a thousandth of the radius, which
    // is less than a float resolves at that distance.
    test::Random random(3);
    constexpr float radius = 1e-3f;
    const Traced scene({{.center = Vec3(0.0f), .radius = radius}});
    for (int i = 0; i < 2000; ++i) {
        const Vec3 towards = random.direction();
        const Vec3 origin = 20.0f * towards + Vec3(0.0f, 0.0f, 30.0f);
        const Vec3 side = normalize(cross(origin, random.direction()));
        for (const float miss : {0.999f, 1.001f}) {
            const Vec3 target = miss * radius * side;
            const auto hit =
                scene.embree->intersect({.origin = origin, .direction = target - origin});
            // What the direction that floats allow really passes.
            const glm::dvec3 d(target - origin);
            const double passes =
                length(cross(glm::dvec3(origin), d)) / length(d) / static_cast<double>(radius);
            const bool met = hit && hit->sphere == 0;
            if (std::abs(passes - 1.0) > 1e-6) {
                REQUIRE(met == (passes < 1.0));
            }
            if (met) {
                REQUIRE(dot(hit->at.ng, hit->at.ng) == Approx(1.0f));
                REQUIRE(dot(hit->at.ng, origin) > -0.01f);
            }
        }
    }
}

TEST_CASE("the error bound of a point on a sphere holds", "[geometry]")
{
    test::Random random(4);
    for (const float radius : {1e-6f, 0.3f, 1e4f}) {
        for (const float shift : {0.0f, 1.0f, 1e5f}) {
            const Sphere sphere{.center = shift * random.direction(), .radius = radius};
            for (int i = 0; i < 1000; ++i) {
                const Vec3 normal = random.direction();
                const BoundedPoint at = sphere.point(normal);
                const double off = std::abs(length(glm::dvec3(at.p) - glm::dvec3(sphere.center)) -
                                            static_cast<double>(radius));
                REQUIRE(off <= static_cast<double>(at.error));
            }
        }
    }
}

}  // namespace bdpt::sphere_test
