#include <bdpt/io/read_image.h>

#include "../gltf_fixture.h"
#include "catch.hpp"
#include "file/read_file.h"
#include "gltf/compression/compression.h"
#include "gltf/document/document.h"
#include "image/linear/image_readers.h"

#include <algorithm>
#include <string>
#include <vector>

namespace bdpt::test::safely_test {
using namespace bdpt::io;

namespace {

std::string text(std::uint32_t value)
{
    return bytes_of(std::vector<std::uint32_t>{value});
}

/// The start of an OpenEXR file and one attribute of a header.
std::string exr_with(const std::string& name, std::uint32_t size, const std::string& data,
                     const std::string& type = "unknown")
{
    return text(20000630) + text(2) + name + '\0' + type + '\0' + text(size) + data;
}

std::string header_error(const std::string& file)
{
    try {
        check_exr_header({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, {});
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        return error.what();
    }
    return "";
}

Bytes read(const std::filesystem::path& file)
{
    return read_file(file, 1u << 20);
}

}  // namespace

TEST_CASE("OpenEXR is not asked to make room for more than there is")
{
    using namespace std::string_literals;
    const std::string end(1, '\0');
    CHECK(header_error(exr_with("owner", 4, "abcd") + end).empty());
    CHECK(header_error(exr_with("owner", 5, "abcd")) ==
          "OpenEXR: attribute \"owner\": 5 bytes, but 4 are left");
    // OpenEXR has sizes as `int`, so this is the most that it would take: 2 GB.
    CHECK(contains(header_error(exr_with("owner", 2147483647, "abcd")), "2147483647 bytes"));
    CHECK(contains(header_error(exr_with("owner", 4, "abcd") + exr_with("x", 99, "").substr(8)),
                   "attribute \"x\": 99 bytes, but 0 are left"));
    CHECK(contains(header_error(exr_with("tiles", 9, text(64) + text(1u << 20) + end)),
                   "tiles of 64 x 1048576 pixels, but the limit is 16384 a side"));
    CHECK(header_error(exr_with("tiles", 9, text(64) + text(64) + end + end)).empty());
    const auto window = [&end](std::uint32_t x0, std::uint32_t y0, std::uint32_t x1,
                               std::uint32_t y1) {
        return exr_with("dataWindow", 16, text(x0) + text(y0) + text(x1) + text(y1) + end);
    };
    CHECK(header_error(window(0xffffffff, 0, 0, 16382)).empty());
    CHECK(contains(header_error(window(0, 0, 1, 16384)), "image of 2 x 16385 pixels"));
    CHECK(contains(header_error(window(0x80000000, 0, 0x7fffffff, 1)), "image of 4294967296 x 2"));
    CHECK(contains(header_error(window(3, 0, 1, 1)), "image of -1 x 2"));
    // A second part, as the flag for parts says.
    std::string parts = exr_with("a", 0, "") + end + "b\0c\0"s + text(7);
    CHECK(header_error(parts).empty());
    parts[5] = 0x10;
    CHECK(contains(header_error(parts), "attribute \"b\": 7 bytes, but 0 are left"));
    // Wherever it ends.
    for (std::size_t length = 0; length < parts.size(); ++length) {
        static_cast<void>(header_error(parts.substr(0, length)));
    }
}

TEST_CASE("attributes of OpenEXR have the size of their type")
{
    using namespace std::string_literals;
    struct Attribute {
        std::string type;
        std::string sound;  // a value of this type
    };
    const std::string channel = "R\0"s + std::string(16, 'x');
    const Attribute attributes[] = {{"float", "1234"},
                                    {"box2f", std::string(16, 'x')},
                                    {"lineOrder", "0"},
                                    {"chlist", channel + channel + '\0'},
                                    {"preview", text(2) + text(1) + "rgbargba"},
                                    {"stringvector", text(2) + "ab" + text(0)}};
    const std::string end(1, '\0');
    for (const Attribute& attribute : attributes) {
        CAPTURE(attribute.type);
        const auto size = static_cast<std::uint32_t>(attribute.sound.size());
        CHECK(header_error(exr_with("a", size, attribute.sound + end, attribute.type)).empty());
        // One byte more or less would move all that follows.
        for (const std::uint32_t wrong : {size - 1, size + 1}) {
            CHECK(contains(
                header_error(exr_with("a", wrong, attribute.sound + "????", attribute.type)),
                "are not the size of its \"" + attribute.type));
        }
    }
    CHECK(contains(header_error(exr_with("a", 8, text(1u << 31) + text(1u << 31), "preview")),
                   "not the size"));
    CHECK(contains(header_error(exr_with("a", 8, text(1u << 30) + "abcd", "stringvector")),
                   "not the size"));
}

TEST_CASE("an OpenEXR file is checked before it is opened")
{
    const TempFolder folder;
    const auto file = folder.write("long.exr", exr_with("owner", 2147483647, "abcd"));
    try {
        static_cast<void>(read_image(file));
        FAIL("it was read");
    } catch (const Error& error) {
        CHECK(contains(error.what(), "attribute \"owner\": 2147483647 bytes"));
    }
}

TEST_CASE("of a buffer's file no more is read than the buffer needs")
{
    const TempFolder folder;
    const auto large = folder.write("large.bin", std::string(100000, 'x'));
    CHECK(read_file(large, 100000, 7).size() == 7);
    CHECK(read_file(large, 100000, 200000).size() == 100000);
    GltfFixture fixture;
    for (int i = 0; i < 3; ++i) {
        fixture.json["buffers"].push_back({{"byteLength", 10 + i}, {"uri", "large.bin"}});
    }
    LoadContext context{.folders = {.own = folder.path()}};
    const CheckedGltf checked =
        read_checked_gltf(folder.write("scene.gltf", fixture.json.dump()), context);
    REQUIRE(checked.buffers.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(checked.buffers[i].size() == 11 + i);  // one more tells that there are more
    }
    CHECK(warns(context.warnings.lines(), {"more bytes than its byteLength", "and 2 more"}));
}

TEST_CASE("a Draco mesh of more points than its head says keeps to the limit")
{
    if (!has_draco()) {
        WARN("skipped: this build has no Draco");
        return;
    }
    const Bytes file =
        read(std::filesystem::path(BDPT_SOURCE_DIR) / "tests/data/compressed/wave-draco.glb");
    const std::string magic = "DRACO";
    const auto start = std::search(file.begin(), file.end(), magic.begin(), magic.end());
    const ByteView data(&*start, static_cast<std::size_t>(file.end() - start));
    const DracoSize size = draco_size(data);
    const std::vector<DracoAttribute> attributes{
        {.id = 0, .component_type = 5126, .components = 3}};
    const DracoMesh mesh = decode_draco_mesh(data, attributes, 1u << 20);
    CHECK(mesh.points >= size.vertices);
    CHECK(decode_draco_mesh(data, attributes, 12 * mesh.points).points == mesh.points);
    try {
        static_cast<void>(decode_draco_mesh(data, attributes, 12 * mesh.points - 1));
        FAIL("it was decoded");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(contains(error.what(), "are left of the limit"));
    }
}

}  // namespace bdpt::test::safely_test
