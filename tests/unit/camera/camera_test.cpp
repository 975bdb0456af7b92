#include "camera/camera.h"

#include "catch.hpp"
#include "scene_builder.h"
#include "statistics.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt::camera_test {

TEST_CASE("sample_lens finds the raster position that generate_ray came from", "[camera]")
{
    const Camera camera(test::camera_at({1.0f, 2.0f, 3.0f}, {0.0f, 0.5f, -1.0f}, 0.8f), 64, 36);
    test::Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec2 raster = random.next_2d() * Vec2(64.0f, 36.0f);
        const CameraRay ray = camera.generate_ray(raster, Vec2(0.5f));
        const float distance = 0.1f + 20.0f * random.next();
        const auto lens = camera.sample_lens(ray.lens.p + distance * ray.direction, Vec2(0.5f));
        REQUIRE(lens.has_value());
        CHECK(lens->raster.x == Approx(raster.x).margin(1e-3));
        CHECK(lens->raster.y == Approx(raster.y).margin(1e-3));
        CHECK(lens->distance == Approx(distance).epsilon(1e-4));
        CHECK(lens->pdf_direction.value == Approx(ray.pdf_direction.value).epsilon(1e-4));
        CHECK(dot(lens->wi, -ray.direction) == Approx(1.0));
        // We cos / d^2 is what one light path brings to the whole film.
        CHECK(lens->weight == Approx(lens->pdf_direction.value / (distance * distance)));
    }
}

TEST_CASE("sample_lens sees nothing behind the camera or beside the film", "[camera]")
{
    const Camera camera(test::camera_at({0, 0, 0}, {0, 0, -1}, 0.8f), 10, 10);
    CHECK_FALSE(camera.sample_lens({0.0f, 0.0f, 1.0f}, Vec2(0.5f)).has_value());
    CHECK_FALSE(camera.sample_lens({5.0f, 0.0f, -1.0f}, Vec2(0.5f)).has_value());
    CHECK_FALSE(camera.sample_lens({0.0f, 0.0f, 0.0f}, Vec2(0.5f)).has_value());
    CHECK(camera.sample_lens({0.0f, 0.0f, -1.0f}, Vec2(0.5f)).has_value());
}

TEST_CASE("the density of primary directions is the density of uniform film positions", "[camera]")
{
    // Equal parts of the film hold equal probability: the integral of the density over the solid
    // angle of a pixel is one over the number of pixels. The solid angle comes from the pixel's
    // corners [Van Oosterom and Strackee 1983].
    constexpr int size = 16;
    CameraDesc desc = test::camera_at({0, 0, 0}, {0, 0, -1}, 1.2f);
    if (GENERATE(false, true)) {
        desc.shift = {0.7f, -0.4f};
        desc.pixel_aspect = 1.5f;
    }
    const Camera camera(desc, size, size);
    const auto direction = [&](float x, float y) {
        return camera.generate_ray({x, y}, Vec2(0.5f)).direction;
    };
    const auto triangle = [](Vec3 a, Vec3 b, Vec3 c) {
        return 2.0f *
               std::atan2(std::abs(dot(a, cross(b, c))), 1.0f + dot(a, b) + dot(b, c) + dot(c, a));
    };
    for (const auto& [x, y] : {std::pair{0, 0}, {7, 8}, {15, 3}}) {
        const auto fx = static_cast<float>(x);
        const auto fy = static_cast<float>(y);
        const Vec3 a = direction(fx, fy);
        const Vec3 b = direction(fx + 1, fy);
        const Vec3 c = direction(fx + 1, fy + 1);
        const Vec3 d = direction(fx, fy + 1);
        const float solid_angle = triangle(a, b, c) + triangle(a, c, d);
        const float pdf =
            camera.generate_ray({fx + 0.5f, fy + 0.5f}, Vec2(0.5f)).pdf_direction.value;
        CHECK(pdf * solid_angle == Approx(1.0 / (size * size)).epsilon(0.01));
    }
}

