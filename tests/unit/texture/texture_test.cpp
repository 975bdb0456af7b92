#include "texture/texture.h"

#include "catch.hpp"

#include <cmath>
#include <limits>

namespace bdpt::test::texture_test {
namespace {

/// 4 x 2 texels, all different: red counts columns, green rows.
TexelImage counting_image()
{
    TexelImage image{4, 2, {}};
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 4; ++x) {
            image.bytes.insert(image.bytes.end(), {static_cast<std::uint8_t>(51 * x),
                                                   static_cast<std::uint8_t>(255 * y), 100,
                                                   static_cast<std::uint8_t>(10 * (x + 1))});
        }
    }
    return image;
}

Vec4 look(const Texture& texture, float u, float v)
{
    return texture.lookup({Vec2{u, v}, Vec2{0.0f}});
}

/// The column of the counting image, 0 to 3, at texel centres.
float column(const Texture& texture, float u)
{
    return look(texture, u, 0.25f).x * 5.0f;
}

TextureRef wrapped(Wrap wrap)
{
    return {.wrap_u = wrap, .wrap_v = wrap};
}

}  // namespace

TEST_CASE("texels stand at their centres and v grows downwards")
{
    const TexelImage image = counting_image();
    const Texture texture(wrapped(Wrap::clamp_to_edge), image, Encoding::linear);
    for (int x = 0; x < 4; ++x) {
        CHECK(column(texture, (static_cast<float>(x) + 0.5f) / 4.0f) == Approx(x).margin(1e-6));
    }
    CHECK(look(texture, 0.5f, 0.25f).y == Approx(0.0f).margin(1e-6));
    CHECK(look(texture, 0.5f, 0.75f).y == Approx(1.0f));
}

TEST_CASE("lookups between texels are bilinear")
{
    const TexelImage image = counting_image();
    const Texture texture(wrapped(Wrap::clamp_to_edge), image, Encoding::linear);
    CHECK(column(texture, 0.25f) == Approx(0.5f));
    CHECK(column(texture, 0.3125f) == Approx(0.75f));
    const Vec4 middle = look(texture, 0.5f, 0.4f);
    CHECK(middle.x == Approx(1.5f / 5.0f));
    CHECK(middle.y == Approx(0.3f));
    CHECK(middle.z == Approx(100.0f / 255.0f));
    CHECK(middle.w == Approx(25.0f / 255.0f));
}

TEST_CASE("wrap modes repeat, mirror and clamp")
{
    const TexelImage image = counting_image();
    SECTION("repeat")
    {
        const Texture texture(wrapped(Wrap::repeat), image, Encoding::linear);
        CHECK(column(texture, 1.125f) == Approx(0.0f).margin(1e-5));
        CHECK(column(texture, -0.125f) == Approx(3.0f));
        CHECK(column(texture, -2.375f) == Approx(2.0f));
        CHECK(column(texture, 0.0f) == Approx(1.5f));  // between the last and the first
        CHECK(column(texture, 1.0f) == Approx(1.5f));
        CHECK(column(texture, -1e-9f) == Approx(1.5f));
    }
    SECTION("mirrored repeat")
    {
        const Texture texture(wrapped(Wrap::mirrored_repeat), image, Encoding::linear);
        CHECK(column(texture, 1.125f) == Approx(3.0f));
        CHECK(column(texture, 1.875f) == Approx(0.0f).margin(1e-5));
        CHECK(column(texture, 2.375f) == Approx(1.0f));
        CHECK(column(texture, -0.375f) == Approx(1.0f));
        CHECK(column(texture, 1.0f) == Approx(3.0f));
        CHECK(column(texture, 0.0f) == Approx(0.0f).margin(1e-6));
    }
    SECTION("clamp to edge")
    {
        const Texture texture(wrapped(Wrap::clamp_to_edge), image, Encoding::linear);
        CHECK(column(texture, 7.0f) == Approx(3.0f));
        CHECK(column(texture, -7.0f) == Approx(0.0f).margin(1e-6));
        CHECK(column(texture, 1.0f) == Approx(3.0f));
    }
    SECTION("each axis has its own")
    {
        const TextureRef ref{.wrap_u = Wrap::clamp_to_edge, .wrap_v = Wrap::mirrored_repeat};
        const Texture texture(ref, image, Encoding::linear);
        CHECK(look(texture, 7.0f, 1.25f).y == Approx(1.0f));
        CHECK(look(texture, 7.0f, 1.25f).x == Approx(0.6f));
    }
}

TEST_CASE("sRGB is decoded before texels are mixed, and alpha never")
{
    const TexelImage image{2, 1, {0, 10, 188, 0, 255, 10, 188, 255}};
    const Texture texture(wrapped(Wrap::clamp_to_edge), image, Encoding::srgb);
    const Vec4 between = look(texture, 0.5f, 0.5f);
    CHECK(between.x == Approx(0.5f));  // 0.214 if mixed before
    CHECK(between.y == Approx(10.0 / 255.0 / 12.92).epsilon(1e-6));
    CHECK(between.z == Approx(std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4)).epsilon(1e-6));
    CHECK(between.w == Approx(0.5f));
    CHECK(look(texture, 0.0f, 0.5f).x == 0.0f);
    CHECK(look(texture, 1.0f, 0.5f).x == 1.0f);
}

