#include "catch.hpp"
#include "texture/texture.h"

#include <glm/gtc/packing.hpp>

#include <cmath>
#include <cstring>

namespace bdpt::test::texel_types_test {
namespace {

template <typename Value>
std::vector<std::uint8_t> bytes_of(const std::vector<Value>& values)
{
    std::vector<std::uint8_t> bytes(values.size() * sizeof(Value));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

/// One texel.
TexelImage texel(TexelType type, int channels, std::vector<std::uint8_t> bytes)
{
    return {.width = 1, .height = 1, .bytes = std::move(bytes), .channels = channels, .type = type};
}

Vec4 look(const TexelImage& image, Encoding encoding)
{
    return Texture({}, image, encoding).lookup({Vec2(0.3f), Vec2(0.0f)});
}

void check(Vec4 value, Vec4 expected)
{
    for (int c = 0; c < 4; ++c) {
        CHECK(value[c] == Approx(expected[c]).epsilon(1e-6));
    }
}

float srgb(double encoded)
{
    return static_cast<float>(std::pow((encoded + 0.055) / 1.055, 2.4));
}

}  // namespace

TEST_CASE("images of one to four channels are grey, with alpha, colours, with alpha")
{
    check(look(texel(TexelType::unorm8, 1, {51}), Encoding::linear), {0.2f, 0.2f, 0.2f, 1.0f});
    check(look(texel(TexelType::unorm8, 2, {51, 102}), Encoding::linear), {0.2f, 0.2f, 0.2f, 0.4f});
    check(look(texel(TexelType::unorm8, 3, {51, 102, 153}), Encoding::linear),
          {0.2f, 0.4f, 0.6f, 1.0f});
    check(look(texel(TexelType::unorm8, 4, {51, 102, 153, 204}), Encoding::linear),
          {0.2f, 0.4f, 0.6f, 0.8f});
    // Alpha is linear, colours may not be.
    check(look(texel(TexelType::unorm8, 2, {51, 102}), Encoding::srgb),
          {srgb(0.2), srgb(0.2), srgb(0.2), 0.4f});
}

TEST_CASE("integers of 16 bits keep their precision")
{
    const auto words = [](const std::vector<std::uint16_t>& values) {
        return texel(TexelType::unorm16, static_cast<int>(values.size()), bytes_of(values));
    };
    check(look(words({1, 2, 65535, 32768}), Encoding::linear),
          {1.0f / 65535.0f, 2.0f / 65535.0f, 1.0f, 32768.0f / 65535.0f});
    check(look(words({30000, 50000, 65535, 257}), Encoding::srgb),
          {srgb(30000 / 65535.0), srgb(50000 / 65535.0), 1.0f, 257.0f / 65535.0f});
    // 8 bits are every 257th of them.
    for (const int value : {0, 1, 10, 11, 100, 255}) {
        const auto word = static_cast<std::uint16_t>(257 * value);
        const auto byte = static_cast<std::uint8_t>(value);
        check(look(words({word}), Encoding::srgb),
              look(texel(TexelType::unorm8, 1, {byte}), Encoding::srgb));
    }
}

TEST_CASE("halves and floats are linear, and above 1 in emission only")
{
    const std::vector<float> values{0.25f, 3.5f, 0.0f, 1.5f};
    std::vector<std::uint16_t> halves;
    for (const float value : values) {
        halves.push_back(glm::packHalf1x16(value));
    }
    for (const TexelImage& image : {texel(TexelType::half, 4, bytes_of(halves)),
                                    texel(TexelType::float32, 4, bytes_of(values))}) {
        check(look(image, Encoding::srgb), {0.25f, 1.0f, 0.0f, 1.0f});
        check(look(image, Encoding::linear), {0.25f, 1.0f, 0.0f, 1.0f});
        check(look(image, Encoding::radiance), {0.25f, 3.5f, 0.0f, 1.0f});
    }
    check(look(texel(TexelType::half, 1, bytes_of<std::uint16_t>({0x0001})), Encoding::linear),
          {0x1p-24f, 0x1p-24f, 0x1p-24f, 1.0f});  // the least half there is
}

TEST_CASE("texels of all types are mixed bilinearly and averaged")
{
    const TexelImage words{.width = 2,
                           .height = 1,
                           .bytes = bytes_of<std::uint16_t>({0, 65535, 65535, 13107}),
                           .channels = 2,
                           .type = TexelType::unorm16};
    const Texture texture({.wrap_u = Wrap::clamp_to_edge}, words, Encoding::linear);
    const Vec4 between = texture.lookup({Vec2(0.375f, 0.5f), Vec2(0.0f)});
    CHECK(between.x == Approx(0.25f));
    CHECK(between.w == Approx(0.8f));
    CHECK(texture.mean().x == Approx(0.5f));
    CHECK(texture.mean().w == Approx(0.6f));
    CHECK(texture.alpha_range() == std::pair(0.2f, 1.0f));
}

}  // namespace bdpt::test::texel_types_test
