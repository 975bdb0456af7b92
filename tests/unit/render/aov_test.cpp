#include <bdpt/error.h>
#include <bdpt/render.h>

#include "catch.hpp"
#include "moving_scenes.h"
#include "scene_builder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace bdpt::aov_test {
namespace {

constexpr int size = 24;

RenderOptions options(AovSet aovs)
{
    RenderOptions result;
    result.integrator = IntegratorKind::pt;
    result.film.width = size;
    result.film.height = size;
    result.sampling.samples = {.begin = 0, .end = 16};
    result.transport.max_depth = 1;
    result.film.aovs = aovs;
    return result;
}

/// A camera at (1, 2, 3) that looks along +x at the plane x = 5, which fills the left of the image
/// up to its middle.
const CameraDesc camera = test::camera_at({1.0f, 2.0f, 3.0f}, {5.0f, 2.0f, 3.0f}, 0.9f);

SceneDesc half_wall(const MaterialDesc& material)
{
    test::SceneBuilder builder;
    builder.quad({5, -20, 3}, {5, -20, -40}, {5, 20, -40}, {5, 20, 3}, material);
    return builder.desc;
}

const Layer& layer(const std::vector<Layer>& layers, const std::string& name)
{
    for (const Layer& candidate : layers) {
        if (candidate.name == name) {
            return candidate;
        }
    }
    throw std::runtime_error("no layer " + name);
}

float value(const Layer& layer, int x, int y, std::size_t channel)
{
    const std::size_t pixel = static_cast<std::size_t>(y * layer.width + x);
    return layer.values[pixel * layer.channels.size() + channel];
}

}  // namespace

TEST_CASE("AOVs of a wall are what geometry says", "[aov]")
{
    const Rgb color(0.25f, 0.5f, 0.75f);
    // The wall's front may look at the camera or away.
    SceneDesc desc = half_wall(test::lambertian(color));
    const bool turned = GENERATE(false, true);
    if (turned) {
        desc.instances[0].world_from_object = glm::scale(Mat4(1.0f), Vec3(1.0f, -1.0f, 1.0f));
    }
    const Scene scene(desc);
    const RenderResult result = render(scene, camera,
                                       options({Aov::albedo, Aov::normal, Aov::depth, Aov::position,
                                                Aov::sample_count, Aov::alpha}));
    const std::vector<Layer> layers = result.aovs.develop(result.film);
    REQUIRE(layers.size() == 6);
    CHECK(layer(layers, "").channels == "A");
    CHECK(layer(layers, "albedo").channels == "RGB");
    CHECK(layer(layers, "normal").channels == "XYZ");
    CHECK(layer(layers, "depth").channels == "Z");
    CHECK(layer(layers, "position").channels == "XYZ");
    CHECK(layer(layers, "sampleCount").channels == "Y");
    const float pixel = 2.0f * 4.0f * std::tan(0.45f) / size;  // on the wall [m]
    for (const int y : {0, 11, 23}) {
        for (const int x : {0, 5, 11}) {
            CAPTURE(x, y, turned);
            CHECK(value(layer(layers, ""), x, y, 0) == 1.0f);
            // Along the axis, not to the point: equal everywhere.
            CHECK(value(layer(layers, "depth"), x, y, 0) == Approx(4.0f));
            CHECK(value(layer(layers, "normal"), x, y, 0) == Approx(-1.0f));
            CHECK(value(layer(layers, "normal"), x, y, 1) == Approx(0.0f).margin(1e-6));
            const float right = (static_cast<float>(x) + 0.5f - 12.0f) * pixel;
            const float up = (12.0f - static_cast<float>(y) - 0.5f) * pixel;
            CHECK(value(layer(layers, "position"), x, y, 0) == Approx(5.0f));
            CHECK(value(layer(layers, "position"), x, y, 1) == Approx(2.0f + up).margin(0.06));
            CHECK(value(layer(layers, "position"), x, y, 2) == Approx(3.0f + right).margin(0.06));
            for (std::size_t c = 0; c < 3; ++c) {
                CHECK(value(layer(layers, "albedo"), x, y, c) ==
                      Approx(color[static_cast<int>(c)]));
            }
            CHECK(value(layer(layers, "sampleCount"), x, y, 0) == 16.0f);
            // The right half is empty.
            const int far = 23 - x;
            CHECK(value(layer(layers, ""), far, y, 0) == 0.0f);
            CHECK(value(layer(layers, "depth"), far, y, 0) ==
                  std::numeric_limits<float>::infinity());
            CHECK(value(layer(layers, "normal"), far, y, 0) == 0.0f);
            CHECK(value(layer(layers, "position"), far, y, 2) == 0.0f);
            CHECK(value(layer(layers, "albedo"), far, y, 1) == 0.0f);
        }
    }
}

