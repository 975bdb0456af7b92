#include "texture/texture.h"

#include "catch.hpp"
#include "material/material.h"

#include <glm/gtc/packing.hpp>

#include <cmath>
#include <cstring>

namespace bdpt::test::mip_maps_test {
namespace {

void in_two_parts(int count, const std::function<void(int, int)>& work)
{
    work(0, count / 2);
    work(count / 2, count);
}

TexelImage halved(const TexelImage& image, Encoding encoding = Encoding::linear)
{
    return half_size(image, encoding, in_two_parts);
}

/// Columns are 0 and 255 in turn.
TexelImage stripes(int size)
{
    TexelImage image{.width = size, .height = size, .bytes = {}, .channels = 1};
    for (int i = 0; i < size * size; ++i) {
        image.bytes.push_back(i % 2 == 0 ? 0 : 255);
    }
    return image;
}

/// Steps along the axes of texture coordinates, in texels of an image of this size.
UvFootprint footprint(float texels_along, float texels_across, int size)
{
    UvFootprint result;
    result[0] = {.along = Vec2(texels_along / static_cast<float>(size), 0.0f),
                 .across = Vec2(0.0f, texels_across / static_cast<float>(size))};
    return result;
}

/// Images of 16, 8, 4, 2 and 1 texels a side; each is even, and tells its size by its value.
struct Levels {
    std::vector<TexelImage> all;

    Levels()
    {
        for (int size = 16; size > 0; size /= 2) {
            all.push_back({.width = size,
                           .height = size,
                           .bytes = std::vector<std::uint8_t>(static_cast<std::size_t>(size * size),
                                                              static_cast<std::uint8_t>(size)),
                           .channels = 1});
        }
    }

