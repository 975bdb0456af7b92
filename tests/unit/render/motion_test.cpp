#include <bdpt/error.h>
#include <bdpt/render.h>

#include "catch.hpp"
#include "moving_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::render_motion_test {
namespace {

using test::SceneBuilder;

RenderOptions options(IntegratorKind integrator)
{
    RenderOptions result;
    result.integrator = integrator;
    result.film.width = 24;
    result.film.height = 18;
    result.sampling.samples = {.begin = 0, .end = 6};
    result.transport.max_depth = 4;
    return result;
}

CameraDesc moving_lens()
{
    CameraDesc camera = test::moving(test::room_camera());
    camera.lens_radius = 0.2f;
    camera.focus_distance = 3.0f;
    return camera;
}

/// Lights of all kinds that can move, and what they light.
Scene everything()
{
    SceneBuilder builder = test::moving_stage();
    builder.light(PointLightDesc{.position = {0.0f, 0.3f, 0.3f},
                                 .intensity = Rgb(0.5f),
                                 .motion = {{0.2f, 0.3f, 0.3f}, {0.2f, 0.5f, 0.3f}}});
    builder.light(SpotLightDesc{.position = {0.0f, 0.5f, 0.3f},
                                .direction = {0.0f, -1.0f, 0.0f},
                                .intensity = Rgb(0.5f),
                                .inner_cone_angle = 0.2f,
                                .outer_cone_angle = 0.6f,
                                .radius = 0.1f,
                                .motion = {{0.3f, 0.5f, 0.3f}},
                                .later_directions = {{0.5f, -1.0f, 0.0f}, {1.0f, -1.0f, 0.0f}}});
    builder.light(DirectionalLightDesc{.direction = {0.0f, -1.0f, -0.5f},
                                       .illuminance = Rgb(0.5f),
                                       .later_directions = {{0.5f, -1.0f, -0.5f}}});
    return Scene(std::move(builder.desc));
}

/// A square that shines with 1 nit, from x = 0 to 1 at first, before an orthographic camera that
/// sees x from 0 to 8 in as many pixels.
struct Slide {
    SceneBuilder builder;
    CameraDesc camera;
};

Slide slide()
{
    Slide result;
    MaterialDesc unlit = test::lambertian(Rgb(1.0f));
    unlit.unlit = true;
    result.builder.quad({0, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0, 1, 0}, unlit);
    result.camera.world_from_camera = test::translation({4.0f, 0.0f, 1.0f});
    result.camera.projection = Projection::orthographic;
    result.camera.vertical_extent = 1.0f;
    return result;
}

std::vector<float> row(const Slide& what, IntegratorKind integrator)
{
    RenderOptions o;
    o.integrator = integrator;
    o.film.width = 8;
    o.film.height = 1;
    o.transport.max_depth = 1;
    o.sampling.samples = {.begin = 0, .end = 8192};
    const Image image = render(Scene(what.builder.desc), what.camera, o).film.develop();
    std::vector<float> result;
    for (int x = 0; x < o.film.width; ++x) {
        result.push_back(image.at(x, 0).g);
    }
    return result;
}

/// How much of pixel `x` the square covers on average while its left edge goes `position(time)`.
double coverage(int x, const std::function<double(double)>& position)
{
    constexpr int times = 20000;
    double sum = 0.0;
    for (int i = 0; i < times; ++i) {
        const double left = position((i + 0.5) / times);
        sum += std::max(0.0, std::min(x + 1.0, left + 1.0) - std::max(double(x), left));
    }
    return sum / times;
}

std::string refusal(const std::function<void(SceneDesc&)>& change)
{
    SceneBuilder builder = test::moving_stage();
    builder.light(PointLightDesc{});
    builder.light(SpotLightDesc{});
    change(builder.desc);
    try {
        const Scene scene(std::move(builder.desc));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        return error.what();
    }
    return "";
}

void check_refused(const std::string& text, const std::function<void(SceneDesc&)>& change)
{
    CHECK(refusal(change).find(text) != std::string::npos);
    INFO(refusal(change));
    CHECK(refusal(change).find('\n') == std::string::npos);
}

}  // namespace