TEST_CASE("opacity is alpha without chance where surfaces blend or are clear", "[aov]")
{
    // Two veils or panes one behind the other, and nothing else.
    MaterialDesc veil = test::lambertian(Rgb(0.5f));
    veil.alpha_mode = AlphaMode::blend;
    veil.base_color.w = 0.4f;
    if (GENERATE(false, true)) {
        veil = test::thin_glass(0.0f);
        veil.ior = 1.0f;  // does not reflect
        veil.base_color = {0.6f, 0.6f, 0.6f, 1.0f};
    }
    test::SceneBuilder builder;
    builder.quad({5, -20, 3}, {5, -20, -40}, {5, 20, -40}, {5, 20, 3}, veil);
    builder.quad({6, -20, 3}, {6, -20, -40}, {6, 20, -40}, {6, 20, 3}, veil);
    const bool backed = GENERATE(false, true);
    if (backed) {
        builder.quad({7, -20, 3}, {7, -20, -40}, {7, 20, -40}, {7, 20, 3},
                     test::lambertian(Rgb(0.5f)));
    }
    const RenderResult result =
        render(Scene(builder.desc), camera, options({Aov::alpha, Aov::opacity}));
    const std::vector<Layer> layers = result.aovs.develop(result.film);
    REQUIRE(layers.size() == 2);
    const Layer& opacity = layer(layers, "opacity");
    CHECK(opacity.channels == "A");
    double chance = 0.0;
    double mean = 0.0;
    const double expected_alpha = backed ? 1.0 : 1.0 - 0.6 * 0.6;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size / 2 - 1; ++x) {
            CHECK(value(opacity, x, y, 0) == Approx(expected_alpha).epsilon(1e-5));
            CHECK(value(opacity, size - 1 - x, y, 0) == 0.0f);
            const auto alpha = static_cast<double>(value(layer(layers, ""), x, y, 0));
            chance += std::abs(alpha - expected_alpha);
            mean += alpha / (size * (size / 2 - 1));
        }
    }
    CHECK(mean == Approx(expected_alpha).margin(0.04));
    CHECK((chance > 1.0) == !backed);  // alpha itself is met by chance
}

TEST_CASE("the samples of a pixel pass a blended surface in their stratified share", "[aov]")
{
    MaterialDesc veil = test::lambertian(Rgb(0.5f));
    veil.alpha_mode = AlphaMode::blend;
    veil.base_color.w = 0.4f;
    test::SceneBuilder builder;
    builder.quad({5, -20, 3}, {5, -20, -40}, {5, 20, -40}, {5, 20, 3}, veil);
    const RenderResult result = render(Scene(builder.desc), camera, options({Aov::alpha}));
    const std::vector<Layer> layers = result.aovs.develop(result.film);
    // By chance, one pixel in five would deviate by more: 16 samples have a deviation of 2.
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size / 2 - 1; ++x) {
            CHECK(std::abs(value(layer(layers, ""), x, y, 0) - 0.4f) <= 2.0f / 16.0f);
        }
    }
}

