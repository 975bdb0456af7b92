#include "../gltf_fixture.h"
#include "../image_fixture.h"
#include "catch.hpp"

#include <bdpt/scene_desc.h>

#include <array>
#include <cstdlib>
#include <cstring>

namespace bdpt::test::gltf_images_test {
using namespace bdpt::io;

namespace {

/// A triangle whose base colour is an image.
GltfFixture with_image(const nlohmann::json& image)
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["images"] = nlohmann::json::array({image});
    fixture.json["textures"] = {{{"source", 0}}};
    fixture.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    fixture.json["meshes"][0]["primitives"][0]["material"] = 0;
    return fixture;
}

nlohmann::json data_uri(const std::string& bytes)
{
    return {{"uri", "data:application/octet-stream;base64," + base64(bytes)}};
}

TexelImage load_image(const std::string& bytes)
{
    const LoadedScene loaded = with_image(data_uri(bytes)).load();
    CHECK(loaded.warnings.empty());
    REQUIRE(loaded.scene.images.size() == 1);
    return loaded.scene.images[0];
}

using Texels = std::vector<std::uint8_t>;

}  // namespace

TEST_CASE("PNG images of all kinds keep their channels and bits, as they are stored")
{
    const TexelImage rgb =
        load_image(png(2, 2, 8, 2, {raw({255, 0, 0, 0, 255, 0}), raw({0, 0, 255, 10, 20, 30})}));
    CHECK(rgb.width == 2);
    CHECK(rgb.height == 2);
    CHECK(rgb.channels == 3);
    CHECK(rgb.type == TexelType::unorm8);
    CHECK(rgb.bytes == Texels{255, 0, 0, 0, 255, 0, 0, 0, 255, 10, 20, 30});
    // Alpha is not multiplied in, not even zero.
    const TexelImage rgba = load_image(png(2, 1, 8, 6, {raw({200, 100, 50, 128, 1, 2, 3, 0})}));
    CHECK(rgba.channels == 4);
    CHECK(rgba.bytes == Texels{200, 100, 50, 128, 1, 2, 3, 0});
    const TexelImage grey = load_image(png(2, 1, 8, 0, {raw({7, 250})}));
    CHECK(grey.channels == 1);
    CHECK(grey.bytes == Texels{7, 250});
    const TexelImage grey_alpha = load_image(png(2, 1, 8, 4, {raw({7, 99, 250, 3})}));
    CHECK(grey_alpha.channels == 2);
    CHECK(grey_alpha.bytes == Texels{7, 99, 250, 3});
    const TexelImage bits = load_image(png(8, 1, 1, 0, {raw({0x53})}));
    CHECK(bits.bytes == Texels{0, 255, 0, 255, 0, 0, 255, 255});
    const TexelImage wide = load_image(png(1, 1, 16, 2, {raw({255, 255, 0x64, 0xC0, 7, 7})}));
    CHECK(wide.channels == 3);
    REQUIRE(wide.type == TexelType::unorm16);
    std::array<std::uint16_t, 3> words{};
    REQUIRE(wide.bytes.size() == sizeof words);
    std::memcpy(words.data(), wide.bytes.data(), sizeof words);
    CHECK(words == std::array<std::uint16_t, 3>{0xffff, 0x64c0, 0x0707});
    const std::string palette =
        png_chunk("PLTE", raw({10, 20, 30, 40, 50, 60})) + png_chunk("tRNS", raw({255, 77}));
    CHECK(load_image(png(2, 1, 8, 3, {raw({1, 0})}, palette)).bytes ==
          Texels{40, 50, 60, 77, 10, 20, 30, 255});
    // A gamma of 1 says how to show the image, not what its values are.
    CHECK(load_image(png(1, 1, 8, 0, {raw({100})}, png_chunk("gAMA", raw({0, 1, 0x86, 0xA0}))))
              .bytes == Texels{100});
}

TEST_CASE("JPEG and WebP images are read")
{
    const TexelImage jpeg = load_image(orange_jpeg());
    REQUIRE(jpeg.width == 8);
    REQUIRE(jpeg.height == 8);
    CHECK(jpeg.bytes[0] > 250);
    CHECK(std::abs(jpeg.bytes[1] - 128) < 4);
    CHECK(jpeg.bytes[2] < 5);
    CHECK(jpeg.channels == 3);
    const TexelImage webp = load_image(red_webp());
    REQUIRE(webp.width == 2);
    REQUIRE(webp.height == 2);
    CHECK(webp.bytes[0] > 240);
    CHECK(webp.bytes[1] < 15);
    CHECK(webp.channels == 3);
}

TEST_CASE("alpha of a WebP image does not darken its colours")
{
    const TexelImage half = load_image(half_webp());
    REQUIRE(half.channels == 4);
    CHECK(half.bytes == Texels{200, 100, 50, 128});
}

TEST_CASE("the WebP image of a texture comes before its fallback")
{
    GltfFixture fixture = with_image(data_uri(png(1, 1, 8, 0, {raw({1})})));
    fixture.json["images"].push_back(data_uri(red_webp()));
    fixture.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    CHECK(fixture.load().scene.images.at(0).width == 2);
    fixture.json["textures"][0].erase("source");
    CHECK(fixture.load().scene.images.at(0).width == 2);
}