    [[nodiscard]] int size_at(const TextureRef& ref, const UvFootprint& pixel) const
    {
        const Texture texture(ref, all[0], Encoding::linear, std::span(all).subspan(1));
        return static_cast<int>(
            std::lround(255.0f * texture.lookup({Vec2(0.4f), Vec2(0.4f)}, &pixel).x));
    }
};

}  // namespace

TEST_CASE("a copy of half the size has the means of what its texels cover")
{
    const TexelImage even{
        .width = 4, .height = 2, .bytes = {0, 40, 8, 12, 80, 120, 0, 20}, .channels = 1};
    const TexelImage copy = halved(even);
    CHECK(copy.width == 2);
    CHECK(copy.height == 1);
    CHECK(copy.channels == 1);
    CHECK(copy.bytes == std::vector<std::uint8_t>{60, 10});

    SECTION("of odd sizes, too: each texel counts as much as any other")
    {
        // 3 texels under 1; 5 under 2, which share the middle one.
        CHECK(halved({.width = 3, .height = 1, .bytes = {30, 60, 240}, .channels = 1}).bytes ==
              std::vector<std::uint8_t>{110});
        CHECK(halved({.width = 1, .height = 5, .bytes = {100, 50, 200, 0, 25}, .channels = 1})
                  .bytes == std::vector<std::uint8_t>{100, 50});
    }
    SECTION("colours of sRGB are decoded before, alpha is not")
    {
        const TexelImage copy_srgb = halved(
            {.width = 2, .height = 1, .bytes = {0, 0, 255, 255}, .channels = 2}, Encoding::srgb);
        CHECK(copy_srgb.bytes == std::vector<std::uint8_t>{188, 128});
    }
    SECTION("of all types")
    {
        const auto mean = [](TexelType type, auto a, auto b) {
            TexelImage image{.width = 2, .height = 1, .bytes = {}, .channels = 1, .type = type};
            image.bytes.resize(2 * sizeof a);
            std::memcpy(image.bytes.data(), &a, sizeof a);
            std::memcpy(image.bytes.data() + sizeof a, &b, sizeof b);
            const TexelImage smaller = halved(image);
            decltype(a) result;
            std::memcpy(&result, smaller.bytes.data(), sizeof result);
            return result;
        };
        CHECK(mean(TexelType::unorm16, std::uint16_t{1000}, std::uint16_t{3000}) == 2000);
        CHECK(mean(TexelType::float32, 3.0f, 9.0f) == 6.0f);
        CHECK(mean(TexelType::half, glm::packHalf1x16(3.0f), glm::packHalf1x16(9.0f)) ==
              glm::packHalf1x16(6.0f));
    }
}

TEST_CASE("copies go down to one texel, and are made once for each encoding")
{
    MipMaps maps(in_two_parts);
    const TexelImage image = stripes(16);
    const auto linear = maps.of(0, image, Encoding::linear);
    REQUIRE(linear.size() == 4);
    CHECK(linear[0].width == 8);
    CHECK(linear[3].width == 1);
    CHECK(linear[3].bytes == std::vector<std::uint8_t>{128});
    const auto srgb = maps.of(0, image, Encoding::srgb);
    CHECK(srgb[3].bytes == std::vector<std::uint8_t>{188});
    CHECK(maps.of(0, image, Encoding::linear).data() == linear.data());
    const TexelImage one = stripes(1);
    CHECK(maps.of(1, one, Encoding::linear).empty());
    const TexelImage wide{.width = 5, .height = 1, .bytes = {1, 2, 3, 4, 5}, .channels = 1};
    CHECK(maps.of(2, wide, Encoding::linear).size() == 2);
}

TEST_CASE("texels of the chosen copy are at most half as wide as the footprint")
{
    const Levels levels;
    const auto size = [&](float along, float across) {
        return levels.size_at({}, footprint(along, across, 16));
    };
    CHECK(size(0.0f, 0.0f) == 16);
    CHECK(size(3.9f, 3.9f) == 16);
    CHECK(size(4.1f, 4.1f) == 8);
    CHECK(size(7.9f, 7.9f) == 8);
    CHECK(size(8.1f, 8.1f) == 4);
    CHECK(size(16.1f, 16.1f) == 2);
    CHECK(size(32.1f, 32.1f) == 1);
    CHECK(size(1e9f, 1e9f) == 1);
    SECTION("where it is narrowest, whatever its direction")
    {
        CHECK(size(1000.0f, 3.9f) == 16);
        CHECK(size(8.1f, 1000.0f) == 4);
        UvFootprint turned;  // 8.2 by 80 texels, turned by 45 degrees
        turned[0] = {.along = Vec2(8.2f, 8.2f) * (0.70711f / 16.0f),
                     .across = Vec2(-80.0f, 80.0f) * (0.70711f / 16.0f)};
        CHECK(levels.size_at({}, turned) == 4);
        turned[0].across = turned[0].along;  // a line
        CHECK(levels.size_at({}, turned) == 16);
    }
    SECTION("as the texture is scaled")
    {
        CHECK(levels.size_at({.scale = {4.0f, 4.0f}}, footprint(2.1f, 2.1f, 16)) == 4);
        CHECK(levels.size_at({.rotation = 1.0f, .scale = {4.0f, 1.0f}},
                             footprint(3.9f, 3.9f, 16)) == 16);
    }
    SECTION("numbers that are none count as no extent")
    {
        const float bad = std::numeric_limits<float>::quiet_NaN();
        CHECK(size(bad, 10.0f) == 16);
        const float huge = std::numeric_limits<float>::infinity();
        CHECK((size(huge, huge) == 16 || size(huge, huge) == 1));
    }
}

TEST_CASE("what emits, lets light pass or bends normals is looked up as it is")
{
    const SpecularAlbedo albedo(1.5f);
    std::vector<TexelImage> images{stripes(16)};
    MipMaps maps(in_two_parts);
    const TextureImages texture_images(images, &maps);
    const UvFootprint wide = footprint(100.0f, 100.0f, 16);
    // A place in the middle of a black stripe.
    const ShadingPoint point{
        .tangent = {1, 0, 0, 1}, .uv = {Vec2(0.5f / 16.0f), Vec2(0.0f)}, .footprint = &wide};
    const auto base = [&](const MaterialDesc& desc) {
        return Material(desc, texture_images, albedo).bsdf(point).base_color().r;
    };
    MaterialDesc desc;
    desc.base_color_texture = TextureRef{};
    CHECK(Material(desc, texture_images, albedo).needs_footprint());
    CHECK_FALSE(Material(desc, images, albedo).needs_footprint());
    CHECK(base(desc) == Approx(0.5f).epsilon(0.01));
    desc.alpha_mode = AlphaMode::mask;
    CHECK(base(desc) == 0.0f);
    desc.alpha_mode = AlphaMode::opaque;
    desc.unlit = true;
    CHECK(base(desc) == 0.0f);
    CHECK_FALSE(Material(desc, texture_images, albedo).needs_footprint());

    MaterialDesc lamp;
    lamp.emission = Rgb(1.0f);
    lamp.emission_texture = TextureRef{};
    CHECK(Material(lamp, texture_images, albedo).emission({.uv = point.uv}) == Rgb(0.0f));

    MaterialDesc bumpy;
    bumpy.base_color_texture = TextureRef{};
    bumpy.normal_texture = TextureRef{};
    const Material with_copies(bumpy, texture_images, albedo);
    const Material without(bumpy, images, albedo);
    CHECK(with_copies.bsdf(point).shading_normal() == without.bsdf(point).shading_normal());
}

}  // namespace bdpt::test::mip_maps_test