TEST_CASE("AOVs are of the very rays that make the image", "[aov]")
{
    // Paths of one edge on a surface of one nit: the pixel is the share of rays that hit.
    MaterialDesc lamp = test::emitter(Rgb(1.0f));
    lamp.double_sided = true;
    test::SceneBuilder builder;
    // Rays that pass a surface have not met it, in the AOVs as in the image.
    const bool passable = GENERATE(false, true);
    lamp.alpha_mode = passable ? AlphaMode::blend : AlphaMode::opaque;
    lamp.base_color.w = 0.3f;
    builder.sphere({5.0f, 2.0f, 3.0f}, 1.3f, lamp, 16);
    // They have the time of the sample, too, whatever moves: nothing, the sphere, or the camera
    // across the direction in which it looks.
    const int moving = GENERATE(0, 1, 2);
    const auto aside = [](float t) { return test::translation({0.0f, 0.4f * t, 1.2f * t}); };
    CameraDesc view = camera;
    if (moving == 1) {
        const Mat4 rest = builder.desc.instances[0].world_from_object;
        test::move_last(builder, 2, [&](float t) { return aside(t) * rest; });
    } else if (moving == 2) {
        view.motion = test::make_motion<Mat4>(
            3, [&](float t) { return aside(t) * camera.world_from_camera; });
    }
    CAPTURE(passable, moving);
    const Scene scene(builder.desc);
    RenderOptions o = options({Aov::alpha, Aov::depth, Aov::position});
    o.bidirectional.disabled = {{.s = 1, .t = 1}};  // its splats do not follow the camera's rays
    for (const auto kind : {IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::bdpt}) {
        for (const auto filter : {FilterKind::box, FilterKind::gaussian}) {
            o.integrator = kind;
            o.film.filter.kind = filter;
            o.sampling.seed = 5;
            const RenderResult result = render(scene, view, o);
            const std::vector<Layer> layers = result.aovs.develop(result.film);
            const Image image = result.film.develop();
            int partial = 0;
            float inside = 0.0f;
            for (int y = 0; y < size; ++y) {
                for (int x = 0; x < size; ++x) {
                    const float alpha = value(layer(layers, ""), x, y, 0);
                    REQUIRE(alpha == image.at(x, y).g);
                    inside += x >= 10 && x < 14 && y >= 10 && y < 14 ? alpha / 16.0f : 0.0f;
                    partial += alpha > 0.0f && alpha < 1.0f ? 1 : 0;
                    if (alpha > 0.0f) {
                        // Position and depth are means over the same hits.
                        CHECK(value(layer(layers, "position"), x, y, 0) - 1.0f ==
                              Approx(value(layer(layers, "depth"), x, y, 0)).epsilon(1e-5));
                    }
                }
            }
            CHECK(partial > 10);
            // Front and back of the sphere: 1 - 0.7^2.
            if (moving == 0) {
                CHECK(inside == Approx(passable ? 0.51 : 1.0).margin(0.1));
            }
        }
    }
}

TEST_CASE("the normal AOV is the shading normal, the albedo AOV the textured colour", "[aov]")
{
    test::SceneBuilder builder;
    builder.sphere({5.0f, 2.0f, 3.0f}, 1.0f, test::lambertian(Rgb(1.0f)), 8);
    builder.desc.images.push_back({.width = 1, .height = 1, .bytes = {188, 0, 255, 255}});
    builder.desc.materials[0].base_color_texture = TextureRef{.image = ImageId{0}};
    const Scene scene(builder.desc);
    const RenderResult result =
        render(scene, camera, options({Aov::normal, Aov::position, Aov::albedo}));
    const std::vector<Layer> layers = result.aovs.develop(result.film);
    for (const auto& [x, y] : {std::pair{12, 12}, {10, 13}, {13, 9}}) {
        Vec3 normal;
        Vec3 position;
        for (int c = 0; c < 3; ++c) {
            const auto channel = static_cast<std::size_t>(c);
            normal[c] = value(layer(layers, "normal"), x, y, channel);
            position[c] = value(layer(layers, "position"), x, y, channel);
        }
        // Interpolated: that of a sphere, although there are only eight facets around.
        const Vec3 expected = glm::normalize(position - Vec3(5.0f, 2.0f, 3.0f));
        CHECK(glm::dot(glm::normalize(normal), expected) > 0.985f);
        CHECK(value(layer(layers, "albedo"), x, y, 0) == Approx(0.5029f).epsilon(1e-3));
        CHECK(value(layer(layers, "albedo"), x, y, 1) == 0.0f);
        CHECK(value(layer(layers, "albedo"), x, y, 2) == 1.0f);
    }
}

TEST_CASE("distance is along the rays, from the lens", "[aov]")
{
    CameraDesc view = camera;
    view.shift = {-0.8f, 0.3f};  // to the wall, far from the axis
    RenderOptions o = options({Aov::distance, Aov::depth, Aov::position});
    o.sampling.samples = {.begin = 0, .end = 1};  // no means
    const int kind = GENERATE(0, 1, 2);           // pinhole, parallel rays, lens
    if (kind == 1) {
        view = test::in_parallel(view, 3.0f);
    } else if (kind == 2) {
        view = test::with_lens(view, 0.5f, 2.0f);
    }
    const Scene scene(half_wall(test::lambertian(Rgb(0.5f))));
    const RenderResult result = render(scene, view, o);
    const std::vector<Layer> layers = result.aovs.develop(result.film);
    CHECK(layer(layers, "distance").channels == "Z");
    float longest = 0.0f;
    for (const auto& [x, y] : {std::pair{0, 0}, {5, 23}, {20, 11}}) {
        CAPTURE(kind, x, y);
        Vec3 position;
        for (int c = 0; c < 3; ++c) {
            position[c] = value(layer(layers, "position"), x, y, static_cast<std::size_t>(c));
        }
        const float found = value(layer(layers, "distance"), x, y, 0);
        const float to_eye = glm::distance(position, Vec3(1.0f, 2.0f, 3.0f));
        longest = std::max(longest, found);
        if (kind == 0) {
            CHECK(found == Approx(to_eye));
        } else if (kind == 1) {
            CHECK(found == Approx(value(layer(layers, "depth"), x, y, 0)));
        } else {
            CHECK(found == Approx(to_eye).margin(0.5));
            CHECK(found != Approx(to_eye));
        }
    }
    CHECK((longest > 5.0f) == (kind != 1));  // the wall is 4 m away
    const RenderResult beside = render(scene, camera, o);
    CHECK(value(beside.aovs.develop(beside.film).at(1), 23, 0, 0) ==
          std::numeric_limits<float>::infinity());
}

