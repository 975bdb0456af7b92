#include "catch.hpp"
#include "gltf_fixture.h"
#include "image/oiio_library.h"
#include "image/png_image.h"
#include "image_fixture.h"

#include <bdpt/scene_desc.h>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>

using namespace bdpt;
using namespace bdpt::io;

namespace {

/// A triangle whose base colour is an image.
GltfFixture with_image(const nlohmann::json& image)
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["images"] = {image};
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
    CHECK((webp.channels == 3 || webp.bytes[3] == 255));
}

TEST_CASE("alpha of a WebP image does not darken its colours")
{
    const TexelImage half = load_image(half_webp());
    REQUIRE(half.channels == 4);
    CHECK(half.bytes[3] == 128);
    // OpenImageIO may have multiplied and rounded them.
    CHECK(std::abs(half.bytes[0] - 200) <= 1);
    CHECK(std::abs(half.bytes[1] - 100) <= 1);
    CHECK(std::abs(half.bytes[2] - 50) <= 1);
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
    for (const char* name : {"KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"}) {
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
        CHECK(warns(without.warnings, {"/textures/0 (", name, "no PNG, JPEG or WebP image"}));

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

TEST_CASE("PNG images are read as OpenImageIO reads them")
{
    const OiioLibrary library;
    const auto compare = [&library](const std::string& file) {
        const auto* first = reinterpret_cast<const std::uint8_t*>(file.data());
        const ByteView bytes(first, file.size());
        PngImage ours(bytes);
        const OiioImage theirs = library.open("png", bytes);
        REQUIRE(ours.width() == theirs.header().width);
        REQUIRE(ours.height() == theirs.header().height);
        REQUIRE(ours.channels() == theirs.header().channels);
        REQUIRE(ours.value_bytes() == theirs.header().value_bytes);
        Texels values(theirs.value_count() * static_cast<std::size_t>(ours.value_bytes()));
        Texels expected(values.size(), 1);
        ours.read(values.data());
        if (ours.value_bytes() == 2) {
            theirs.read(reinterpret_cast<std::uint16_t*>(expected.data()));
        } else {
            theirs.read(expected.data());
        }
        CHECK(values == expected);
    };
    struct Layout {
        int color_type;
        int channels;
        std::vector<int> depths;
        std::string transparent;  // tRNS
    };
    const std::vector<Layout> layouts{{0, 1, {1, 2, 4, 8, 16}, raw({0, 1})},
                                      {2, 3, {8, 16}, raw({0, 7, 0, 8, 0, 9})},
                                      {3, 1, {1, 2, 4, 8}, raw({255, 77})},
                                      {4, 2, {8, 16}, ""},
                                      {6, 4, {8, 16}, ""}};
    std::uint32_t noise = 1;
    for (const Layout& layout : layouts) {
        for (const int depth : layout.depths) {
            CAPTURE(layout.color_type, depth);
            constexpr int width = 16;
            std::vector<std::string> rows(2);
            for (std::string& row : rows) {
                for (int i = 0; i < width * layout.channels * depth / 8; ++i) {
                    noise = noise * 1664525u + 1013904223u;
                    row.push_back(static_cast<char>(noise >> 24u));
                }
            }
            std::string palette;
            for (int i = 0; i < 3 << depth && layout.color_type == 3; ++i) {
                palette.push_back(static_cast<char>(37 * i));
            }
            const std::string colors =
                palette.empty()
                    ? ""
                    : png_chunk("PLTE", palette) + png_chunk("gAMA", raw({0, 0, 177, 143}));
            compare(png(width, 2, depth, layout.color_type, rows, colors));
            if (!layout.transparent.empty()) {
                compare(png(width, 2, depth, layout.color_type, rows,
                            colors + png_chunk("tRNS", layout.transparent)));
            }
        }
    }
}

TEST_CASE("a broken PNG image is told of once, by its warning")
{
    std::string broken = png(2, 1, 8, 0, {raw({7, 250})});
    broken[broken.find("IDAT") + 8] ^= 1;  // pixels that their checksum does not fit
    const TempFolder folder;
    const std::string printed = (folder.path() / "printed").string();
    std::fflush(stderr);
    const int saved = ::dup(STDERR_FILENO);
    const int file = ::open(printed.c_str(), O_WRONLY | O_CREAT, 0600);
    REQUIRE(saved >= 0);
    REQUIRE(file >= 0);
    ::dup2(file, STDERR_FILENO);
    const LoadedScene loaded = with_image(data_uri(broken)).load();
    std::fflush(stderr);
    ::dup2(saved, STDERR_FILENO);
    ::close(saved);
    ::close(file);
    CHECK(std::filesystem::file_size(printed) == 0);
    REQUIRE(loaded.warnings.size() == 1);
    CHECK(warns(loaded.warnings, {"/images/0: PNG: IDAT: "}));
}

TEST_CASE("images beyond the limits are refused before they are decoded")
{
    // A header that promises 900 million pixels.
    const Error bomb = with_image(data_uri(png(30000, 30000, 8, 0, {raw({0})}))).error();
    CHECK(bomb.code() == ErrorCode::invalid_input);
    CHECK(contains(bomb.what(), "/images/0: image of 30000 x 30000 pixels"));
    const Error packed = with_image(data_uri(png(10000, 10000, 8, 2, {raw({0})}))).error();
    CHECK(packed.code() == ErrorCode::invalid_input);
    CHECK(contains(packed.what(), "more than 1000 times packed"));

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
