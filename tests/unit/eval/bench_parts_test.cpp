#include <bdpt/eval/bench.h>
#include <bdpt/eval/bench_report.h>
#include <bdpt/eval/drawing.h>
#include <bdpt/eval/page.h>
#include <bdpt/options/integrators.h>
#include <bdpt/options/option_fields.h>

#include "bench/bench_parts.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
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
        CHECK(parse_enumerator<IntegratorKind>(to_name(kind)) == kind);
    }
    // Benchmarks leave biased ones out unless they are asked for.
    CHECK(unbiased_integrators().size() == all_integrators().size() - 1);
    CHECK(BenchOptions{}.integrators == unbiased_integrators());
    CHECK(info(*parse_enumerator<IntegratorKind>("vcm")).biased);
    CHECK_FALSE(parse_enumerator<IntegratorKind>("BDPT"));
    CHECK_FALSE(parse_enumerator<IntegratorKind>(""));
}

TEST_CASE(
    "settings of a reference: all that its image depends on, but integrator, seed and machine")
{
    const Scene scene(test::lit_floor());
    const BenchScene subject{.name = "floor",
                             .file = "floor.gltf",
                             .scene = scene,
                             .camera = test::floor_camera(),
                             .width = 12,
                             .height = 9};
    const RenderOptions options;
    const auto settings = render_settings(subject, options);
    const std::string content = hash_content(subject);
    CHECK(content.size() == 32);
    CHECK(settings.at("width") == "12");
    CHECK(settings.contains("scene: meshes[0]"));
    CHECK(settings.contains("build: version"));
    for (const char* name : {"integrator", "seed", "build: Embree", "build: compiler"}) {
        CHECK_FALSE(settings.contains(name));
    }

    RenderOptions other = options;
    other.integrator = IntegratorKind::lt;
    other.sampling.seed = 7;
    other.sampling.samples = {.begin = 3, .end = 9};
    other.system.threads = 1;
    CHECK(render_settings(subject, other) == settings);
    other.transport.max_depth = 3;
    CHECK(render_settings(subject, other) != settings);

    SceneDesc moved = test::lit_floor();
    moved.meshes[0].positions[2].y += 1e-6f;
    const Scene moved_scene(std::move(moved));
    BenchScene changed{.name = "floor",
                       .file = "floor.gltf",
                       .scene = moved_scene,
                       .camera = test::floor_camera(),
                       .width = 12,
                       .height = 9};
    CHECK(render_settings(changed, options) != settings);
    CHECK(hash_content(changed) != content);
    BenchScene seen{.name = "floor",
                    .file = "floor.gltf",
                    .scene = scene,
                    .camera = test::floor_camera(),
                    .width = 12,
                    .height = 9};
    seen.camera.name = "other";
    CHECK(hash_content(seen) == content);
    seen.camera.lens_radius = 0.1f;
    CHECK(hash_content(seen) != content);
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
