#include "../gltf_fixture.h"
#include "../image_fixture.h"
#include "catch.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace bdpt::test::image_based_lights_test {
using namespace bdpt::io;

namespace {

using Texel = std::array<int, 4>;

/// A side whose quarters have colours of their own, from left to right and from top to bottom.
std::string quartered(const std::array<Texel, 4>& quarters, int size = 16)
{
    std::vector<std::string> rows;
    for (int y = 0; y < size; ++y) {
        std::vector<int> row;
        for (int x = 0; x < size; ++x) {
            const Texel& texel =
                quarters[static_cast<std::size_t>(2 * (2 * y / size) + 2 * x / size)];
            row.insert(row.end(), texel.begin(), texel.end());
        }
        rows.push_back(raw(row));
    }
    return png(size, size, 8, 6, rows);
}

std::string even(const Texel& texel, int size = 16)
{
    return quartered({texel, texel, texel, texel}, size);
}

/// A scene under one cube of these six images.
GltfFixture under_cube(const std::vector<std::string>& images)
{
    GltfFixture fixture = GltfFixture::triangle();
    nlohmann::json sides = nlohmann::json::array();
    for (const std::string& image : images) {
        sides.push_back(fixture.json["images"].size());
        fixture.json["images"].push_back({{"bufferView", fixture.add_view(image)}});
    }
    fixture.json["extensionsUsed"] = {"EXT_lights_image_based"};
    fixture.json["extensions"]["EXT_lights_image_based"]["lights"] = {
        {{"specularImages", {sides}}, {"specularImageSize", 16}}};
    fixture.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    return fixture;
}

nlohmann::json& light_of(GltfFixture& fixture)
{
    return fixture.json["extensions"]["EXT_lights_image_based"]["lights"][0];
}

EnvironmentLightDesc environment_of(const LoadedScene& loaded)
{
    REQUIRE(loaded.scene.lights.size() == 1);
    REQUIRE(std::holds_alternative<EnvironmentLightDesc>(loaded.scene.lights[0]));
    return std::get<EnvironmentLightDesc>(loaded.scene.lights[0]);
}

/// What is seen in a direction of the world, by the text of EnvironmentLightDesc.
Rgb seen(const EnvironmentLightDesc& light, Vec3 direction)
{
    const Vec3 d = glm::transpose(light.world_from_environment) * glm::normalize(direction);
    const Image image = light.radiance.to_image();
    const double u = 0.5 + std::atan2(d.x, -d.z) / 6.283185307179586;
    const double v = std::acos(d.y) / 3.141592653589793;
    return image.at(std::min(static_cast<int>(u * image.width), image.width - 1),
                    std::min(static_cast<int>(v * image.height), image.height - 1));
}

bool close(Rgb a, Rgb b)
{
    return glm::distance(a, b) < 1e-3f * (1.0f + glm::length(b));
}

const std::array<Vec3, 6> axes{Vec3(1, 0, 0),  Vec3(-1, 0, 0), Vec3(0, 1, 0),
                               Vec3(0, -1, 0), Vec3(0, 0, 1),  Vec3(0, 0, -1)};

/// Each a colour of its own.
std::vector<std::string> six_colors()
{
    return {even({255, 0, 0, 255}),   even({0, 255, 255, 255}), even({0, 255, 0, 255}),
            even({255, 0, 255, 255}), even({0, 0, 255, 255}),   even({255, 255, 0, 255})};
}

const std::array<Rgb, 6> colors{Rgb(1, 0, 0), Rgb(0, 1, 1), Rgb(0, 1, 0),
                                Rgb(1, 0, 1), Rgb(0, 0, 1), Rgb(1, 1, 0)};

}  // namespace

TEST_CASE("each side of a cube is seen in its direction")
{
    const LoadedScene loaded = under_cube(six_colors()).load();
    const EnvironmentLightDesc light = environment_of(loaded);
    CHECK(light.radiance.width() == 2 * light.radiance.height());
    CHECK(light.radiance.height() == 32);
    CHECK(light.world_from_environment == Mat3(1));
    for (std::size_t side = 0; side < 6; ++side) {
        CAPTURE(side);
        CHECK(close(seen(light, axes[side]), colors[side]));
        // Nearly to the edges.
        for (std::size_t other = 0; other < 6; ++other) {
            if (other / 2 != side / 2) {
                CHECK(close(seen(light, axes[side] + 0.8f * axes[other]), colors[side]));
            }
        }
    }
    CHECK(loaded.warnings.empty());
    CHECK(loaded.facts.extensions.at(0).status == ExtensionStatus::supported);
    CHECK(loaded.scene.images.empty());
}

