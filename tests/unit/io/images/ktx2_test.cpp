// KTX2 images as textures: what their headers may say, how libktx decodes them, and what becomes of
// a scene where it cannot.

#include <bdpt/error.h>
#include <bdpt/io/gltf.h>

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "../gltf_fixture.h"
#include "../image_fixture.h"
#include "catch.hpp"
#include "encoders.h"
#include "file/read_file.h"
#include "image/encoded_image.h"
#include "ktx2_file.h"

namespace bdpt::test::ktx2_test {
namespace {

namespace fs = std::filesystem;
using namespace bdpt::io;
using Texels = std::vector<std::uint8_t>;

/// What is wrong with a header; empty: nothing.
std::string fault(const std::string& bytes)
{
    try {
        static_cast<void>(read_ktx2_header(view(bytes)));
        return "";
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

/// The fake library under a name by which it misbehaves.
class Misbehaving {
public:
    explicit Misbehaving(const std::string& how)
        : library_(folder_.path() / ("libktx-" + how + ".so"))
    {
        fs::create_symlink(BDPT_FAKE_KTX, library_);
    }

    [[nodiscard]] const fs::path& library() const { return library_; }

private:
    TempFolder folder_;
    fs::path library_;
};

DecodedImage decode(const std::string& bytes, const fs::path& library = BDPT_FAKE_KTX)
{
    Ktx2Decoder decoder(library);
    return EncodedImage(view(bytes), {}, &decoder).decode();
}

std::string decoding_fault(const std::string& bytes, const fs::path& library = BDPT_FAKE_KTX)
{
    try {
        static_cast<void>(decode(bytes, library));
        return "";
    } catch (const std::runtime_error& error) {
        return error.what();
    }
}

nlohmann::json data_uri(std::string_view bytes)
{
    return {{"uri", "data:;base64," + base64(bytes)}};
}

/// A triangle whose base colour is texture 0, of the KTX2 image 0 by the extension, and of a grey
/// PNG if it has a fallback.
GltfFixture with_ktx2(const std::string& bytes, bool fallback = false)
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["meshes"][0]["primitives"][0]["material"] = 0;
    fixture.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    fixture.json["extensionsUsed"] = {"KHR_texture_basisu"};
    fixture.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
    fixture.json["images"] = nlohmann::json::array({data_uri(bytes)});
    if (fallback) {
        fixture.json["images"].push_back(data_uri(png(1, 1, 8, 0, {raw({7})})));
        fixture.json["textures"][0]["source"] = 1;
    }
    return fixture;
}

GltfOptions by(const fs::path& library)
{
    GltfOptions options;
    options.ktx_library = library;
    return options;
}

const GltfOptions fake = by(BDPT_FAKE_KTX);
const GltfOptions none = by("/nowhere/libktx.so.4");

}  // namespace

TEST_CASE("the header of a KTX2 image says what it is")
{
    const Ktx2Header rgb = read_ktx2_header(view(Ktx2File::uastc().bytes()));
    CHECK(rgb.width == 8);
    CHECK(rgb.height == 4);
    CHECK(rgb.channels == 3);
    CHECK(rgb.pixels == 32);
    CHECK(rgb.encoding == ColorEncoding::srgb);
    CHECK(rgb.remarks.empty());
    CHECK(read_ktx2_header(view(Ktx2File::uastc(true).bytes())).channels == 4);
    CHECK(read_ktx2_header(view(Ktx2File::etc1s().bytes())).channels == 3);
    CHECK(read_ktx2_header(view(Ktx2File::etc1s(true).bytes())).channels == 4);
    const Ktx2Header plain = read_ktx2_header(view(Ktx2File::plain().bytes()));
    CHECK(plain.encoding == ColorEncoding::linear);
    CHECK(plain.remarks == std::vector<std::string>{"VkFormat 23, not Basis Universal"});

    Ktx2File levels = Ktx2File::uastc();
    levels.levels = {{std::string(32, 'a'), 32},
                     {std::string(16, 'b'), 16},
                     {std::string(16, 'c'), 16},
                     {std::string(16, 'd'), 16}};
    levels.level_count = 4;
    CHECK(read_ktx2_header(view(levels.bytes())).pixels == 32 + 8 + 2 + 1);
}

TEST_CASE("what KHR_texture_basisu does not allow is said, and tolerated where it does no harm")
{
    Ktx2File odd = Ktx2File::uastc();
    odd.width = 7;
    odd.flags = 1;
    odd.metadata = {{"KTXorientation", "rd"}, {"KTXswizzle", "rrr1"}, {"KTXwriter", "a test"}};
    CHECK(read_ktx2_header(view(odd.bytes())).remarks ==
          std::vector<std::string>{"KTXswizzle is \"rrr1\"", "7 x 4 pixels, not multiples of 4",
                                   "premultiplied alpha"});
    const LoadedScene loaded = with_ktx2(odd.bytes()).load(fake);
    CHECK(loaded.scene.images.size() == 1);
    CHECK(warns(loaded.warnings, {"/images/0: KTXswizzle is \"rrr1\"",
                                  "KHR_texture_basisu does not allow", "2 more"}));
    odd.metadata = {{"KTXorientation", "ru"}};
    CHECK(contains(read_ktx2_header(view(odd.bytes())).remarks.at(0), "KTXorientation is \"ru\""));
}

TEST_CASE("KTX2 headers that lie are refused before a library sees the file")
{
    struct Case {
        std::string bytes;
        std::string fault;
    };
    const std::string sound = Ktx2File::uastc().bytes();
    const auto changed = [](const auto& change, Ktx2File file = Ktx2File::uastc()) {
        change(file);
        return file.bytes();
    };
    const auto patched = [&](std::size_t offset, std::uint64_t value, std::size_t count = 4) {
        return Ktx2File::patched(sound, offset, value, count);
    };
    const std::vector<Case> cases{
        {sound, ""},
        {"\xabKTX 11\xbb\r\n\x1a\n" + sound.substr(12), "not of version 2"},
        {sound.substr(0, 12), "ends within its header, after 12 bytes"},
        {sound.substr(0, 50), "ends within its header, after 50 bytes"},
        {sound.substr(0, 110),
         "the data format descriptor has 44 bytes from byte 104 on, but the "
         "file ends at byte 110"},
        {sound.substr(0, sound.size() - 1), "level 0 has 32 bytes from byte 160 on"},
        {changed([](auto& f) { f.faces = 6; }), "a cube map"},
        {changed([](auto& f) { f.depth = 4; }), "a 3D image, 4 deep"},
        {changed([](auto& f) { f.layers = 7; }), "an array of 7 images"},
        {changed([](auto& f) { f.faces = 0; }), "0 faces"},
        {changed([](auto& f) { f.width = 0; }), "0 x 4 pixels"},
        {changed([](auto& f) { f.height = 0; }), "8 x 0 pixels"},
        {changed([](auto& f) { f.width = f.height = 0xffffffff; }),
         "4294967295 x 4294967295 pixels"},
        {changed([](auto& f) { f.level_count = 0; }), "no levels"},
        {changed([](auto& f) { f.level_count = 5; }), "5 levels, but 8 x 4 pixels have 4 at most"},
        {changed([](auto& f) { f.level_count = 0xffffffff; }), "4294967295 levels"},
        {changed([](auto& f) { f.width = f.height = 1'000'000'000; }),
         "level 0 of 1000000000 x 1000000000 pixels has 32 bytes, but must have "
         "1000000000000000000"},
        {changed([](auto& f) { f.width = f.height = 1U << 30U; }, Ktx2File::plain()),
         "has 6 bytes, but must have 3458764513820540928"},
        {changed([](auto& f) { f.supercompression = 1; }), "UASTC with supercompression 1"},
        {changed([](auto& f) { f.supercompression = 3; }), "UASTC with supercompression 3"},
        {changed([](auto& f) { f.supercompression = 0; }, Ktx2File::etc1s()),
         "ETC1S with supercompression 0"},
        {changed([](auto& f) { f.supercompression = 1; }, Ktx2File::plain()),
         "8-bit RGB with supercompression 1"},
        {changed([](auto& f) { f.format = 131; }), "VkFormat 131 with colour model 166"},
        {changed([](auto& f) { f.model = 2; }), "VkFormat 0 with colour model 2"},
        {changed([](auto& f) { f.channels = {5}; }), "channels other than RGB and RGBA"},
        {changed([](auto& f) {
             f.channels = {0, 0};
         }),
         "channels other than RGB and RGBA"},
        {changed(
             [](auto& f) {
                 f.channels = {3, 4};
             },
             Ktx2File::etc1s()),
         "channels other than RGB and RGBA"},
        {changed([](auto& f) { f.channels = {}; }), "descriptor of 28 bytes is broken"},
        {changed([](auto& f) { f.global_data.resize(39); }, Ktx2File::etc1s()),
         "the supercompression data has 39 bytes, too few for 1 levels"},
        {changed([](auto& f) { f.levels[0].bytes = ""; }, Ktx2File::etc1s()),
         "level 0 of 8 x 4 pixels has 0 bytes"},
        {changed([](auto& f) {
             f.supercompression = 2;
             f.levels[0].unpacked = 0xffffffffffff;
         }),
         "has 281474976710655 bytes, but must have 32"},
        {patched(48, 0xfffffff0), "the data format descriptor has 44 bytes"},
        {patched(52, 0xffffffff), "the data format descriptor has 4294967295 bytes"},
        {patched(56, 0xffffffff), "its metadata has 0 bytes from byte 4294967295 on"},
        {patched(60, 1U << 31U), "its metadata has 2147483648 bytes"},
        {patched(64, UINT64_MAX, 8), "the supercompression data has 0 bytes from byte"},
        {patched(72, UINT64_MAX, 8), "the supercompression data has 18446744073709551615 bytes"},
        {patched(80, UINT64_MAX, 8), "level 0 has 32 bytes from byte 18446744073709551615 on"},
        {patched(88, UINT64_MAX, 8), "level 0 has 18446744073709551615 bytes"},
        {patched(104 + 10, 25, 2), "descriptor of 44 bytes is broken"},
        {patched(104 + 10, 56, 2), "descriptor of 44 bytes is broken"},
        {patched(104 + 4, 1), "descriptor of 44 bytes is broken"},
    };
    for (const Case& tried : cases) {
        const std::string said = fault(tried.bytes);
        CAPTURE(tried.fault, said);
        CHECK(said.empty() == tried.fault.empty());
        CHECK(contains(said, tried.fault));
    }
    Ktx2File pairs = Ktx2File::uastc();
    pairs.metadata = {{"KTXwriter", "x"}};
    const std::string whole = pairs.bytes();
    const std::size_t place = whole.find("KTXwriter") - 4;
    CHECK(contains(fault(Ktx2File::patched(whole, place, 0xffffffff)),
                   "its metadata is broken at byte 0"));
    CHECK(contains(fault(Ktx2File::patched(whole, place, 0)), "its metadata is broken at byte 4"));
    // No number of a sound file, whatever it becomes, makes it read or write where it must not.
    for (std::size_t at = 0; at < whole.size(); ++at) {
        for (const int value : {0, 1, 127, 128, 255}) {
            std::string mutant = whole;
            mutant[at] = static_cast<char>(value);
            static_cast<void>(fault(mutant));
        }
    }
}

TEST_CASE("libktx decodes the first level of a KTX2 image")
{
    const TexelImage rgb = decode(Ktx2File::uastc().bytes()).image;
    CHECK(rgb.width == 8);
    CHECK(rgb.height == 4);
    REQUIRE(rgb.channels == 3);
    CHECK(rgb.type == TexelType::unorm8);
    REQUIRE(rgb.bytes.size() == 8 * 4 * 3);
    CHECK(Texels(rgb.bytes.begin() + 3 * (2 * 8 + 5), rgb.bytes.begin() + 3 * (2 * 8 + 5) + 3) ==
          Texels{5, 2, 'u'});
    const TexelImage rgba = decode(Ktx2File::etc1s(true).bytes()).image;
    REQUIRE(rgba.channels == 4);
    REQUIRE(rgba.bytes.size() == 8 * 4 * 4);
    CHECK(Texels(rgba.bytes.end() - 4, rgba.bytes.end()) == Texels{7, 3, 'e', 77});
    CHECK(decode(Ktx2File::plain().bytes()).image.bytes == Texels{1, 2, 3, 4, 5, 6});
    // More pixels than a pipe holds, and than are repacked at once.
    Ktx2File large = Ktx2File::etc1s();
    large.width = 512;
    large.height = 256;
    const TexelImage many = decode(large.bytes()).image;
    REQUIRE(many.bytes.size() == 512 * 256 * 3);
    CHECK(Texels(many.bytes.end() - 3, many.bytes.end()) == Texels{255, 255, 'e'});
    CHECK(many.bytes[3 * (100 * 512 + 17)] == 17);
}

TEST_CASE("a KTX2 image that libktx cannot decode costs one image")
{
    const std::string bytes = Ktx2File::uastc().bytes();
    const auto fault_of = [&](const char* how) {
        return decoding_fault(bytes, Misbehaving(how).library());
    };
    CHECK(fault_of("fail") == "KTX2: broken: libktx says: the file is bad");
    CHECK(fault_of("crash") == "KTX2: broken: libktx crashed on it (signal 6)");
    CHECK(fault_of("short") == "KTX2: broken: libktx decodes another size");
    CHECK(fault_of("throw") == "KTX2: broken: no C++ exceptions");
#ifndef BDPT_SANITIZED
    CHECK(contains(fault_of("greedy"), "KTX2: broken, or too large: decoding takes more than"));
#endif
    const Misbehaving crash("crash");
    const LoadedScene loaded = with_ktx2(bytes, true).load(by(crash.library()));
    REQUIRE(loaded.scene.images.size() == 1);
    CHECK(loaded.scene.images[0].bytes == Texels{7});  // the fallback
    CHECK(warns(loaded.warnings, {"/images/0: KTX2: broken: libktx crashed"}));
}

TEST_CASE("without libktx the other image of a texture is used, or none, or the file is refused")
{
    GltfFixture fixture = with_ktx2(Ktx2File::uastc().bytes(), true);
    const LoadedScene with = fixture.load(fake);
    REQUIRE(with.scene.images.size() == 1);
    CHECK(with.scene.images[0].width == 8);
    CHECK(with.warnings.empty());
    const LoadedScene other = fixture.load(none);
    REQUIRE(other.scene.images.size() == 1);
    CHECK(other.scene.images[0].bytes == Texels{7});
    CHECK(warns(other.warnings,
                {"/textures/0: the image beside the KTX2 one is used: libktx was not found: "
                 "/nowhere/libktx.so.4: ",
                 "https://github.com/KhronosGroup/KTX-Software"}));

    fixture = with_ktx2(Ktx2File::uastc().bytes());
    const LoadedScene without = fixture.load(none);
    CHECK(without.scene.images.empty());
    CHECK_FALSE(without.scene.materials.at(0).base_color_texture);
    CHECK(warns(without.warnings, {"/textures/0: the KTX2 texture is left out: "
                                   "libktx was not found: "}));

    fixture.json["extensionsRequired"] = {"KHR_texture_basisu"};
    CHECK(fixture.load(fake).scene.images.size() == 1);
    const Error refused = fixture.error(none);
    CHECK(refused.code() == ErrorCode::unsupported);
    CHECK(contains(refused.what(),
                   "/extensionsRequired/0: the file requires \"KHR_texture_basisu\""
                   ", KTX2 textures: libktx was not found: /nowhere/"));
    GltfOptions anyway = none;
    anyway.ignore_required = true;
    const LoadedScene ignored = fixture.load(anyway);
    CHECK_FALSE(ignored.scene.materials.at(0).base_color_texture);
    CHECK(warns(ignored.warnings, {"/extensionsRequired/0: it requires \"KHR_texture_basisu\"",
                                   "loaded without what the file requires"}));
}

TEST_CASE("other required extensions can be ignored, but not those of compressed meshes")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["extensionsRequired"] = {"EXAMPLE_unknown", "EXT_texture_avif"};
    CHECK(fixture.error().code() == ErrorCode::unsupported);
    GltfOptions anyway;
    anyway.ignore_required = true;
    CHECK(warns(fixture.load(anyway).warnings, {"requires \"EXAMPLE_unknown\"", "1 more"}));
}

TEST_CASE("what is no libktx is not taken for one")
{
    const std::string bytes = Ktx2File::uastc().bytes();
    const TempFolder folder;
    CHECK(contains(decoding_fault(bytes, folder.path()), "libktx was not found: "));
    CHECK(contains(decoding_fault(bytes, folder.write("text.so", "no library")),
                   "libktx was not found: "));
    CHECK(contains(decoding_fault(bytes, BDPT_FAKE_OIDN),
                   "is not libktx 4: it has no ktxTexture2_CreateFromMemory"));
    // A folder has the library by its name.
    for (const char* name : {"libktx.so", "libktx.so.4"}) {
        CAPTURE(name);
        const TempFolder place;
        fs::create_symlink(BDPT_FAKE_KTX, place.path() / name);
        CHECK(decoding_fault(bytes, place.path()).empty());
    }
}

TEST_CASE("KTX2 images without the extension are read, too")
{
    GltfFixture fixture = with_ktx2(Ktx2File::plain().bytes());
    fixture.json["textures"] = {{{"source", 0}}};
    fixture.json.erase("extensionsUsed");
    const LoadedScene loaded = fixture.load(fake);
    REQUIRE(loaded.scene.images.size() == 1);
    CHECK(loaded.scene.images[0].bytes == Texels{1, 2, 3, 4, 5, 6});
    CHECK(warns(loaded.warnings, {"/images/0: VkFormat 23, not Basis Universal"}));
    CHECK(warns(fixture.load(none).warnings, {"/images/0: libktx was not found: "}));
}

TEST_CASE("a texture goes by what it is for, and says where its KTX2 image disagrees")
{
    GltfFixture fixture = with_ktx2(Ktx2File::uastc().bytes());
    CHECK(fixture.load(fake).warnings.empty());
    fixture.json["materials"][0]["normalTexture"] = {{"index", 0}};
    CHECK(warns(fixture.load(fake).warnings,
                {"/images/0: data of a KTX2 image that says it is sRGB is read as linear"}));
    Ktx2File linear = Ktx2File::uastc();
    linear.transfer = 1;
    CHECK(warns(with_ktx2(linear.bytes()).load(fake).warnings,
                {"/images/0: colours of a KTX2 image that says it is linear are read as sRGB"}));
}

TEST_CASE("KTX2 images beyond the limits are refused before they are decoded")
{
    const Misbehaving crash("crash");  // so nothing may be decoded
    Ktx2File wide = Ktx2File::etc1s();
    wide.width = 1'000'000'000;
    const Error error = with_ktx2(wide.bytes()).error(by(crash.library()));
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(error.what(), "/images/0: image of 1000000000 x 4 pixels, but the limit is"));
    wide.width = wide.height = 16384;
    GltfOptions little = by(crash.library());
    little.limits.image_bytes = 1000;
    CHECK(contains(with_ktx2(wide.bytes()).error(little).what(),
                   "image of 16384 x 16384 pixels needs"));
    GltfOptions poor = by(crash.library());
    poor.limits.memory_bytes = 100 << 20;
    CHECK(contains(with_ktx2(wide.bytes()).error(poor).what(), "of memory"));
    CHECK(contains(with_ktx2(wide.bytes()).error(poor).what(), "/images/0: "));
    // Room for the texels, but not for the process that decodes them.
    poor.limits.memory_bytes = std::uint64_t{1300} << 20U;
    CHECK(contains(with_ktx2(wide.bytes()).error(poor).what(),
                   "/images/0: decoding the image needs "));
}

TEST_CASE("libktx sees no environment")
{
    const std::string bytes = Ktx2File::uastc().bytes();
    const Misbehaving secret("secret");
    ::setenv("BDPT_TEST_SECRET", "1", 1);
    CHECK(decoding_fault(bytes, secret.library()).empty());
    ::unsetenv("BDPT_TEST_SECRET");
}

#ifndef BDPT_SANITIZED
TEST_CASE("a file that takes libktx over can neither write files, connect nor start programs")
{
    std::ifstream reader(companion_file("bdpt-read-ktx"), std::ios::binary);
    const std::string program(std::istreambuf_iterator<char>(reader), {});
    if (!contains(program, "libseccomp.so")) {
        WARN("skipped: built without libseccomp");
        return;
    }
    const std::string bytes = Ktx2File::uastc().bytes();
    const Misbehaving write("write");
    CHECK(decoding_fault(bytes, write.library()) == "KTX2: broken: libktx says: the file is bad");
    CHECK_FALSE(fs::exists(write.library().string() + ".written"));
    for (const char* how : {"connect", "start"}) {
        CAPTURE(how);
        CHECK(decoding_fault(bytes, Misbehaving(how).library()) ==
              "KTX2: broken: libktx was stopped when it did what decoding does not need");
    }
}
#endif

TEST_CASE("references to KTX2 images are checked")
{
    GltfFixture fixture = with_ktx2(Ktx2File::uastc().bytes());
    fixture.json["textures"][0]["extensions"]["KHR_texture_basisu"]["source"] = 7;
    const Error missing = fixture.error(fake);
    CHECK(missing.code() == ErrorCode::invalid_input);
    CHECK(contains(missing.what(), "/textures/0/extensions/KHR_texture_basisu/source"));
    fixture.json["textures"][0]["extensions"]["KHR_texture_basisu"] = nlohmann::json::object();
    CHECK(
        warns(fixture.load(fake).warnings, {"/textures/0: the texture has no PNG, JPEG, WebP or"}));
}

namespace {

std::string read_data(const char* name)
{
    std::ifstream file(fs::path(BDPT_SOURCE_DIR) / "tests/data/ktx2" / name, std::ios::binary);
    REQUIRE(file);
    return {std::istreambuf_iterator<char>(file), {}};
}

constexpr std::array samples{"etc1s-rgb-mips.ktx2", "etc1s-rgba.ktx2", "uastc-rgb.ktx2",
                             "uastc-rgba-zstd.ktx2"};

/// The real library.
std::optional<fs::path> real_library()
{
    const char* const library = std::getenv("BDPT_TEST_KTX");
    if (library == nullptr || *library == '\0') {
        WARN("skipped: BDPT_TEST_KTX does not name libktx");
        return std::nullopt;
    }
    return library;
}

/// Of the samples in the middle of each quarter.
constexpr std::array<std::array<int, 4>, 4> quarters{
    {{240, 16, 16, 255}, {16, 240, 16, 192}, {16, 16, 240, 128}, {240, 240, 16, 64}}};

/// The greatest difference of an image of 16 x 16 pixels to what was encoded.
int difference(const TexelImage& image)
{
    int most = 0;
    for (std::size_t i = 0; i < image.bytes.size(); ++i) {
        const auto channels = static_cast<std::size_t>(image.channels);
        const std::size_t pixel = i / channels;
        const std::size_t quarter = (pixel % 16 >= 8 ? 1U : 0U) + (pixel / 16 >= 8 ? 2U : 0U);
        const int expected = quarters.at(quarter).at(i % channels);
        most = std::max(most, std::abs(image.bytes[i] - expected));
    }
    return most;
}

}  // namespace

TEST_CASE("libktx itself decodes what encoders write")
{
    const auto library = real_library();
    if (!library) {
        return;
    }
    for (const char* name : samples) {
        CAPTURE(name);
        const DecodedImage decoded = decode(read_data(name), *library);
        REQUIRE(decoded.image.width == 16);
        REQUIRE(decoded.image.height == 16);
        const int channels = contains(name, "rgba") ? 4 : 3;
        CHECK(decoded.image.channels == channels);
        CHECK(decoded.remarks.empty());
        CHECK(difference(decoded.image) <= 12);
    }
    CHECK(decode(Ktx2File::plain().bytes(), *library).image.bytes == Texels{1, 2, 3, 4, 5, 6});
    // A frame of Zstandard [RFC 8878] of one block of 6 bytes as they are.
    Ktx2File packed = Ktx2File::plain();
    packed.supercompression = 2;
    packed.levels = {{std::string("\x28\xb5\x2f\xfd\x20\x06\x31\x00\x00", 9) + "abcdef", 6}};
    CHECK(decode(packed.bytes(), *library).image.bytes == Texels{'a', 'b', 'c', 'd', 'e', 'f'});
}

TEST_CASE("textures of real models are decoded as the transcoder of Basis Universal itself does")
{
    const auto library = real_library();
    const char* const folder = std::getenv("BDPT_TEST_ASSETS");
    if (!library || folder == nullptr) {
        WARN("skipped: BDPT_TEST_ASSETS or BDPT_TEST_KTX is not set");
        return;
    }
    const LoadedScene balloon =
        load_gltf(fs::path(folder) / "CesiumBalloonKTX2/CesiumBalloonKTX2.glb", by(*library));
    CHECK(balloon.warnings.empty());
    // Means of red, green and blue, by Basis Universal 2.10.
    constexpr std::array<std::array<double, 3>, 3> means{
        {{129.361, 171.975, 166.998}, {182.899, 159.124, 125.032}, {97.592, 97.592, 97.592}}};
    REQUIRE(balloon.scene.images.size() == means.size());
    for (std::size_t i = 0; i < means.size(); ++i) {
        const TexelImage& image = balloon.scene.images[i];
        REQUIRE(image.channels == 3);
        std::array<double, 3> sum{};
        for (std::size_t k = 0; k < image.bytes.size(); ++k) {
            sum.at(k % 3) += image.bytes[k];
        }
        for (std::size_t c = 0; c < 3; ++c) {
            CAPTURE(i, c);
            const double mean = sum.at(c) * 3 / static_cast<double>(image.bytes.size());
            CHECK(std::abs(mean - means.at(i).at(c)) < 0.01);
        }
    }
    const LoadedScene lamp =
        load_gltf(fs::path(folder) / "AnisotropyBarnLamp/AnisotropyBarnLamp.gltf", by(*library));
    CHECK(lamp.scene.images.size() == 4);
    CHECK(warns(lamp.warnings, {"VkFormat 23, not Basis Universal", "2 more"}));
}

TEST_CASE("broken KTX2 images do no harm to libktx's caller", "[long]")
{
    const auto library = real_library();
    if (!library) {
        return;
    }
    std::mt19937 random(5);  // the same numbers everywhere
    const auto below = [&random](std::size_t end) { return random() % end; };
    int read = 0;
    int refused = 0;
    for (int i = 0; i < 200; ++i) {
        std::string bytes = read_data(samples.at(below(samples.size())));
        const std::size_t start = 200 < bytes.size() && below(2) == 0 ? 200 : 12;
        for (std::size_t count = 1 + below(4); count > 0; --count) {
            bytes[start + below(bytes.size() - start)] =
                static_cast<char>(below(3) == 0 ? 0xff : below(256));
        }
        const std::string said = decoding_fault(bytes, *library);
        CAPTURE(i, said);
        REQUIRE(said.find('\n') == std::string::npos);
        ++(said.empty() ? read : refused);
    }
    INFO(read << " read, " << refused << " refused");
    CHECK(read > 0);
    CHECK(refused > 50);
#ifndef BDPT_SANITIZED
    rusage usage{};
    REQUIRE(getrusage(RUSAGE_CHILDREN, &usage) == 0);
    CHECK(usage.ru_maxrss < 320 * 1024);
#endif
}

}  // namespace bdpt::test::ktx2_test