TEST_CASE("a square that slides covers pixels for as long as it is there", "[motion]")
{
    // By instance, by vertices and by the camera, at one speed and at two.
    const auto kind = GENERATE(IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt);
    const auto even = [](double t) { return 0.5 + 5.0 * t; };
    const auto uneven = [](double t) { return t < 0.5 ? 0.5 + 2.0 * t : 1.5 + 9.0 * (t - 0.5); };
    const auto check = [&](const Slide& what, const std::function<double(double)>& position) {
        const std::vector<float> pixels = row(what, kind);
        for (int x = 0; x < 8; ++x) {
            CAPTURE(static_cast<int>(kind), x);
            CHECK(static_cast<double>(pixels[static_cast<std::size_t>(x)]) ==
                  Approx(coverage(x, position)).margin(0.004));
        }
    };
    const auto at = [](double x) { return Vec3(x, 0.0, 0.0); };
    for (const int steps : {1, 4}) {
        CAPTURE(steps);
        Slide instance = slide();
        test::move_last(instance.builder, steps, [&](float t) {
            return test::translation(at(even(static_cast<double>(t))));
        });
        check(instance, even);
        Slide camera = slide();
        const Mat4 rest = camera.camera.world_from_camera;
        const auto pose = [&](float t) {
            return test::translation(-at(even(static_cast<double>(t)))) * rest;
        };
        camera.camera.world_from_camera = pose(0.0f);
        camera.camera.motion = test::make_motion<Mat4>(steps, pose);
        check(camera, even);
    }
    Slide instance = slide();
    test::move_last(instance.builder, 2,
                    [&](float t) { return test::translation(at(uneven(static_cast<double>(t)))); });
    check(instance, uneven);
    Slide mesh = slide();
    test::deform(mesh.builder.desc.meshes[0], 4,
                 [&](Vec3 p, float t) { return p + at(uneven(static_cast<double>(t))); });
    check(mesh, uneven);
}

TEST_CASE("a moment of a motion is the still image of it, in AOVs too", "[motion][aov]")
{
    // While nothing moves but the time is drawn, all that time can do is nothing.
    const auto still = [](bool with_steps) {
        SceneBuilder builder;
        builder.walls(test::lambertian(Rgb(0.7f)), test::lambertian(Rgb(0.5f)));
        builder.lamp(0.9f, 0.4f, Rgb(5.0f));
        builder.sphere({0.2f, -0.5f, 0.0f}, 0.4f, test::lambertian(Rgb(0.5f)), 12);
        for (InstanceDesc& instance : builder.desc.instances) {
            if (with_steps) {
                instance.motion.assign(2, instance.world_from_object);
            }
        }
        return Scene(std::move(builder.desc));
    };
    RenderOptions o = options(IntegratorKind::mis);
    o.sampling.samples = {.begin = 0, .end = 64};
    o.film.aovs = {Aov::albedo, Aov::normal, Aov::depth, Aov::position};
    const RenderResult a = render(still(false), test::room_camera(), o);
    const RenderResult b = render(still(true), test::room_camera(), o);
    const auto layers_a = a.aovs.develop(a.film);
    const auto layers_b = b.aovs.develop(b.film);
    for (std::size_t i = 0; i < layers_a.size(); ++i) {
        REQUIRE(layers_a[i].values.size() == layers_b[i].values.size());
        int different = 0;
        for (std::size_t k = 0; k < layers_a[i].values.size(); ++k) {
            const float a_value = layers_a[i].values[k];
            const float b_value = layers_b[i].values[k];  // infinite depth where nothing is
            const bool same = a_value == b_value || std::abs(a_value - b_value) <= 1e-4f;
            different += same ? 0 : 1;
        }
        CAPTURE(layers_a[i].name);
        CHECK(different <= 2);
    }
}

TEST_CASE("moving images are pure", "[motion][purity]")
{
    const Scene scene = everything();
    const CameraDesc camera = moving_lens();
    for (const auto kind : {IntegratorKind::bdpt, IntegratorKind::lt, IntegratorKind::mis}) {
        RenderOptions o = options(kind);
        o.system.threads = 1;
        o.bidirectional.light_paths = kind == IntegratorKind::bdpt ? 2 : 1;
        o.film.aovs = {Aov::normal, Aov::depth};
        const RenderResult expected = render(scene, camera, o);
        CHECK(expected.film.defects().invalid == 0);
        o.system.threads = 8;
        o.system.tile_size = 5;
        const RenderResult other = render(scene, camera, o);
        CHECK(other.film == expected.film);
        CHECK(other.aovs == expected.aovs);
        CHECK(render(everything(), camera, o).film == expected.film);
        o.sampling.samples = {.begin = 2, .end = 6};
        RenderResult parts = render(scene, camera, o);
        o.sampling.samples = {.begin = 0, .end = 2};
        const RenderResult first = render(scene, camera, o);
        parts.film.merge(first.film);
        parts.aovs.merge(first.aovs);
        CHECK(parts.film == expected.film);
        CHECK(parts.aovs == expected.aovs);
    }
}