TEST_CASE(
    "of images that no library here decodes the other one is taken, or the texture is left out")
{
    for (const char* name : {"EXT_texture_avif", "MSFT_texture_dds"}) {
        CAPTURE(name);
        GltfFixture fixture = with_image(data_uri(png(1, 1, 8, 0, {raw({1})})));
        fixture.json["images"].push_back(data_uri("\xabKTX 20\xbb"));
        fixture.json["extensionsUsed"] = {name};
        fixture.json["textures"][0]["extensions"][name]["source"] = 1;
        const LoadedScene other = fixture.load();
        CHECK(other.scene.images.size() == 1);
        CHECK(warns(other.warnings, {"/extensionsUsed/0: ", name, "fallback"}));

        fixture.json["textures"][0].erase("source");
        const LoadedScene without = fixture.load();
        CHECK(without.scene.images.empty());
        CHECK_FALSE(without.scene.materials.at(0).base_color_texture);
        CHECK(warns(without.warnings, {"/textures/0 (", name, "no PNG, JPEG, WebP or KTX2 image"}));

        fixture.json["extensionsRequired"] = {name};
        const Error error = fixture.error();
        CHECK(error.code() == ErrorCode::unsupported);
        CHECK(contains(error.what(), name));
    }
}

TEST_CASE("where the better image of a texture is broken, the other one is taken")
{
    GltfFixture fixture = with_image(data_uri(png(1, 1, 8, 0, {raw({1})})));
    fixture.json["images"].push_back(data_uri(red_webp().substr(0, 35)));
    fixture.json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    const LoadedScene loaded = fixture.load();
    REQUIRE(loaded.scene.images.size() == 1);
    CHECK(loaded.scene.images[0].width == 1);
    CHECK(loaded.scene.materials.at(0).base_color_texture->image == ImageId{0});
    CHECK(warns(loaded.warnings, {"/images/1: "}));
}

TEST_CASE("images come from files and from buffer views too")
{
    const std::string image = png(1, 1, 8, 2, {raw({1, 2, 3})});
    const TempFolder folder;
    folder.write("maps/a picture.png", image);
    const auto file =
        folder.write("scene.gltf", with_image({{"uri", "maps/a%20picture.png"}}).text());
    CHECK(load_gltf(file).scene.images.at(0).bytes == Texels{1, 2, 3});

    GltfFixture fixture = with_image({{"mimeType", "image/png"}});
    fixture.json["images"][0]["bufferView"] = fixture.add_view(image);
    CHECK(fixture.load().scene.images.at(0).bytes == Texels{1, 2, 3});
    const auto binary = folder.write("scene.glb", fixture.glb());
    CHECK(load_gltf(binary).scene.images.at(0).bytes == Texels{1, 2, 3});
}

TEST_CASE("an image that cannot be read costs a warning, not the scene")
{
    const auto warning_of = [](const nlohmann::json& image) {
        const LoadedScene loaded = with_image(image).load();
        CHECK(loaded.scene.images.empty());
        CHECK_FALSE(loaded.scene.materials.at(0).base_color_texture);
        CHECK(loaded.scene.instances.size() == 1);
        REQUIRE(loaded.warnings.size() == 1);
        CHECK(contains(loaded.warnings[0], "/images/0: "));
        return loaded.warnings[0];
    };
    const std::string image = png(2, 2, 8, 2, {raw({1, 2, 3, 4, 5, 6}), raw({1, 2, 3, 4, 5, 6})});
    static_cast<void>(warning_of(data_uri(image.substr(0, 50))));
    static_cast<void>(warning_of(data_uri(orange_jpeg().substr(0, 30))));
    CHECK(contains(warning_of(data_uri("GIF89a")), "neither PNG"));
    CHECK(contains(warning_of(data_uri("\xabKTX 20\xbb")), "KTX"));
    CHECK(contains(warning_of(data_uri("")), "neither PNG"));
    CHECK(contains(warning_of({{"uri", "missing.png"}}), "\"missing.png\": no such file"));
    CHECK(contains(warning_of(nlohmann::json::object()), "neither \"uri\""));
}

TEST_CASE("images beyond the limits are refused before they are decoded")
{
    // A header that promises 900 million pixels.
    const Error bomb = with_image(data_uri(png(30000, 30000, 8, 0, {raw({0})}))).error();
    CHECK(bomb.code() == ErrorCode::invalid_input);
    CHECK(contains(bomb.what(), "/images/0: image of 30000 x 30000 pixels"));

    GltfFixture fixture = with_image(data_uri(png(2, 1, 8, 0, {raw({7, 250})})));
    GltfOptions options;
    options.limits.image_side = 1;
    CHECK(contains(fixture.error(options).what(), "2 x 1 pixels, but the limit is 1 a side"));
    options = {};
    options.limits.image_bytes = 1;
    CHECK(contains(fixture.error(options).what(), "needs 2 B, but the limit is 1 B"));
    options = {};
    options.limits.texture_bytes = 1;
    CHECK(contains(fixture.error(options).what(), "all images together need more than 1 B"));
}

}  // namespace bdpt::test::gltf_images_test
