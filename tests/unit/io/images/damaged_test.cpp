#include "../gltf_fixture.h"
#include "../image_fixture.h"
#include "catch.hpp"
#include "encoders.h"
#include "image/encoded_image.h"

#include <bdpt/error.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <stdexcept>

namespace bdpt::test::damaged_test {
using namespace bdpt::io;

namespace {

/// What a function and the libraries below it write to stderr [bytes].
std::uintmax_t printed_by(const std::function<void()>& work)
{
    const TempFolder folder;
    const std::string printed = (folder.path() / "printed").string();
    std::fflush(stderr);
    const int saved = ::dup(STDERR_FILENO);
    const int file = ::open(printed.c_str(), O_WRONLY | O_CREAT, 0600);
    REQUIRE(saved >= 0);
    REQUIRE(file >= 0);
    ::dup2(file, STDERR_FILENO);
    work();
    std::fflush(stderr);
    ::dup2(saved, STDERR_FILENO);
    ::close(saved);
    ::close(file);
    return std::filesystem::file_size(printed);
}

/// A triangle whose base colour is this image.
GltfFixture with_image(const std::string& file)
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["images"] = {{{"uri", "data:application/octet-stream;base64," + base64(file)}}};
    fixture.json["textures"] = {{{"source", 0}}};
    fixture.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    fixture.json["meshes"][0]["primitives"][0]["material"] = 0;
    return fixture;
}

enum class Outcome { sound, damaged, refused };

/// Any other outcome ends the test.
Outcome outcome_of(const std::string& file)
{
    ReadLimits limits;
    limits.image_side = 1024;
    try {
        const DecodedImage decoded = decode_texels(view(file), limits);
        const TexelImage& image = decoded.image;
        REQUIRE(image.bytes.size() ==
                static_cast<std::size_t>(image.width * image.height * image.channels));
        return decoded.damage.empty() ? Outcome::sound : Outcome::damaged;
    } catch (const Error& error) {
        REQUIRE(error.code() == ErrorCode::invalid_input);
        REQUIRE(contains(error.what(), "image of "));
    } catch (const std::runtime_error& error) {
        const std::string what = error.what();
        REQUIRE((what.starts_with("JPEG: ") || what.starts_with("WebP: ") ||
                 what.starts_with("neither PNG")));
        REQUIRE(what.find('\n') == std::string::npos);
    }
    return Outcome::refused;
}

std::string refusal(const std::string& file)
{
    try {
        static_cast<void>(decode_texels(view(file), {}));
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

std::vector<std::string> sound_files()
{
    return {encode_jpeg(make_picture(40, 40, 3), JpegKind::subsampled),
            encode_jpeg(make_picture(40, 40, 3), JpegKind::progressive),
            encode_jpeg(make_picture(20, 20, 4), JpegKind::ycck),
            encode_jpeg(make_picture(40, 40, 3), JpegKind::restarts),
            encode_webp(make_picture(40, 40, 4), false),
            encode_webp(make_picture(20, 20, 4), true)};
}

/// Width and height of a JPEG file stand behind the length and the precision of its frame.
void set_jpeg_size(std::string& file, int width, int height)
{
    const std::size_t frame = file.find("\xff\xc0");
    REQUIRE(frame != std::string::npos);
    file.replace(frame + 5, 4, raw({height >> 8, height & 255, width >> 8, width & 255}));
}

}  // namespace

TEST_CASE("a JPEG image that ends too early has what is there, and a warning")
{
    const std::string whole = encode_jpeg(make_picture(64, 64, 3), JpegKind::baseline);
    const std::vector<std::uint8_t> texels = decode_texels(view(whole), {}).image.bytes;
    const LoadedScene loaded = with_image(whole.substr(0, whole.size() * 3 / 4)).load();
    REQUIRE(loaded.scene.images.size() == 1);
    const std::vector<std::uint8_t>& left = loaded.scene.images[0].bytes;
    REQUIRE(left.size() == texels.size());
    CHECK(std::equal(left.begin(), left.begin() + 64 * 3 * 32, texels.begin()));
    CHECK(left != texels);
    REQUIRE(loaded.warnings.size() == 1);
    CHECK(warns(loaded.warnings, {"/images/0: JPEG: Premature end", "the image is damaged"}));
}

TEST_CASE("a damaged image is told of each time that it is loaded")
{
    const std::string whole = encode_jpeg(make_picture(64, 64, 3), JpegKind::baseline);
    GltfOptions options;
    options.images = std::make_shared<ImageCache>(std::uint64_t{1} << 20U);
    for (int i = 0; i < 2; ++i) {
        CHECK(with_image(whole.substr(0, whole.size() / 2)).load(options).warnings.size() == 1);
        CHECK(with_image(whole).load(options).warnings.empty());
    }
    CHECK(options.images->bytes() == 64 * 64 * 3);
}

TEST_CASE("a WebP image that ends too early is left out")
{
    const std::string whole = encode_webp(make_picture(64, 64, 4), false);
    const LoadedScene loaded = with_image(whole.substr(0, whole.size() * 3 / 4)).load();
    CHECK(loaded.scene.images.empty());
    CHECK(warns(loaded.warnings, {"/images/0: WebP: ", "ends too early"}));
}

TEST_CASE("a WebP image whose pixels are broken is left out")
{
    for (const bool lossless : {false, true}) {
        std::string broken = encode_webp(make_picture(64, 64, 4), lossless);
        const std::size_t from = broken.size() / 2;
        if (lossless) {
            broken.replace(from, broken.size() - from, broken.size() - from, '\xff');
        } else {
            broken.replace(broken.find("VP8 ") + 8 + 10, 20, 20, '\xff');
        }
        const LoadedScene loaded = with_image(broken).load();
        CHECK(loaded.scene.images.empty());
        CHECK(warns(loaded.warnings, {"/images/0: WebP: broken pixels"}));
    }
}

TEST_CASE("images that are cut off anywhere are damaged or refused, without a word of libraries")
{
    CHECK(printed_by([] {
              for (const std::string& file : sound_files()) {
                  const bool is_webp = file.starts_with("RIFF");
                  REQUIRE(outcome_of(file) == Outcome::sound);
                  // Of JPEG only what tells of the end may be missing.
                  const std::size_t most = file.size() - (is_webp ? 1 : 3);
                  for (std::size_t size = 0; size <= most; size += size < 700 ? 1 : 7) {
                      const Outcome outcome = outcome_of(file.substr(0, size));
                      REQUIRE(outcome != Outcome::sound);
                      REQUIRE((!is_webp || outcome == Outcome::refused));
                  }
              }
          }) == 0);
}

TEST_CASE("images with flipped bits are read or refused, the same each time")
{
    std::uint32_t noise = 7;
    const auto next = [&noise](std::size_t end) {
        noise = noise * 1664525U + 1013904223U;
        return (noise >> 8U) % end;
    };
    int refused = 0;
    CHECK(printed_by([&] {
              for (const std::string& file : sound_files()) {
                  for (int i = 0; i < 300; ++i) {
                      std::string flipped = file;
                      for (int bit = 0; bit < 1 + i % 3; ++bit) {
                          flipped[next(file.size())] ^= static_cast<char>(1 << next(8));
                      }
                      const Outcome outcome = outcome_of(flipped);
                      REQUIRE(outcome == outcome_of(flipped));
                      refused += outcome == Outcome::refused ? 1 : 0;
                      if (outcome != Outcome::refused) {
                          REQUIRE(decode_texels(view(flipped), {}).image.bytes ==
                                  decode_texels(view(flipped), {}).image.bytes);
                      }
                  }
              }
          }) == 0);
    CHECK(refused > 100);
}

TEST_CASE("a JPEG image is refused by its header, before it is decoded")
{
    std::string file = encode_jpeg(make_picture(16, 16, 3), JpegKind::baseline);
    set_jpeg_size(file, 12288, 12288);
    GltfOptions little;
    little.limits.image_bytes = 400'000'000;
    const Error bomb = with_image(file).error(little);
    CHECK(bomb.code() == ErrorCode::invalid_input);
    CHECK(
        contains(bomb.what(),
                 "/images/0: image of 12288 x 12288 pixels needs 453 MB, but the limit is 400 MB"));
    set_jpeg_size(file, 65000, 3);
    CHECK(contains(with_image(file).error().what(), "65000 x 3 pixels, but the limit is "));
    set_jpeg_size(file, 16, 0);
    CHECK(refusal(file).starts_with("JPEG: "));

    GltfOptions options;
    options.limits.image_bytes = 767;
    const Error large =
        with_image(encode_jpeg(make_picture(16, 16, 4), JpegKind::cmyk)).error(options);
    CHECK(contains(large.what(), "needs 768 B, but the limit is 767 B"));
    const Error webp = with_image(encode_webp(make_picture(16, 16, 3), true)).error(options);
    CHECK(contains(webp.what(), "needs 768 B, but the limit is 767 B"));
}

TEST_CASE("JPEG images whose channels nobody knows are refused")
{
    CHECK(refusal(encode_jpeg(make_picture(16, 16, 2), JpegKind::two_channels)) ==
          "JPEG: channels of unknown meaning");
    std::string deep = encode_jpeg(make_picture(16, 16, 1), JpegKind::grey);
    deep[deep.find("\xff\xc0") + 4] = 12;
    CHECK(refusal(deep).starts_with("JPEG: "));
}

TEST_CASE("JPEG images of endless scans are refused")
{
    const std::string file = encode_jpeg(make_picture(16, 16, 3), JpegKind::progressive);
    CHECK(outcome_of(repeat_scan(file, 100)) == Outcome::damaged);
    CHECK(refusal(repeat_scan(file, 600)) == "JPEG: too many scans");
}

TEST_CASE("a broken PNG image is told of once, by its warning")
{
    std::string broken = png(2, 1, 8, 0, {raw({7, 250})});
    broken[broken.find("IDAT") + 8] ^= 1;  // pixels that their checksum does not fit
    LoadedScene loaded;
    CHECK(printed_by([&] { loaded = with_image(broken).load(); }) == 0);
    REQUIRE(loaded.warnings.size() == 1);
    CHECK(warns(loaded.warnings, {"/images/0: PNG: IDAT: "}));
}

}  // namespace bdpt::test::damaged_test
