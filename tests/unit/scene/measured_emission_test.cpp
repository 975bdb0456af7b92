// What emissive triangles are measured to emit.

#include "catch.hpp"
#include "math/rgb.h"
#include "scene/world.h"
#include "scene_builder.h"
#include "statistics.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace bdpt::measured_emission_test {
namespace {

/// Smooth in its upper half, noise in its lower one, with alpha that falls to the right.
TexelImage painted(int size)
{
    test::Random random(7);
    TexelImage image{.width = size, .height = size, .bytes = {}};
    const auto byte = [](float value) { return static_cast<std::uint8_t>(255.0f * value); };
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const float along = static_cast<float>(x) / static_cast<float>(size);
            const float value = y < size / 2 ? along : random.next();
            image.bytes.insert(image.bytes.end(), {byte(value), byte(0.5f * value), byte(1 - along),
                                                   byte(1.0f - 0.8f * along)});
        }
    }
    return image;
}

/// `count` squares in one mesh, each of which shows the whole image, as what emits.
SceneDesc screens(int size, int count)
{
    test::SceneBuilder builder;
    builder.desc.images.push_back(painted(size));
    MaterialDesc material = test::emitter(Rgb(3.0f, 2.0f, 1.0f));
    material.emission_texture = TextureRef{.image = ImageId{0}};
    material.base_color_texture = TextureRef{.image = ImageId{0}};
    material.alpha_mode = AlphaMode::blend;
    MeshDesc mesh;
    for (int i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(4 * i);
        const auto x = static_cast<float>(3 * i);
        mesh.positions.insert(mesh.positions.end(),
                              {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 2, 0}, {x, 2, 0}});
        mesh.uvs[0].insert(mesh.uvs[0].end(), {{0, 1}, {1, 1}, {1, 0}, {0, 0}});
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first, first + 2, first + 3});
    }
    builder.place(builder.add_mesh(std::move(mesh)), material, Mat4(1.0f));
    return std::move(builder.desc);
}

float linear(std::uint8_t byte)
{
    const float v = static_cast<float>(byte) / 255.0f;
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

/// What the square emits at this place of its image, the share that meets it counted: bilinear
/// between texels, which repeat.
Rgb emitted(const TexelImage& image, Vec2 uv)
{
    const Vec2 at = uv * static_cast<float>(image.width) - 0.5f;
    const Vec2 corner(std::floor(at.x), std::floor(at.y));
    Rgb color(0.0f);
    float alpha = 0.0f;
    for (int k = 0; k < 4; ++k) {
        const int dx = k % 2;
        const int dy = k / 2;
        const Vec2 part = at - corner;
        const float weight =
            (dx == 1 ? part.x : 1.0f - part.x) * (dy == 1 ? part.y : 1.0f - part.y);
        const int x = (static_cast<int>(corner.x) + dx + image.width) % image.width;
        const int y = (static_cast<int>(corner.y) + dy + image.height) % image.height;
        const auto texel = static_cast<std::size_t>(4 * (y * image.width + x));
        const auto& bytes = image.bytes;
        color +=
            weight * Rgb(linear(bytes[texel]), linear(bytes[texel + 1]), linear(bytes[texel + 2]));
        alpha += weight * static_cast<float>(bytes[texel + 3]) / 255.0f;
    }
    return color * Rgb(3.0f, 2.0f, 1.0f) * alpha;
}

/// The mean of that over the lower right (0) or the upper left triangle.
Rgb brute_mean(const TexelImage& image, int triangle)
{
    constexpr int side = 1000;
    Rgb sum(0.0f);
    int count = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const Vec2 uv((static_cast<float>(x) + 0.5f) / side,
                          (static_cast<float>(y) + 0.5f) / side);
            if ((uv.x > 1.0f - uv.y) == (triangle == 0)) {
                sum += emitted(image, uv);
                ++count;
            }
        }
    }
    return sum / static_cast<float>(count);
}

}  // namespace

TEST_CASE("measured emission: powers are those of the textures, summed by brute force", "[light]")
{
    constexpr float area = 1.0f;  // of a triangle
    for (const int size : {16, 300}) {
        const std::array<Rgb, 2> expected{brute_mean(painted(size), 0),
                                          brute_mean(painted(size), 1)};
        REQUIRE(expected[1].b > 1.2f * expected[0].b);
        // With more triangles each is measured by fewer samples.
        for (const int count : {1, 3000}) {
            const World world(screens(size, count));
            REQUIRE(world.lights().size() == static_cast<std::size_t>(2 * count));
            for (std::uint32_t id = 0; id < 2; ++id) {
                const Rgb mean = world.lights()[LightId{id}].power() / (pi * area);
                CAPTURE(size, count, id, mean.r, expected[id].r, mean.b, expected[id].b);
                const double tolerance = count == 1 ? 0.015 : 0.12;
                CHECK(mean.r == Approx(expected[id].r).epsilon(tolerance));
                CHECK(mean.g == Approx(expected[id].g).epsilon(tolerance));
                CHECK(mean.b == Approx(expected[id].b).epsilon(tolerance));
            }
        }
    }
}

}  // namespace bdpt::measured_emission_test