TEST_CASE("the top row of the film looks up, and the node's scale does not matter", "[camera]")
{
    CameraDesc desc = test::camera_at({0, 0, 0}, {0, 0, -1}, 0.8f);
    const Camera plain(desc, 8, 8);
    CHECK(plain.generate_ray({4.0f, 0.0f}, Vec2(0.5f)).direction.y > 0.3f);
    CHECK(plain.generate_ray({8.0f, 4.0f}, Vec2(0.5f)).direction.x > 0.3f);
    desc.world_from_camera = glm::scale(desc.world_from_camera, Vec3(3.0f, 0.5f, 2.0f));
    const Vec3 scaled = Camera(desc, 8, 8).generate_ray({1.0f, 2.0f}, Vec2(0.5f)).direction;
    CHECK(dot(scaled, plain.generate_ray({1.0f, 2.0f}, Vec2(0.5f)).direction) == Approx(1.0));
}

TEST_CASE("a node's shear and mirror images do not reach the image", "[camera]")
{
    const CameraDesc desc = test::camera_at({1.0f, 2.0f, 3.0f}, {0.0f, 0.5f, -1.0f}, 0.8f);
    const Camera plain(desc, 8, 6);
    // What counts is where the camera looks and what is up for it: columns 2 and 1.
    Mat4 sheared(1.0f);
    sheared[0] = Vec4(0.7f, 0.6f, -0.4f, 0.0f);  // right leans up and forwards
    sheared[1] = Vec4(0.0f, 1.0f, 0.8f, 0.0f);   // up leans back
    const Mat4 mirrored = glm::scale(Mat4(1.0f), Vec3(-1.0f, 1.0f, 1.0f));
    for (const Mat4& node : {sheared, mirrored, mirrored * sheared}) {
        CameraDesc changed = desc;
        changed.world_from_camera = desc.world_from_camera * node;
        const Camera camera(changed, 8, 6);
        // A camera that moves there is the same one.
        const Camera moved = plain.moved_to(changed.world_from_camera);
        for (const Vec2 raster : {Vec2(0.0f), Vec2(8.0f, 3.0f), Vec2(4.0f, 6.0f)}) {
            const Vec3 expected = plain.generate_ray(raster, Vec2(0.5f)).direction;
            CAPTURE(raster.x, raster.y);
            CHECK(glm::distance(camera.generate_ray(raster, Vec2(0.5f)).direction, expected) <
                  1e-5f);
            CHECK(glm::distance(moved.generate_ray(raster, Vec2(0.5f)).direction, expected) <
                  1e-5f);
        }
    }
}

TEST_CASE("pixels are as wide as the rays through them are apart", "[camera]")
{
    CameraDesc desc = test::camera_at({1, 2, 3}, {1, 2, -7}, 0.8f);
    const auto apart = [](const Camera& camera) {
        const CameraRay a = camera.generate_ray({16.0f, 9.0f}, Vec2(0.5f));
        const CameraRay b = camera.generate_ray({16.0f, 10.0f}, Vec2(0.5f));
        return glm::distance(a.lens.p + 10.0f * a.direction, b.lens.p + 10.0f * b.direction);
    };
    const Camera perspective(desc, 32, 18);
    CHECK(perspective.pixel_cone().width_at({1, 2, -7}) ==
          Approx(apart(perspective)).epsilon(2e-3));
    CHECK(perspective.pixel_cone().width_at({1, 2, 13}) ==
          Approx(apart(perspective)).epsilon(2e-3));  // behind the camera, too
    CHECK(perspective.pixel_cone().width_at({1, 2, 3}) == 0.0f);
    desc.projection = Projection::orthographic;
    desc.vertical_extent = 6.0f;
    const Camera orthographic(desc, 32, 18);
    CHECK(orthographic.pixel_cone().width_at({1, 2, -7}) == Approx(6.0 / 18.0));
    CHECK(orthographic.pixel_cone().width_at({50, 2, -700}) == Approx(apart(orthographic)));
    // The narrower side of pixels that are not square.
    desc.pixel_aspect = 0.5f;
    CHECK(Camera(desc, 32, 18).pixel_cone().width_at({1, 2, -7}) == Approx(3.0 / 18.0));
    desc.pixel_aspect = 2.0f;
    CHECK(Camera(desc, 32, 18).pixel_cone().width_at({1, 2, -7}) == Approx(6.0 / 18.0));
}

namespace {

constexpr int width = 64;
constexpr int height = 36;

/// A view that is shifted more than the film is wide, with pixels that are not square.
CameraDesc shifted_view()
{
    CameraDesc desc = test::camera_at({1.0f, 2.0f, 3.0f}, {0.0f, 0.5f, -1.0f}, 0.8f);
    desc.shift = {1.3f, -0.6f};
    desc.pixel_aspect = 1.7f;
    return desc;
}

}  // namespace