TEST_CASE("the sides of a cube are as OpenGL has them, but flipped")
{
    // Major axis, and the coordinates s and t in units of it [OpenGL 4.6, sec. 8.13, table 8.19].
    struct Side {
        Vec3 major;
        Vec3 s;
        Vec3 t;
    };
    const std::array<Side, 6> sides{
        Side{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, Side{{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
        Side{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   Side{{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
        Side{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  Side{{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};
    const std::array<Texel, 4> quarters{Texel{255, 0, 0, 255}, Texel{0, 255, 0, 255},
                                        Texel{0, 0, 255, 255}, Texel{255, 255, 255, 255}};
    for (std::size_t side = 0; side < 6; ++side) {
        std::vector<std::string> images(6, even({0, 0, 0, 255}));
        images[side] = quartered(quarters);
        const EnvironmentLightDesc light = environment_of(under_cube(images).load());
        const auto at = [&](float s, float t) {
            return seen(light, sides[side].major + s * sides[side].s + t * sides[side].t);
        };
        CAPTURE(side);
        // Saved images are flipped about their vertical axis: left is where s is 1.
        CHECK(close(at(0.5f, -0.5f), Rgb(1, 0, 0)));
        CHECK(close(at(-0.5f, -0.5f), Rgb(0, 1, 0)));
        CHECK(close(at(0.5f, 0.5f), Rgb(0, 0, 1)));
        CHECK(close(at(-0.5f, 0.5f), Rgb(1, 1, 1)));
        // That is what one sees from inside, with right and left as they are.
        const bool lies = side == 2 || side == 3;
        const Vec3 up = lies ? Vec3(0, 0, side == 2 ? -1 : 1) : Vec3(0, 1, 0);
        const Vec3 right = glm::cross(axes[side], up);
        CHECK(close(seen(light, axes[side] + 0.5f * up - 0.5f * right), Rgb(1, 0, 0)));
        CHECK(close(seen(light, axes[side] + 0.5f * up + 0.5f * right), Rgb(0, 1, 0)));
    }
}

TEST_CASE("rotation and intensity of an environment")
{
    GltfFixture fixture = under_cube(six_colors());
    // +z turns to +x, and +x to -z.
    light_of(fixture)["rotation"] = {0, 0.70710678118654752, 0, 0.70710678118654752};
    light_of(fixture)["intensity"] = 250;
    const EnvironmentLightDesc light = environment_of(fixture.load());
    CHECK(close(seen(light, {1, 0, 0}), 250.0f * colors[4]));
    CHECK(close(seen(light, {0, 0, -1}), 250.0f * colors[0]));
    CHECK(close(seen(light, {0, 1, 0}), 250.0f * colors[2]));

    light_of(fixture)["rotation"] = {0, 3, 0, 3};
    light_of(fixture)["intensity"] = -1;
    const LoadedScene odd = fixture.load();
    CHECK(glm::distance(environment_of(odd).world_from_environment[2], Vec3(1, 0, 0)) < 1e-6f);
    CHECK(seen(environment_of(odd), {1, 0, 0}) == Rgb(0));
    CHECK(warns(odd.warnings, {"lights/0/rotation: length", "normalised"}));
    CHECK(warns(odd.warnings, {"lights/0/intensity: -1"}));
}

TEST_CASE("colours of a cube are sRGB, and alpha divides them")
{
    std::vector<std::string> images = six_colors();
    images[0] = even({188, 128, 0, 51});
    images[1] = even({188, 128, 0, 0});
    images[2] = orange_jpeg();
    images[3] = png(1, 1, 8, 2, {raw({255, 188, 0})});
    const LoadedScene loaded = under_cube(images).load();
    const EnvironmentLightDesc light = environment_of(loaded);
    CHECK(close(seen(light, {1, 0, 0}), 5.0f * Rgb(0.50289f, 0.21586f, 0.0f)));
    CHECK(close(seen(light, {-1, 0, 0}), Rgb(0)));
    CHECK(glm::distance(seen(light, {0, 1, 0}), Rgb(1.0f, 0.21f, 0.0f)) < 0.02f);
    CHECK(close(seen(light, {0, -1, 0}), Rgb(1.0f, 0.50289f, 0.0f)));
    CHECK(warns(loaded.warnings, {"specularImages/0/1", "alpha is 0"}));
    CHECK(warns(loaded.warnings, {"specularImages/0/2: 8 x 8 pixels", "of one size"}));
}

TEST_CASE("light of single texels is neither lost nor made")
{
    // In the middle, at an edge and in a corner of a side, where their solid angles differ.
    for (const auto& [column, line] : {std::pair(8, 7), {0, 8}, {15, 0}}) {
        std::vector<std::string> rows;
        for (int y = 0; y < 16; ++y) {
            std::vector<int> row;
            for (int x = 0; x < 16; ++x) {
                const int value = x == column && y == line ? 255 : 0;
                row.insert(row.end(), {value, value, value, 255});
            }
            rows.push_back(raw(row));
        }
        for (const std::size_t side : {0U, 3U}) {
            std::vector<std::string> images(6, even({0, 0, 0, 255}));
            images[side] = png(16, 16, 8, 6, rows);
            const Image image = environment_of(under_cube(images).load()).radiance.to_image();
            double sum = 0.0;
            for (int y = 0; y < image.height; ++y) {
                const double zone = std::cos(3.141592653589793 * y / image.height) -
                                    std::cos(3.141592653589793 * (y + 1) / image.height);
                for (int x = 0; x < image.width; ++x) {
                    sum += zone * 6.283185307179586 / image.width *
                           static_cast<double>(image.at(x, y).g);
                }
            }
            // Of the bilinear texel, which is held at the border of the side.
            double expected = 0.0;
            constexpr int fine = 640;
            for (int j = 0; j < fine; ++j) {
                for (int i = 0; i < fine; ++i) {
                    const auto part = [](int k, int texel) {
                        const double x = std::min(15.0, std::max(0.0, (k + 0.5) * 16 / fine - 0.5));
                        return std::max(0.0, 1.0 - std::abs(x - texel));
                    };
                    const double a = 2 * (i + 0.5) / fine - 1;
                    const double b = 2 * (j + 0.5) / fine - 1;
                    expected += part(i, column) * part(j, line) * 4 / (fine * fine) /
                                std::pow(1 + a * a + b * b, 1.5);
                }
            }
            CAPTURE(column, line, side);
            CHECK(sum == Approx(expected).epsilon(0.03));
        }
    }
}

TEST_CASE("only the scene that refers to an environment has it")
{
    GltfFixture fixture = under_cube(six_colors());
    fixture.json["scenes"].push_back({{"nodes", {0}}});
    CHECK(fixture.load().scene.lights.size() == 1);
    GltfOptions second;
    second.scene = "1";
    CHECK(fixture.load(second).scene.lights.empty());
}

TEST_CASE("large cubes become images within the limits")
{
    GltfFixture fixture = under_cube(six_colors());
    GltfOptions options;
    options.limits.image_side = 24;
    const LoadedScene loaded = fixture.load(options);
    CHECK(environment_of(loaded).radiance.width() == 24);
    CHECK(warns(loaded.warnings, {"lights/0: 64 x 32 pixels", "loses detail"}));

    // Stripes of one texel become even, wherever they are looked up.
    std::vector<std::string> rows;
    for (int y = 0; y < 16; ++y) {
        rows.push_back(raw(std::vector<int>(16, y % 2 == 0 ? 255 : 0)));
    }
    options.limits.image_side = 16;
    const GltfFixture striped = under_cube(std::vector<std::string>(6, png(16, 16, 8, 0, rows)));
    const Image image = environment_of(striped.load(options)).radiance.to_image();
    for (const Rgb& pixel : image.pixels) {
        CHECK(pixel.g == Approx(0.5).epsilon(0.01));
    }
    options.limits = {};
    options.limits.texture_bytes = 10000;
    CHECK(contains(fixture.error(options).what(),
                   "/specularImages/0/3: all sides together need more than 10 kB"));
}

TEST_CASE("a cube that cannot be read leaves the scene without environment")
{
    GltfFixture broken = under_cube(six_colors());
    broken.json["images"][4] = {{"bufferView", broken.add_view("no image")}};
    const LoadedScene loaded = broken.load();
    CHECK(loaded.scene.lights.empty());
    CHECK(warns(loaded.warnings, {"/extensions/EXT_lights_image_based/lights/0/specularImages/0/4",
                                  "neither PNG", "the environment is left out"}));
    broken.json["images"][4] = {{"uri", "none.png"}};
    CHECK(warns(broken.load().warnings, {"specularImages/0/4: \"none.png\": no such file"}));
}

TEST_CASE("environments that are wrong are refused")
{
    const auto message = [](const nlohmann::json& change) {
        GltfFixture fixture = under_cube(six_colors());
        fixture.json.merge_patch(change);
        const Error error = fixture.error();
        CHECK(error.code() == ErrorCode::invalid_input);
        return std::string(error.what());
    };
    const auto light = [&message](const nlohmann::json& change) {
        nlohmann::json changed{{"specularImages", {{0, 1, 2, 3, 4, 5}}}};
        changed.update(change);
        return message(
            {{"extensions",
              {{"EXT_lights_image_based", {{"lights", nlohmann::json::array({changed})}}}}}});
    };
    CHECK(contains(light({{"specularImages", {{0, 1, 2, 3, 4}}}}),
                   "lights/0/specularImages: a cube of 5 sides"));
    CHECK(contains(light({{"specularImages", nlohmann::json::array()}}), "a cube of 0 sides"));
    CHECK(contains(light({{"specularImages", {nlohmann::json::array(), {0, 1, 2, 3, 4, 5}}}}),
                   "a cube of 0 sides"));
    CHECK(contains(light({{"specularImages", {{0, 1, 2, 3, 4, 6}}}}),
                   "specularImages/0/5: index 6, but the number of images is 6"));
    CHECK(contains(light({{"rotation", {0, 0, 1}}}), "rotation: must be 4 numbers"));
    CHECK(contains(light({{"intensity", "much"}}), "intensity: must be a number"));
    CHECK(contains(message({{"extensions", nullptr}}),
                   "/scenes/0/extensions/EXT_lights_image_based/light: index 0, but the number of "
                   "lights is 0"));
    CHECK(contains(
        message({{"scenes", {{{"nodes", {0}}, {"extensions", {{"EXT_lights_image_based", 3}}}}}}}),
        "EXT_lights_image_based: must be an object"));
}

}  // namespace bdpt::test::image_based_lights_test
