#include "geometry/embree_scene.h"

#include <bdpt/error.h>

#include "catch.hpp"
#include "geometry/ray.h"
#include "scene_builder.h"
#include "statistics.h"

#include <glm/geometric.hpp>

#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace bdpt::embree_scene_test {
namespace {

using test::SceneBuilder;

struct Traced {
    explicit Traced(SceneDesc d, Isa isa = Isa::native) : desc(std::move(d))
    {
        for (const InstanceDesc& instance : desc.instances) {
            placed.emplace_back(desc.meshes[static_cast<std::size_t>(instance.mesh)],
                                instance.world_from_object);
        }
        embree = std::make_unique<EmbreeScene>(desc.instances, placed, desc.meshes.size(),
                                               std::span<const Sphere>{}, AnyHitFilter{}, isa);
    }

    SceneDesc desc;
    std::vector<PlacedMesh> placed;
    std::unique_ptr<EmbreeScene> embree;
};

MeshDesc triangle()
{
    MeshDesc mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};  // the front looks along +z
    return mesh;
}

}  // namespace

TEST_CASE("a hit names instance, triangle and barycentrics, also for shared meshes", "[geometry]")
{
    for (const bool shared : {false, true}) {
        SceneBuilder builder;
        const MeshId mesh = builder.add_mesh(triangle());
        const auto at = [](float x) { return glm::translate(Mat4(1.0f), Vec3(x, 0.0f, 0.0f)); };
        builder.place(mesh, test::lambertian(Rgb(0.5f)), at(0.0f));
        const MeshId second = shared ? mesh : builder.add_mesh(triangle());
        builder.place(second, test::lambertian(Rgb(0.5f)), at(5.0f));
        const Traced scene(std::move(builder.desc));
        const auto hit = scene.embree->intersect(
            {.origin = {5.25f, 0.5f, 3.0f}, .direction = {0.0f, 0.0f, -1.0f}});
        REQUIRE(hit.has_value());
        CHECK(hit->instance == 1);
        CHECK(hit->triangle == 0);
        CHECK(hit->at.barycentrics.x == Approx(0.25f));
        CHECK(hit->at.barycentrics.y == Approx(0.5f));
        CHECK(hit->at.ng.z == Approx(1.0f));
        const Vec3 p = scene.placed[1].point(0, hit->at.barycentrics, 0.0f).p;
        CHECK(p.x == Approx(5.25f));
        CHECK(p.y == Approx(0.5f));
        CHECK_FALSE(scene.embree->intersect(
            {.origin = {3.0f, 0.5f, 3.0f}, .direction = {0.0f, 0.0f, -1.0f}}));
    }
}

#if defined(__x86_64__)  // other processors have one instruction set

TEST_CASE("where a triangle is hit does not depend on the instruction set", "[geometry][purity]")
{
    // What an instruction set and a maker of CPUs do differ in: Embree's approximate reciprocals.
    for (const bool shared : {false, true}) {
        SceneBuilder builder;
        const MeshId mesh = builder.sphere_mesh(24);
        const Mat4 placed = glm::rotate(glm::translate(Mat4(1.0f), Vec3(3.0f, -2.0f, 1.0f)), 0.7f,
                                        Vec3(0.6f, 0.0f, 0.8f));
        builder.place(mesh, test::lambertian(Rgb(0.5f)), placed);
        if (shared) {
            builder.place(mesh, test::lambertian(Rgb(0.5f)),
                          glm::translate(Mat4(1.0f), Vec3(50.0f)));
        }
        const Traced base(builder.desc, Isa::sse2);
        for (const Isa isa : {Isa::avx2, Isa::avx512}) {
            CAPTURE(shared, isa_name(isa));
            std::unique_ptr<Traced> other;
            try {
                other = std::make_unique<Traced>(builder.desc, isa);
            } catch (const Error&) {
                continue;  // this CPU lacks it
            }
            test::Random random(8);
            int hits = 0;
            int other_triangle = 0;
            int other_place = 0;
            for (int i = 0; i < 5000; ++i) {
                const Vec3 target = Vec3(3.0f, -2.0f, 1.0f) + 0.95f * random.direction();
                const Vec3 origin = 6.0f * random.direction();
                const Ray ray{.origin = origin, .direction = normalize(target - origin)};
                const auto a = base.embree->intersect(ray);
                const auto b = other->embree->intersect(ray);
                if (!a || !b) {
                    other_triangle += a.has_value() == b.has_value() ? 0 : 1;
                    continue;
                }
                ++hits;
                if (a->triangle != b->triangle) {
                    ++other_triangle;  // within rounding of an edge
                } else {
                    other_place +=
                        a->at.barycentrics == b->at.barycentrics && a->at.ng == b->at.ng ? 0 : 1;
                    const Vec3 p = base.placed[0].point(a->triangle, a->at.barycentrics, 0.0f).p;
                    REQUIRE(glm::length(cross(p - origin, ray.direction)) < 1e-5f);
                }
            }
            CHECK(hits > 4000);
            CHECK(other_triangle <= 2);
            CHECK(other_place == 0);
        }
    }
}

#endif