TEST_CASE("a shifted film of oblong pixels shows points where their rays come from", "[camera]")
{
    const int kind = GENERATE(0, 1, 2);
    CameraDesc desc = shifted_view();
    if (kind > 0) {
        desc = kind == 1 ? test::with_lens(desc, 0.3f, 2.0f) : test::in_parallel(desc, 3.0f);
    }
    const Camera camera(desc, width, height);
    test::Random random(5);
    for (int i = 0; i < 500; ++i) {
        const Vec2 raster = random.next_2d() * Vec2(width, height);
        const Vec2 u_lens = random.next_2d();
        const CameraRay ray = camera.generate_ray(raster, u_lens);
        const Vec3 seen = ray.lens.p + (0.1f + 20.0f * random.next()) * ray.direction;
        const auto lens = camera.sample_lens(seen, u_lens);
        REQUIRE(lens.has_value());
        CHECK(glm::distance(lens->raster, raster) < 2e-3f);
        CHECK(lens->pdf_direction.value == Approx(ray.pdf_direction.value).epsilon(1e-3));
        if (camera.has_finite_lens()) {
            const auto hit = camera.hit_lens(seen, -ray.direction);
            REQUIRE(hit.has_value());
            CHECK(glm::distance(hit->raster, raster) < 2e-3f);
            CHECK(hit->pdf_direction.value == Approx(ray.pdf_direction.value).epsilon(1e-3));
        } else {
            const auto place = camera.project(seen);
            REQUIRE(place.has_value());
            CHECK(glm::distance(*place, raster) < 2e-3f);
        }
    }
}

TEST_CASE("shift and pixel aspect are the intrinsics of a camera", "[camera]")
{
    CameraDesc desc = shifted_view();
    desc.world_from_camera = Mat4(1.0f);
    const Vec2 axis(width * (0.5f - desc.shift.x), height * (0.5f + desc.shift.y));
    const float fy = 0.5f * height / std::tan(0.5f * desc.vertical_fov);
    const float fx = fy / desc.pixel_aspect;
    const Vec3 point(3.0f, -0.7f, -2.0f);
    const auto place = Camera(desc, width, height).project(point);
    REQUIRE(place.has_value());
    CHECK(place->x == Approx(axis.x + fx * point.x / -point.z));
    CHECK(place->y == Approx(axis.y - fy * point.y / -point.z));
    // Parallel rays: metres to pixels.
    desc = test::in_parallel(desc, 3.0f);
    const auto parallel = Camera(desc, width, height).project(point);
    REQUIRE(parallel.has_value());
    CHECK(parallel->x == Approx(axis.x + height / 3.0f / desc.pixel_aspect * point.x));
    CHECK(parallel->y == Approx(axis.y - height / 3.0f * point.y));
}

TEST_CASE("a shifted film sees what a window of a larger film sees", "[camera]")
{
    // Twice as wide and high; its window begins at (40, 10).
    CameraDesc large = test::camera_at({1.0f, 2.0f, 3.0f}, {0.0f, 0.5f, -1.0f}, 1.4f);
    if (GENERATE(false, true)) {
        large = test::with_lens(large, 0.2f, 2.5f);
    }
    CameraDesc shifted = large;
    shifted.vertical_fov = 2.0f * std::atan(0.5f * std::tan(0.7f));
    shifted.shift = {(40.0f + 32.0f - width) / width, (height - (10.0f + 18.0f)) / height};
    const Camera of_large(large, 2 * width, 2 * height);
    const Camera of_shifted(shifted, width, height);
    for (const Vec2 raster : {Vec2(0.0f), Vec2(64.0f, 3.0f), Vec2(20.0f, 36.0f)}) {
        const CameraRay a = of_large.generate_ray(raster + Vec2(40.0f, 10.0f), {0.3f, 0.9f});
        const CameraRay b = of_shifted.generate_ray(raster, {0.3f, 0.9f});
        CHECK(a.lens.p == b.lens.p);
        CHECK(glm::distance(a.direction, b.direction) < 1e-6f);
        // The same rays are spread over a quarter of the film.
        CHECK(b.pdf_direction.value == Approx(4.0f * a.pdf_direction.value));
    }
}

}  // namespace bdpt::camera_test