TEST_CASE("uv are the texture coordinates of set 0, and 0 without any", "[aov]")
{
    SceneDesc desc = half_wall(test::lambertian(Rgb(0.5f)));
    desc.meshes[0].uvs[0] = {{0, 0}, {43, 0}, {43, 40}, {0, 40}};  // a unit each metre
    desc.meshes[0].uvs[1] = {{9, 9}, {9, 9}, {9, 9}, {9, 9}};
    const auto layers_of = [](const SceneDesc& scene) {
        const RenderResult result =
            render(Scene(scene), camera, options({Aov::uv, Aov::position, Aov::alpha}));
        return result.aovs.develop(result.film);
    };
    const std::vector<Layer> layers = layers_of(desc);
    const Layer& uv = layer(layers, "uv");
    CHECK(uv.channels == "UV");
    for (const auto& [x, y] : {std::pair{0, 0}, {5, 23}, {11, 11}}) {
        CHECK(value(uv, x, y, 0) ==
              Approx(3.0f - value(layer(layers, "position"), x, y, 2)).margin(1e-4));
        CHECK(value(uv, x, y, 1) == Approx(20.0f + value(layer(layers, "position"), x, y, 1)));
        CHECK(value(uv, 23 - x, y, 1) == 0.0f);  // beside the wall
    }
    desc.meshes[0].uvs = {};
    CHECK(value(layer(layers_of(desc), "uv"), 5, 5, 1) == 0.0f);
}

TEST_CASE("normals of the camera are those of the world in its axes", "[aov]")
{
    test::SceneBuilder builder;
    builder.sphere({5.0f, 2.0f, 3.0f}, 1.0f, test::lambertian(Rgb(0.5f)), 16);
    const CameraDesc view = test::camera_at({3.0f, 4.0f, 1.0f}, {5.1f, 2.0f, 3.2f}, 0.6f);
    const RenderResult result =
        render(Scene(builder.desc), view, options({Aov::normal, Aov::camera_normal}));
    const std::vector<Layer> layers = result.aovs.develop(result.film);
    CHECK(layer(layers, "cameraNormal").channels == "XYZ");
    float right = 0.0f;
    float up = 0.0f;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            Vec3 normal;
            Vec3 seen;
            for (int c = 0; c < 3; ++c) {
                const auto channel = static_cast<std::size_t>(c);
                normal[c] = value(layer(layers, "normal"), x, y, channel);
                seen[c] = value(layer(layers, "cameraNormal"), x, y, channel);
            }
            REQUIRE(glm::distance(Mat3(view.world_from_camera) * seen, normal) < 1e-5f);
            CHECK(seen.z > -0.1f);  // towards the viewer, almost at the silhouette
            right = x == 18 && y == 12 ? seen.x : right;
            up = x == 12 && y == 5 ? seen.y : up;
        }
    }
    CHECK(right > 0.4f);
    CHECK(up > 0.4f);
}

TEST_CASE("AOVs of different regions or kinds are not merged", "[aov]")
{
    const PixelRect region{0, 0, 2, 2};
    AovFilm film(region, {Aov::depth});
    CHECK_THROWS_AS(film.merge(AovFilm(region, {Aov::normal})), Error);
    CHECK_THROWS_AS(film.merge(AovFilm({0, 0, 2, 1}, {Aov::depth})), Error);
    CHECK_THROWS_AS(film.develop(Film(
                        {.width = 3, .height = 2, .region = {.x0 = 0, .y0 = 0, .x1 = 3, .y1 = 2}})),
                    Error);
}

}  // namespace bdpt::aov_test