TEST_CASE("motions that make no sense are refused by name", "[motion][validate]")
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(refusal([](SceneDesc&) {}).empty());
    const auto last = [](SceneDesc& d) -> InstanceDesc& { return d.instances.back(); };
    check_refused("motion, step 1: transform is not finite",
                  [&](SceneDesc& d) { last(d).motion[1][3].x = nan; });
    check_refused("motion, step 0: an interpolated transform before it has no inverse",
                  [&](SceneDesc& d) { last(d).motion[0] *= -1.0f; });
    check_refused("motion of 129 steps, but 128 is the most",
                  [](SceneDesc& d) { d.instances[0].motion.assign(129, Mat4(1.0f)); });
    check_refused("motion of 3 steps, but its mesh has 2",
                  [&](SceneDesc& d) { last(d).motion.push_back(last(d).motion.back()); });
    check_refused(": reaches 2e+15 m", [&](SceneDesc& d) { last(d).motion[0][3].y = 2e15f; });
    check_refused("because an instanced or moving mesh is scaled down very much", [](SceneDesc& d) {
        d.instances[0].motion.assign(1, glm::scale(Mat4(1.0f), Vec3(1e-16f, 1, 1)));
        d.instances[0].world_from_object = d.instances[0].motion[0];
        d.instances[0].motion[0][3].x = 1e3f;
    });
    MeshDesc* (*deforming)(SceneDesc&) = [](SceneDesc& d) {
        return &*std::find_if(d.meshes.begin(), d.meshes.end(),
                              [](const MeshDesc& mesh) { return !mesh.motion.empty(); });
    };
    check_refused("motion, step 2: 3 positions, but the mesh has 4",
                  [&](SceneDesc& d) { deforming(d)->motion[2].positions.pop_back(); });
    check_refused("motion, step 2: 0 normals, but the mesh has 4",
                  [&](SceneDesc& d) { deforming(d)->motion[2].normals.clear(); });
    check_refused("motion, step 0: 1 tangents, but the mesh has 0",
                  [&](SceneDesc& d) { deforming(d)->motion[0].tangents.resize(1); });
    check_refused("motion, step 3: positions 1 is not finite",
                  [&](SceneDesc& d) { deforming(d)->motion[3].positions[1].z = nan; });
    check_refused("motion of 129 steps, but 128 is the most",
                  [&](SceneDesc& d) { deforming(d)->motion.resize(129, deforming(d)->motion[0]); });
    check_refused(": reaches 4e+15 m",
                  [&](SceneDesc& d) { deforming(d)->motion[0].positions[0].x = 4e15f; });
    check_refused("point light 0: motion, step 0: position is not finite",
                  [](SceneDesc& d) { std::get<PointLightDesc>(d.lights[0]).motion = {Vec3(nan)}; });
    check_refused("spot light 1: motion, step 1: is 1e+16 m", [](SceneDesc& d) {
        std::get<SpotLightDesc>(d.lights[1]).motion = {Vec3(0.0f), Vec3(1e16f, 0, 0)};
    });
    check_refused("spot light 1: motion, step 0: direction turns by 90 degrees", [](SceneDesc& d) {
        std::get<SpotLightDesc>(d.lights[1]).later_directions = {Vec3(0, 0, 1)};
    });
    check_refused("spot light 1: motion, step 0: direction is zero", [](SceneDesc& d) {
        std::get<SpotLightDesc>(d.lights[1]).later_directions = {Vec3(0.0f)};
    });
}

TEST_CASE("cameras that move through nothing are refused", "[motion][validate]")
{
    const Scene scene = everything();
    const auto refused = [&](const std::function<void(CameraDesc&)>& change) {
        CameraDesc camera = test::moving(test::room_camera());
        change(camera);
        try {
            static_cast<void>(render(scene, camera, options(IntegratorKind::pt)));
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::invalid_input);
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(refused([](CameraDesc&) {}).empty());
    CHECK(refused([](CameraDesc& c) { c.motion[1] *= -1.0f; }).find("step 1") != std::string::npos);
    CHECK(refused([](CameraDesc& c) {
              c.motion[2][0].x = std::numeric_limits<float>::infinity();
          }).find("motion, step 2: transform is not finite") != std::string::npos);
    CHECK(refused([](CameraDesc& c) {
              c.motion.resize(129, c.world_from_camera);
          }).find("128 is the most") != std::string::npos);
    CHECK(refused([](CameraDesc& c) { c.motion[0][3].y = 2e15f; }).find("step 0: position") !=
          std::string::npos);
}

}  // namespace bdpt::render_motion_test