TEST_CASE("the sRGB table is the standard's curve")
{
    for (int i = 0; i < 256; ++i) {
        const auto value = static_cast<std::uint8_t>(i);
        const TexelImage image{1, 1, {value, value, value, value}};
        const Vec4 texel = look(Texture({}, image, Encoding::srgb), 0.3f, 0.8f);
        const double c = i / 255.0;
        const double exact = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        CHECK(texel.x == Approx(exact).epsilon(1e-6));
        CHECK(texel.w == Approx(c).epsilon(1e-6));
    }
}

TEST_CASE("KHR_texture_transform scales, turns and shifts, in that order")
{
    // An image without bound, so to say: coordinates are read off a large ramp.
    constexpr int size = 256;
    TexelImage image{size, size, {}};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            image.bytes.insert(image.bytes.end(), {static_cast<std::uint8_t>(x),
                                                   static_cast<std::uint8_t>(y), 0, 255});
        }
    }
    const auto where = [&](const TextureRef& ref, float u, float v) {
        const Vec4 texel = look(Texture(ref, image, Encoding::linear), u, v);
        return Vec2{(texel.x * 255.0f + 0.5f) / size, (texel.y * 255.0f + 0.5f) / size};
    };
    SECTION("the specification's example: the lower left quadrant, turned")
    {
        const TextureRef ref{
            .offset = {0.0f, 1.0f}, .rotation = 1.57079632679f, .scale = {0.5f, 0.5f}};
        const Vec2 a = where(ref, 0.5f, 0.5f);
        CHECK(a.x == Approx(0.25f).margin(1e-3));
        CHECK(a.y == Approx(0.75f).margin(1e-3));
        const Vec2 b = where(ref, 0.9f, 0.2f);
        CHECK(b.x == Approx(0.1f).margin(1e-3));
        CHECK(b.y == Approx(0.55f).margin(1e-3));
    }
    SECTION("counter-clockwise as seen on the image")
    {
        // The arrow of Khronos's TextureTransformTest ends at (0.68, 0.68); turned by 22.5 degrees,
        // its tip shows where the quad's own coordinates are (0.368, 0.888).
        const Vec2 tip = where({.rotation = 0.392699f}, 0.368f, 0.888f);
        CHECK(tip.x == Approx(0.68f).margin(2e-3));
        CHECK(tip.y == Approx(0.68f).margin(2e-3));
    }
    SECTION("unequal scales come before the turn, the offset last")
    {
        const TextureRef ref{.offset = {0.1f, 0.3f}, .rotation = 0.5f, .scale = {0.4f, 0.8f}};
        const Vec2 p = where(ref, 0.5f, 0.5f);
        CHECK(p.x == Approx(0.1 + std::cos(0.5) * 0.2 + std::sin(0.5) * 0.4).margin(1e-3));
        CHECK(p.y == Approx(0.3 - std::sin(0.5) * 0.2 + std::cos(0.5) * 0.4).margin(1e-3));
    }
}

TEST_CASE("the second set of coordinates is used where it is asked for")
{
    const TexelImage image = counting_image();
    const Texture texture({.uv_set = 1, .wrap_u = Wrap::clamp_to_edge}, image, Encoding::linear);
    CHECK(texture.lookup({Vec2{0.125f, 0.25f}, Vec2{0.875f, 0.25f}}).x == Approx(0.6f));
}

TEST_CASE("bad coordinates give a texel")
{
    const TexelImage image = counting_image();
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
        const Texture texture(wrapped(wrap), image, Encoding::linear);
        for (const float bad :
             {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
              -std::numeric_limits<float>::max(), 1e10f, -4194303.5f, 4194303.5f}) {
            for (const Vec4 value : {look(texture, bad, 0.5f), look(texture, 0.5f, bad)}) {
                CHECK((value.x >= 0.0f && value.x <= 0.6001f));
                CHECK((value.y >= 0.0f && value.y <= 1.0f));
            }
        }
    }
}

TEST_CASE("the mean of a texture is that of its decoded texels")
{
    const TexelImage image{2, 1, {0, 51, 0, 0, 255, 102, 255, 255}};
    const Vec4 linear = Texture({}, image, Encoding::linear).mean();
    CHECK(linear.y == Approx(0.3f));
    const Vec4 srgb = Texture({}, image, Encoding::srgb).mean();
    CHECK(srgb.x == Approx(0.5f));
    CHECK(srgb.y == Approx(0.5 * (std::pow((0.2 + 0.055) / 1.055, 2.4) +
                                  std::pow((0.4 + 0.055) / 1.055, 2.4))));
    CHECK(srgb.w == Approx(0.5f));
}

}  // namespace bdpt::test::texture_test
