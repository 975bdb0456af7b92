#include <bdpt/eval/bench/bench_options.h>
#include <bdpt/eval/bench/bench_scene.h>
#include <bdpt/eval/bench/error_floor.h>
#include <bdpt/eval/bench/integrator_kinds.h>
#include <bdpt/eval/bench/reference.h>
#include <bdpt/eval/image/shrunk.h>
#include <bdpt/eval/report/packed_image.h>
#include <bdpt/options/integrators.h>
#include <bdpt/options/option_fields.h>

#include "bench/trial.h"

#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "bench_scene.h"
#include "catch.hpp"
#include "test_images.h"

namespace bdpt::eval::bench_parts_test {
namespace {

using test::flat;
using test::random_image;

TEST_CASE("integrators have names, and names integrators")
{
    for (const IntegratorKind kind : all_integrators()) {
        CHECK(enumerator_of<IntegratorKind>(name_of(kind)) == kind);
    }
    // Benchmarks leave biased ones out unless they are asked for.
    CHECK(unbiased_integrators().size() == all_integrators().size() - 1);
    CHECK(BenchOptions{}.integrators == unbiased_integrators());
    CHECK(info(*enumerator_of<IntegratorKind>("vcm")).biased);
    CHECK_FALSE(enumerator_of<IntegratorKind>("BDPT"));
    CHECK_FALSE(enumerator_of<IntegratorKind>(""));
}

TEST_CASE("all that an image depends on is in the hash of a scene, names are not")
{
    const SceneDesc base = test::lit_floor();
    const std::vector<std::function<void(SceneDesc&)>> changes{
        [](SceneDesc& s) { s.meshes[0].positions[2].y += 1e-6f; },
        [](SceneDesc& s) { std::swap(s.meshes[1].triangles[0].x, s.meshes[1].triangles[0].y); },
        [](SceneDesc& s) { s.meshes[0].normals.resize(4, Vec3(0.0f, 1.0f, 0.0f)); },
        [](SceneDesc& s) { s.meshes[0].uvs[0][0].x = 0.5f; },
        [](SceneDesc& s) { s.meshes[0].uvs[1].resize(4, Vec2(0.0f)); },
        [](SceneDesc& s) { s.materials[0].base_color.y += 0.01f; },
        [](SceneDesc& s) { s.materials[0].roughness = 0.9f; },
        [](SceneDesc& s) { s.materials[0].ior = 1.4f; },
        [](SceneDesc& s) { s.materials[0].transmission = 0.1f; },
        [](SceneDesc& s) { s.materials[0].dispersion = 0.1f; },
        [](SceneDesc& s) { s.materials[0].clearcoat.factor = 0.1f; },
        [](SceneDesc& s) { s.materials[0].clearcoat.roughness = 0.1f; },
        [](SceneDesc& s) { s.materials[0].clearcoat.normal_scale = 0.5f; },
        [](SceneDesc& s) { s.materials[0].sheen.color.g = 0.1f; },
        [](SceneDesc& s) { s.materials[0].sheen.roughness = 0.1f; },
        [](SceneDesc& s) { s.materials[0].anisotropy.strength = 0.1f; },
        [](SceneDesc& s) { s.materials[0].anisotropy.rotation = 0.1f; },
        [](SceneDesc& s) { s.materials[0].iridescence.factor = 0.1f; },
        [](SceneDesc& s) { s.materials[0].iridescence.ior = 1.4f; },
        [](SceneDesc& s) { s.materials[0].iridescence.thickness_minimum = 99.0f; },
        [](SceneDesc& s) { s.materials[0].iridescence.thickness_maximum = 99.0f; },
        [](SceneDesc& s) { s.materials[0].diffuse_transmission.factor = 0.1f; },
        [](SceneDesc& s) { s.materials[0].diffuse_transmission.color.b = 0.1f; },
        [](SceneDesc& s) { s.materials[0].sheen.color_texture = TextureRef{}; },
        [](SceneDesc& s) { s.materials[0].glossiness_texture = TextureRef{}; },
        [](SceneDesc& s) { s.materials[0].normal_texture = TextureRef{}; },
        [](SceneDesc& s) { s.materials[0].emission_texture = TextureRef{}; },
        [](SceneDesc& s) { s.materials[1].emission.b = 19.0f; },
        [](SceneDesc& s) { s.materials[1].double_sided = true; },
        [](SceneDesc& s) { s.instances[1].material = MaterialId{0}; },
        [](SceneDesc& s) { s.instances[1].world_from_object[3].x = 0.1f; },
        [](SceneDesc& s) { s.lights.emplace_back(PointLightDesc{}); },
        [](SceneDesc& s) { s.lights.emplace_back(SpotLightDesc{}); },
        [](SceneDesc& s) { s.lights.emplace_back(ProfileLightDesc{}); },
        [](SceneDesc& s) { s.lights.emplace_back(ProfileLightDesc{.scale = Rgb(2.0f)}); },
        [](SceneDesc& s) { s.lights.emplace_back(ProfileLightDesc{.motion = {Vec3(1.0f)}}); },
        [](SceneDesc& s) { s.lights.emplace_back(PointLightDesc{.motion = {Vec3(1.0f)}}); },
        [](SceneDesc& s) {
            s.profiles.push_back({{0.0f, 1.0f}, {0.0f}, {1.0f, 2.0f}});
        },
        [](SceneDesc& s) {
            s.profiles.push_back({{0.0f, 1.0f}, {0.0f}, {1.0f, 3.0f}});
        },
        [](SceneDesc& s) {
            s.lights.emplace_back(EnvironmentLightDesc{.radiance = flat(2, 1, Rgb(1.0f))});
        },
        [](SceneDesc& s) {
            s.lights.emplace_back(EnvironmentLightDesc{.radiance = flat(1, 2, Rgb(1.0f))});
        },
        [](SceneDesc& s) {
            s.images.push_back({1, 1, {1, 2, 3, 4}});
        },
        [](SceneDesc& s) {
            s.images.push_back({1, 1, {1, 2, 3, 5}});
        },
        [](SceneDesc& s) {
            s.images.push_back({1, 1, {1, 2, 3, 4}, 2, TexelType::unorm16});
        },
        [](SceneDesc& s) {
            s.images.push_back({1, 1, {1, 2, 3, 4}, 2, TexelType::half});
        },
        [](SceneDesc& s) { s.texture_filter = TextureFilter::mip_mapped; }};
    std::set<std::uint64_t> hashes{content_hash(base)};
    for (const auto& change : changes) {
        SceneDesc changed = base;
        change(changed);
        hashes.insert(content_hash(changed));
    }
    CHECK(hashes.size() == changes.size() + 1);

    SceneDesc renamed = base;
    renamed.meshes[0].name = "floor";
    renamed.instances[1].name = "lamp";
    CHECK(content_hash(renamed) == content_hash(base));

    CameraDesc camera = test::floor_camera();
    const std::uint64_t seen = content_hash(camera);
    camera.name = "other";
    CHECK(content_hash(camera) == seen);
    camera.lens_radius = 0.1f;
    CHECK(content_hash(camera) != seen);
}

TEST_CASE("runs are looked at at powers of two and at their goals")
{
    CHECK(checkpoint_samples({.equal_time = 10, .equal_samples = 4}) ==
          std::vector<std::int64_t>{1, 2, 4, 8, 10});
    CHECK(checkpoint_samples({.equal_time = 2, .equal_samples = 5}) ==
          std::vector<std::int64_t>{1, 2, 4, 5});
    CHECK(checkpoint_samples({.equal_time = 2, .equal_samples = 1}) ==
          std::vector<std::int64_t>{1, 2});
}

/// An image that is `signal` and noise of the given size in both halves.
HalvedImage noisy(float signal, float noise, std::uint64_t seed)
{
    HalvedImage result{.image = flat(40, 40, Rgb(0.0f)),
                       .first = random_image(40, 40, seed, 2.0f * noise),
                       .second = random_image(40, 40, seed + 1, 2.0f * noise)};
    for (std::size_t i = 0; i < result.image.pixels.size(); ++i) {
        result.first.pixels[i] += Rgb(signal - noise);
        result.second.pixels[i] += Rgb(signal - noise);
        result.image.pixels[i] = 0.5f * (result.first.pixels[i] + result.second.pixels[i]);
    }
    return result;
}

TEST_CASE("two renders count by the inverse of their noise")
{
    // Uniform numbers of a width of 2 n have the variance n^2 / 3, the mean of two of them half.
    const double quiet = 0.1 * 0.1 / 6.0 / 1.01;
    const double loud = 0.2 * 0.2 / 6.0 / 1.01;
    const CombinedReference both = combine(noisy(1.0f, 0.1f, 1), noisy(1.0f, 0.2f, 3));
    CHECK(both.share == Approx(0.8).epsilon(0.03));
    CHECK(both.agreement == Approx(1.0).epsilon(0.1));
    CHECK(both.noise == Approx(0.64 * quiet + 0.04 * loud).epsilon(0.1));
    // What was estimated is what is there.
    double error = 0.0;
    for (const Rgb& pixel : both.image.pixels) {
        for (int c = 0; c < 3; ++c) {
            error += std::pow(static_cast<double>(pixel[c]) - 1.0, 2.0) / 1.01 / 4800.0;
        }
    }
    CHECK(both.noise == Approx(error).epsilon(0.1));

    SECTION("one that lacks light does not count")
    {
        const CombinedReference alone = combine(noisy(1.0f, 0.1f, 1), noisy(0.8f, 0.1f, 3));
        CHECK(alone.agreement > 5.0);
        CHECK(alone.share == 1.0);
        CHECK(alone.noise == Approx(quiet).epsilon(0.1));
    }
    SECTION("without noise both count alike")
    {
        const CombinedReference same = combine(noisy(1.0f, 0.0f, 1), noisy(1.0f, 0.0f, 3));
        CHECK(same.share == 0.5);
        CHECK(same.noise == 0.0);
    }
}

TEST_CASE("what all renders lack is found, noise is not taken for it")
{
    const Image reference = flat(40, 40, Rgb(1.0f));
    std::vector<Image> images;
    for (const std::uint64_t seed : {1u, 11u, 21u, 31u}) {
        images.push_back(noisy(1.0f, 0.6f, seed).image);
    }
    CHECK_FALSE(error_floor(images, reference, 0.0));
    CHECK_FALSE(error_floor(std::span(images).first(2), reference, 0.0));

    for (Image& image : images) {
        for (std::size_t i = 0; i < 400; ++i) {  // a quarter is too dark by a half
            image.pixels[i] -= Rgb(0.5f);
        }
    }
    const double lacking = 0.25 * 0.25 / 1.01;
    const auto floor = error_floor(images, reference, 0.0);
    REQUIRE(floor);
    CHECK(*floor == Approx(lacking).epsilon(0.1));
    CHECK(error_floor(std::span(images).first(2), reference, 0.0).has_value());
    // What the reference's noise explains does not count.
    const auto less = error_floor(images, reference, 0.4 * lacking);
    REQUIRE(less);
    CHECK(*less == Approx(*floor - 0.4 * lacking));
    CHECK_FALSE(error_floor(images, reference, 0.9 * lacking));
}

TEST_CASE("pixels of the page keep nine bits of their greatest component")
{
    for (const Rgb color :
         {Rgb(1.0f, 0.5f, 0.25f), Rgb(0.1f, 3.7f, 900.0f), Rgb(1e-3f, 2e-3f, 0.0f),
          Rgb(65408.0f, 1.0f, 0.0f), Rgb(0.9999f), Rgb(0.0f)}) {
        const Rgb back = unpack_rgb9e5(pack_rgb9e5(color));
        const float greatest = std::max({color.r, color.g, color.b});
        CAPTURE(color.r, color.g, color.b);
        for (int c = 0; c < 3; ++c) {
            CHECK(std::abs(back[c] - color[c]) <= greatest * 0x1p-9f);
        }
    }
    CHECK(unpack_rgb9e5(pack_rgb9e5(Rgb(1e9f, 0.0f, 0.0f))).r == 65408.0f);
    CHECK(unpack_rgb9e5(pack_rgb9e5(Rgb(-1.0f))) == Rgb(0.0f));
    CHECK(unpack_rgb9e5(pack_rgb9e5(Rgb(std::nanf("")))) == Rgb(0.0f));
    CHECK(pack_rgb9e5(Rgb(1.0f, 0.0f, 0.0f)) == (256u | 16u << 27));  // 256/512 * 2^1
}

TEST_CASE("the page's unit of light is a power of two near the mean")
{
    CHECK(page_scale(0.0) == 1.0);
    CHECK(page_scale(0.25) == 1.0);
    CHECK(page_scale(1000.0) == 0x1p-12);
    CHECK(page_scale(1e-3) == 0x1p8);
}

TEST_CASE("shrinking takes means, smaller ones at the border")
{
    const Image image =
        shrunk({3, 2, {Rgb(1.0f), Rgb(2.0f), Rgb(8.0f), Rgb(3.0f), Rgb(4.0f), Rgb(6.0f)}}, 2);
    REQUIRE(image.width == 2);
    REQUIRE(image.height == 1);
    CHECK(image.at(0, 0) == Rgb(2.5f));
    CHECK(image.at(1, 0) == Rgb(7.0f));
}

}  // namespace
}  // namespace bdpt::eval::bench_parts_test
