#include <bdpt/light/environment_image.h>
#include <bdpt/scene.h>

#include "catch.hpp"
#include "identity/scene_identity.h"
#include "light/environment_light.h"
#include "statistics.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace bdpt::environment_image_test {
namespace {

constexpr int width = 64;
constexpr int height = 32;
constexpr std::size_t pixels = std::size_t{width} * height;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Numbers with `digits` binary digits over many stops, which differ in brightness from row to row.
Image sky(int digits)
{
    test::Random random(7);
    Image image{.width = width, .height = height, .pixels = {}};
    const float step = std::exp2(static_cast<float>(digits));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Rgb pixel;
            for (int c = 0; c < 3; ++c) {
                pixel[c] = std::ldexp(std::floor(step * (1.0f + random.next())) / step, y / 2 - 8);
            }
            image.pixels.push_back(x % 7 == 0 ? Rgb(0.0f) : pixel);
        }
    }
    return image;
}

Image times(Image image, float factor)
{
    for (Rgb& pixel : image.pixels) {
        pixel *= factor;
    }
    return image;
}

/// Does a light look up the same radiance from both?
bool look_alike(const EnvironmentImage& a, const EnvironmentImage& b)
{
    const BoundingSphere bounds{.center = Vec3(0.0f), .radius = 1.0f};
    const EnvironmentLight light_a({.radiance = a}, bounds);
    const EnvironmentLight light_b({.radiance = b}, bounds);
    test::Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 to_light = glm::normalize(
            Vec3(random.next() - 0.5f, random.next() - 0.5f, random.next() - 0.499f));
        if (light_a.radiance(to_light) != light_b.radiance(to_light)) {
            return false;
        }
    }
    return light_a.power() == light_b.power();
}

/// Builds the image row by row; nullopt if that is impossible.
std::optional<EnvironmentImage> built(const Image& image)
{
    EnvironmentImageBuilder builder(image.width, image.height);
    const auto row = static_cast<std::size_t>(image.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
        if (!builder.add_row(std::span(image.pixels).subspan(y * row, row))) {
            return std::nullopt;
        }
    }
    return builder.finish();
}

}  // namespace

TEST_CASE("environment image: what halves represent takes 6 bytes per texel, and is exact",
          "[light][texels]")
{
    for (const int digits : {7, 10}) {
        const Image image = sky(digits);
        for (const float unit : {1.0f, 0x1p-20f, 0x1p-90f, 0x1p+80f}) {
            const Image scaled = times(image, unit);
            const EnvironmentImage compact(scaled);
            CAPTURE(digits, unit);
            CHECK(compact.bytes() == 6 * pixels);
            CHECK(compact.floats() == nullptr);
            CHECK(compact.width() == width);
            CHECK(compact.height() == height);
            CHECK(compact.to_image().pixels == scaled.pixels);
            CHECK(compact.at(5, 9) == scaled.at(5, 9));
            // As what would be encoded as a whole.
            const EnvironmentTexels expected(scaled);
            CHECK(compact.texels()->greatest() == expected.greatest());
            REQUIRE(built(scaled).has_value());
            CHECK(built(scaled)->to_image().pixels == scaled.pixels);
        }
    }
}

TEST_CASE("environment image: what halves would round keeps its floats", "[light][texels]")
{
    const Image fine = sky(11);
    const EnvironmentImage image(fine);
    CHECK(image.texels() == nullptr);
    CHECK(image.bytes() == 12 * pixels);
    CHECK(image.to_image().pixels == fine.pixels);
    CHECK_FALSE(built(fine).has_value());
    // Each row fits halves, but not beside the others.
    Image wide{.width = 2, .height = 3, .pixels = std::vector<Rgb>(6, Rgb(0.0f))};
    wide.pixels[1] = Rgb(std::ldexp(1.0f, -30));
    wide.pixels[5] = Rgb(std::ldexp(1.0f, 30));
    CHECK_FALSE(built(wide).has_value());
    CHECK(EnvironmentImage(wide).to_image().pixels == wide.pixels);
    CHECK(EnvironmentImage(wide).bytes() == 6 * sizeof(Rgb));
}

TEST_CASE("environment image: invalid images stay what they are, to be refused", "[light][texels]")
{
    for (const float value : {-1.0f, infinity, std::numeric_limits<float>::quiet_NaN()}) {
        const EnvironmentImage image(
            Image{.width = 2, .height = 1, .pixels = {Rgb(1.0f), Rgb(1.0f, value, 1.0f)}});
        CHECK(image.texels() == nullptr);
        CHECK(image.floats() != nullptr);
    }
    const EnvironmentImage lacking(Image{.width = 3, .height = 2, .pixels = {Rgb(1.0f)}});
    CHECK(lacking.width() == 3);
    CHECK(lacking.texels() == nullptr);
    CHECK(lacking.bytes() == sizeof(Rgb));
    const EnvironmentImage none;
    CHECK(none.width() == 0);
    CHECK(none.bytes() == 0);
    CHECK(none.to_image().pixels.empty());
}

TEST_CASE("environment image: lights and edited scenes share the texels", "[light][texels]")
{
    const EnvironmentLightDesc desc{.radiance = sky(10)};
    const auto owners = [&] { return desc.radiance.texels().use_count(); };
    REQUIRE(owners() == 1);
    {
        const EnvironmentLight light(desc, {.center = Vec3(0.0f), .radius = 1.0f});
        CHECK(owners() == 2);
    }
    SceneDesc scene_desc;
    scene_desc.lights.emplace_back(desc);
    const Scene scene(std::move(scene_desc));
    CHECK(owners() == 3);
    EnvironmentLightDesc turned = desc;
    turned.world_from_environment = Mat3(0, 0, -1, 0, 1, 0, 1, 0, 0);
    const Scene edited = scene.with_environment(turned);
    const auto& found = std::get<EnvironmentLightDesc>(edited.description().lights[0]);
    CHECK(found.radiance.texels() == desc.radiance.texels());
    CHECK(edited.identity() != scene.identity());
}

TEST_CASE("environment image: its hash is that of the floats", "[light][texels]")
{
    for (const int digits : {10, 11}) {
        const Image image = sky(digits);
        DescHasher expected;
        expected.add(image.width);
        expected.add(image.height);
        expected.add(image.pixels);
        DescHasher found;
        found.add(EnvironmentImage(image));
        CHECK(found.hash() == expected.hash());
    }
}

TEST_CASE("environment image: compact texels stay compact when scaled, and look the same",
          "[light][texels]")
{
    const Image image = sky(10);
    const EnvironmentImage compact(image);
    for (const float factor : {0.0f, 0.5f, 0.7f, 3.1f, 1e20f}) {
        CAPTURE(factor);
        const EnvironmentImage scaled = compact.scaled(factor);
        CHECK(scaled.bytes() == 6 * pixels);
        CHECK(look_alike(scaled, times(image, factor)));
    }
    CHECK(compact.to_image().pixels == image.pixels);
    CHECK(compact.scaled(-1.0f).at(1, 0) == -image.at(1, 0));
    CHECK(compact.scaled(1e38f).floats() != nullptr);  // infinite values
    const EnvironmentImage floats(sky(11));
    CHECK(floats.scaled(0.7f).to_image().pixels == times(sky(11), 0.7f).pixels);
}

}  // namespace bdpt::environment_image_test
