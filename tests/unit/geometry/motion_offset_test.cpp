// Rays that start on surfaces that move.

#include "catch.hpp"
#include "geometry/ray.h"
#include "moving_scenes.h"
#include "statistics.h"
#include "traced.h"

#include <glm/geometric.hpp>

#include <cstdint>
#include <utility>

namespace bdpt::motion_offset_test {
namespace {

using test::SceneBuilder;
using test::Traced;

}  // namespace

TEST_CASE("rays that leave what moves do not meet it again", "[motion][geometry]")
{
    test::Random random(5);
    for (const float scale : {1e-3f, 1.0f, 1e3f}) {
        for (const float shift : {0.0f, 30.0f}) {
            for (const int steps : {1, 7, 128}) {
                for (const bool deforms : {false, true}) {
                    SceneBuilder builder;
                    const MeshId mesh = builder.sphere_mesh(12);
                    const Vec3 place = shift * scale * Vec3(1.0f, -0.7f, 0.4f);
                    const Mat4 still = glm::scale(test::translation(place), Vec3(scale));
                    if (deforms) {
                        test::deform(builder.desc.meshes.back(), steps, [](Vec3 p, float t) {
                            return p * Vec3(1.0f + t, 1.0f, 1.0f - 0.5f * t) + Vec3(0, t, 0);
                        });
                        builder.place(mesh, test::lambertian(Rgb(0.5f)), still);
                    } else {
                        builder.place(mesh, test::lambertian(Rgb(0.5f)), still);
                        test::move_last(builder, steps, [&](float t) {
                            return glm::rotate(still * test::translation({t, 2.0f * t, 0.0f}),
                                               1.2f * t, Vec3(0.6f, 0.0f, 0.8f));
                        });
                    }
                    const Traced scene(std::move(builder.desc));
                    int met_again = 0;
                    int escaped_inside = 0;
                    for (int i = 0; i < 1000; ++i) {
                        const auto t = static_cast<std::uint32_t>(
                            random.next() * static_cast<float>(scene.placed[0].triangle_count()));
                        const float time = random.next();
                        const Vec2 u = random.next_2d();
                        const Vec2 b = u.x + u.y < 1.0f ? u : 1.0f - u;
                        const BoundedPoint point = scene.placed[0].point(t, b, time);
                        const Vec3 ng = normalize(scene.placed[0].area_normal(t, time));
                        const Vec3 w = random.direction();
                        Ray ray{.origin = offset_origin(point.p, point.error, ng, w),
                                .direction = w};
                        ray.segment.time = time;
                        const bool hit = scene.embree->intersect(ray).has_value();
                        const bool outwards = dot(w, ng) > 0.0f;
                        met_again += outwards && hit ? 1 : 0;
                        escaped_inside += !outwards && !hit ? 1 : 0;
                        REQUIRE(glm::distance(ray.origin, point.p) <
                                1e-4f * scale * (1.0f + shift));
                    }
                    CAPTURE(scale, shift, steps, deforms);
                    CHECK(met_again == 0);
                    CHECK(escaped_inside <= 4);
                }
            }
        }
    }
}

TEST_CASE("rays that leave large, level things that move do not meet them again",
          "[motion][geometry]")
{
    // A coordinate that hardly matters is rounded as much as those that are large.
    test::Random random(6);
    constexpr float size = 556.0f;
    for (const bool deforms : {false, true}) {
        for (const int steps : {1, 7, 128}) {
            SceneBuilder builder;
            builder.quad({-size, 0, 0}, {0, 0, 0}, {0, 0, -size}, {-size, 0, -size},
                         test::lambertian(Rgb(0.5f)));
            if (deforms) {
                test::deform(builder.desc.meshes.back(), steps, [](Vec3 p, float t) {
                    return p + Vec3(300.0f * t, 1e-3f * t * p.x, -200.0f * t);
                });
            } else {
                test::move_last(builder, steps, [](float t) {
                    return glm::rotate(test::translation({300.0f * t, 1e-3f * t, 0.0f}), 0.8f * t,
                                       Vec3(0.0f, 1.0f, 0.0f));
                });
            }
            const Traced scene(std::move(builder.desc));
            int met_again = 0;
            for (unsigned i = 0; i < 20000; ++i) {
                const std::uint32_t t = i % 2U;
                const float time = random.next();
                const Vec2 u = random.next_2d();
                const Vec2 b = u.x + u.y < 1.0f ? u : 1.0f - u;
                const BoundedPoint point = scene.placed[0].point(t, b, time);
                const Vec3 ng = normalize(scene.placed[0].area_normal(t, time));
                const Vec3 w = random.direction();
                Ray ray{.origin = offset_origin(point.p, point.error, ng, w), .direction = w};
                ray.segment.time = time;
                met_again += scene.embree->intersect(ray) ? 1 : 0;
            }
            CAPTURE(deforms, steps);
            CHECK(met_again == 0);
        }
    }
}

}  // namespace bdpt::motion_offset_test