TEST_CASE("a mirrored instance keeps its front", "[geometry]")
{
    // Front normals map like normals do: mirroring along z turns the front around, along x does
    // not.
    for (const bool shared : {false, true}) {
        for (const Vec3 scale : {Vec3(-2, 1, 1), Vec3(1, 1, -1), Vec3(-1, -1, -1), Vec3(1, 3, 1)}) {
            SceneBuilder builder;
            const MeshId mesh = builder.add_mesh(triangle());
            builder.place(mesh, test::lambertian(Rgb(0.5f)), glm::scale(Mat4(1.0f), scale));
            if (shared) {
                builder.place(mesh, test::lambertian(Rgb(0.5f)),
                              glm::translate(Mat4(1.0f), Vec3(50.0f)));
            }
            const Traced scene(std::move(builder.desc));
            const auto hit = scene.embree->intersect(
                {.origin = Vec3(0.2f, 0.2f, 1.0f) * scale,
                 .direction = Vec3(0.0f, 0.0f, scale.z > 0.0f ? -1.0f : 1.0f)});
            REQUIRE(hit.has_value());
            const float front = scale.z > 0.0f ? 1.0f : -1.0f;
            CHECK(hit->at.ng.z == Approx(front));
            CHECK(normalize(scene.placed[0].area_normal(0, 0.0f)).z == Approx(front));
        }
    }
}

TEST_CASE("rays that leave a large, almost level triangle do not meet it again", "[geometry]")
{
    // The normal is tilted by less than a unit in the last place, so that an error bound for each
    // axis by itself would miss how the intersection test mixes the axes.
    test::Random random(6);
    for (const float tilt : {0.0f, 1e-7f, 1e-3f}) {
        SceneBuilder builder;
        constexpr float size = 556.0f;
        builder.quad({-size, 0, 0}, {0, 0, 0}, {0, tilt * size, -size}, {-size, tilt * size, -size},
                     test::lambertian(Rgb(0.5f)));
        const Traced scene(std::move(builder.desc));
        for (unsigned i = 0; i < 20000; ++i) {
            const std::uint32_t t = i % 2U;
            const Vec2 u = random.next_2d();
            const Vec2 b = u.x + u.y < 1.0f ? u : 1.0f - u;
            const BoundedPoint point = scene.placed[0].point(t, b, 0.0f);
            const Vec3 ng = normalize(scene.placed[0].area_normal(t, 0.0f));
            const Vec3 w = random.direction();
            REQUIRE_FALSE(scene.embree->intersect(
                {.origin = offset_origin(point.p, point.error, ng, w), .direction = w}));
        }
    }
}

TEST_CASE("rays that leave a surface neither meet it again nor skip what is near", "[geometry]")
{
    // From micrometres to thousands of kilometres, far from the origin, tilted, baked and
    // instanced.
    test::Random random(5);
    for (const float scale : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
        for (const float shift : {0.0f, 3.0f, 100.0f}) {
            for (const bool shared : {false, true}) {
                SceneBuilder builder;
                const MeshId mesh = builder.sphere_mesh(12);
                const Vec3 offset = shift * scale * Vec3(1.0f, -0.7f, 0.4f);
                const Mat4 transform =
                    glm::rotate(glm::scale(glm::translate(Mat4(1.0f), offset), Vec3(scale)), 0.7f,
                                Vec3(0.6f, 0.0f, 0.8f));
                builder.place(mesh, test::lambertian(Rgb(0.5f)), transform);
                if (shared) {
                    builder.place(mesh, test::lambertian(Rgb(0.5f)),
                                  glm::translate(transform, Vec3(1000.0f)));
                }
                const Traced scene(std::move(builder.desc));
                int escaped_inside = 0;
                for (int i = 0; i < 500; ++i) {
                    const auto t = static_cast<std::uint32_t>(
                        random.next() * static_cast<float>(scene.placed[0].triangle_count()));
                    const Vec2 u = random.next_2d();
                    const Vec2 b = u.x + u.y < 1.0f ? u : 1.0f - u;
                    const BoundedPoint point = scene.placed[0].point(t, b, 0.0f);
                    const Vec3 ng = normalize(scene.placed[0].area_normal(t, 0.0f));
                    const Vec3 w = random.direction();
                    const Vec3 origin = offset_origin(point.p, point.error, ng, w);
                    const bool outwards = dot(w, ng) > 0.0f;
                    const auto hit = scene.embree->intersect({.origin = origin, .direction = w});
                    if (outwards) {
                        // The sphere is convex: nothing is outside but the far-away copy.
                        CHECK((!hit || hit->instance == 1));
                    } else if (!hit) {
                        ++escaped_inside;
                    }
                    CHECK(glm::distance(origin, point.p) <
                          1e-4f * scale * (1.0f + std::abs(shift)));
                }
                // Watertight from inside, but for directions that graze an edge within rounding.
                CHECK(escaped_inside <= 2);
            }
        }
    }
}

TEST_CASE("rays of impossible numbers meet nothing, and end nothing", "[geometry]")
{
    SceneBuilder builder;
    const MeshId mesh = builder.add_mesh(triangle());
    const Mat4 tiny = glm::scale(Mat4(1.0f), Vec3(1e-9f));
    builder.place(mesh, test::lambertian(Rgb(0.5f)), tiny);
    builder.place(mesh, test::lambertian(Rgb(0.5f)), Mat4(1.0f));
    const Traced scene(std::move(builder.desc));
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const Vec3 above(0.25f, 0.25f, 1.0f);
    const Vec3 down(0.0f, 0.0f, -1.0f);
    REQUIRE(scene.embree->intersect({.origin = above, .direction = down}).has_value());
    for (const float odd : {nan, infinity, -infinity, 1e38f, 1e18f, 1e12f}) {
        CHECK_FALSE(scene.embree->intersect({.origin = Vec3(odd, 0.25f, 1.0f), .direction = down}));
        CHECK_FALSE(
            scene.embree->intersect({.origin = above, .direction = Vec3(0.0f, odd, -1.0f)}));
        CHECK(scene.embree->occluded({.origin = Vec3(0.25f, odd, 1.0f), .direction = down}));
    }
    CHECK_FALSE(scene.embree->intersect({.origin = above, .direction = down, .t_max = nan}));
    CHECK(scene.embree->occluded({.origin = above, .direction = down, .t_max = nan}));
}

}  // namespace bdpt::embree_scene_test
