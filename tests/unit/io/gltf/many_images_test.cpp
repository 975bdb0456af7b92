#include "../gltf_fixture.h"
#include "../image_fixture.h"
#include "catch.hpp"

#include <bdpt/scene_desc.h>

namespace bdpt::test::many_images_test {
using namespace bdpt::io;

namespace {

/// One triangle for each image, with a material whose base colour it is.
GltfFixture with_images(const std::vector<std::string>& images)
{
    GltfFixture fixture = GltfFixture::triangle();
    const nlohmann::json primitive = fixture.json["meshes"][0]["primitives"][0];
    fixture.json["meshes"][0]["primitives"] = nlohmann::json::array();
    for (std::size_t i = 0; i < images.size(); ++i) {
        fixture.json["images"].push_back(
            {{"uri", "data:application/octet-stream;base64," + base64(images[i])}});
        fixture.json["textures"].push_back({{"source", i}});
        fixture.json["materials"].push_back(
            {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
        nlohmann::json own = primitive;
        own["material"] = i;
        fixture.json["meshes"][0]["primitives"].push_back(own);
    }
    return fixture;
}

std::string grey(int value, int side = 1)
{
    return png(side, side, 8, 0,
               std::vector<std::string>(
                   static_cast<std::size_t>(side),
                   std::string(static_cast<std::size_t>(side), static_cast<char>(value))));
}

std::vector<std::string> many()
{
    std::vector<std::string> images;
    for (int i = 0; i < 100; ++i) {
        images.push_back(grey(i, 1 + i % 7));
    }
    return images;
}

}  // namespace

TEST_CASE("images that are kept are not decoded again")
{
    const std::string encoded = grey(7, 3);
    GltfOptions options;
    options.images = std::make_shared<ImageCache>(1000);
    const auto texel = [&] {
        return with_images({encoded, grey(9)}).load(options).scene.images.at(0).bytes.at(0);
    };
    CHECK(texel() == 7);
    CHECK(options.images->bytes() == 3 * 3 + 1);
    CHECK(texel() == 7);
    CHECK(options.images->bytes() == 3 * 3 + 1);

    // What the cache has is taken: another image proves it.
    ContentHasher hasher;
    hasher.add(encoded.data(), encoded.size());
    TexelImage other{.width = 1, .height = 1, .bytes = {200}, .channels = 1};
    options.images = std::make_shared<ImageCache>(1000);
    options.images->keep(hasher.hash(), other);
    CHECK(texel() == 200);
    // There is no room for all of them, and an image that is broken is broken again.
    options.images = std::make_shared<ImageCache>(5);
    CHECK(texel() == 7);
    CHECK(options.images->bytes() == 1);
    for (int i = 0; i < 2; ++i) {
        CHECK(with_images({"GIF89a"}).load(options).warnings.size() == 1);
    }
}

TEST_CASE("images that are decoded at once keep their order, and their materials")
{
    std::vector<std::string> images = many();
    images[3] = "GIF89a";
    images[40] = images[40].substr(0, 40);
    GltfOptions options;
    options.limits.image_bytes = 1000;  // batches of a few images
    const LoadedScene loaded = with_images(images).load(options);
    REQUIRE(loaded.scene.images.size() == 98);
    REQUIRE(loaded.scene.materials.size() == 100);
    for (std::size_t i = 0; i < 100; ++i) {
        const auto& texture = loaded.scene.materials[i].base_color_texture;
        if (i == 3 || i == 40) {
            CHECK_FALSE(texture);
            continue;
        }
        REQUIRE(texture);
        const TexelImage& image = loaded.scene.images[static_cast<std::size_t>(texture->image)];
        CHECK(image.width == static_cast<int>(1 + i % 7));
        CHECK(image.bytes.at(0) == i);
    }
    CHECK(static_cast<std::size_t>(loaded.scene.materials[99].base_color_texture->image) == 97);
    // One line, with the first place, whichever was decoded first.
    CHECK(warns(loaded.warnings, {"/images/3: ", "1 more"}));
}

TEST_CASE("the error about an image is that of the first one, whichever thread is faster")
{
    std::vector<std::string> images = many();
    images[20] = png(30000, 30000, 8, 0, {raw({0})});
    images[21] = png(10000, 10000, 8, 2, {raw({0})});
    images[10] = png(20000, 20000, 8, 0, {raw({0})});
    const GltfFixture fixture = with_images(images);
    for (int i = 0; i < 5; ++i) {
        CHECK(contains(fixture.error().what(), "/images/10: image of 20000 x 20000"));
    }
}

TEST_CASE("images count against the limit for all before they are decoded")
{
    GltfOptions options;
    options.limits.texture_bytes = 3 * 49 + 5;
    const GltfFixture fits = with_images({grey(1, 7), grey(2, 7), grey(3, 7), grey(4, 2)});
    CHECK(fits.load(options).scene.images.size() == 4);
    const GltfFixture one_more =
        with_images({grey(1, 7), grey(2, 7), grey(3, 7), grey(4, 2), grey(5, 2)});
    CHECK(contains(one_more.error(options).what(),
                   "/images/4: all images together need more than 152 B"));
    // The header counts, also of what turns out to be broken.
    const GltfFixture broken =
        with_images({grey(1, 7), grey(2, 7), grey(3, 7).substr(0, 60), grey(4, 2), grey(5, 2)});
    CHECK(contains(broken.error(options).what(), "/images/4: all images together"));
}

TEST_CASE("all that a scene takes counts against one limit")
{
    // 102 bytes of images; buffers and vertices of three triangles in all, with what traces them.
    const GltfFixture fixture = with_images({grey(1, 7), grey(2, 7), grey(3, 2)});
    GltfOptions options;
    const auto fits = [&](std::uint64_t bytes) {
        options.limits.memory_bytes = bytes;
        const std::string refusal = fixture.error(options).what();
        CHECK((refusal.empty() || contains(refusal, "the limit memory_bytes")));
        return refusal;
    };
    std::uint64_t least = 1;
    std::uint64_t most = 1U << 20U;
    while (least < most) {
        const std::uint64_t middle = (least + most) / 2;
        (fits(middle).empty() ? most : least) = fits(middle).empty() ? middle : middle + 1;
    }
    // At least 150 bytes for each triangle, 12 for each corner and 1 for each texel.
    CHECK(least > 3 * (150 + 3 * 12) + 102);
    CHECK(contains(fits(least - 1), "/images/2: the image needs 4 B of memory, but 3 B of"));
    // Packed images are there while they are decoded.
    CHECK(contains(fits(least - 5), "/images/2: the packed image needs 74 B of memory, but 73 B"));
    CHECK(contains(fits(least - 100), "/images/1: the image needs 49 B"));
    CHECK(contains(fits(least - 300), "/images/0: "));
    CHECK(contains(fits(least - 500), "/nodes/0"));
    CHECK(contains(fits(20), "the file needs "));
}

TEST_CASE("loading tells of each image, one at a time, and what the callback throws is passed on")
{
    const GltfFixture fixture = with_images(many());
    GltfOptions options;
    std::size_t calls = 0;
    options.on_progress = [&](const LoadProgress& progress) {
        ++calls;
        CHECK(progress.images_done == calls);
        CHECK(progress.images_total == 100);
    };
    static_cast<void>(fixture.load(options));
    CHECK(calls == 100);
    options.on_progress = [](const LoadProgress& progress) {
        if (progress.images_done == 50) {
            throw Error(ErrorCode::usage, "enough");
        }
    };
    CHECK(contains(fixture.error(options).what(), "enough"));
    calls = 0;
    options.on_progress = [&](const LoadProgress&) { ++calls; };
    static_cast<void>(GltfFixture::triangle().load(options));
    CHECK(calls == 0);
}

TEST_CASE("a WebP image is refused by its header, before it is decoded")
{
    std::string bomb = red_webp();
    REQUIRE(bomb.substr(12, 4) == "VP8 ");
    for (const std::size_t at : {26U, 28U}) {
        bomb[at] = '\x00';
        bomb[at + 1] = '\x30';  // 12288
    }
    GltfOptions little;
    little.limits.image_bytes = 400'000'000;
    const Error error = with_images({bomb}).error(little);
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(error.what(), "12288 x 12288 pixels needs 453 MB, but the limit is 400 MB"));
}

}  // namespace bdpt::test::many_images_test
