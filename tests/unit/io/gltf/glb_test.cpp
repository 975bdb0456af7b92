#include "../gltf_fixture.h"
#include "catch.hpp"

namespace bdpt::test::glb_test {
using namespace bdpt::io;

namespace {

void put(std::string& bytes, std::size_t offset, std::uint32_t value)
{
    bytes.replace(offset, 4, bytes_of<std::uint32_t>({value}));
}

std::uint32_t get(const std::string& bytes, std::size_t offset)
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[offset + i]))
                 << (8 * i);
    }
    return value;
}

/// Where the header of the BIN chunk is.
std::size_t bin_offset(const std::string& glb)
{
    return 20 + get(glb, 12);
}

LoadedScene load(const std::string& glb)
{
    const TempFolder folder;
    return load_gltf(folder.write("scene.glb", glb));
}

std::string refused(const std::string& glb, ErrorCode code = ErrorCode::invalid_input)
{
    const TempFolder folder;
    const Error error = load_error(folder.write("scene.glb", glb));
    CHECK(error.code() == code);
    CHECK(contains(error.what(), "scene.glb: "));
    return error.what();
}

}  // namespace

TEST_CASE("a binary file gives the same scene as a text file")
{
    const LoadedScene loaded = load(GltfFixture::triangle().glb());
    CHECK(loaded.scene.meshes.at(0).positions ==
          std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(loaded.scene.meshes.at(0).triangles == std::vector<UVec3>{{0, 1, 2}});
    CHECK(loaded.warnings.empty());
}

TEST_CASE("a binary file needs no BIN chunk")
{
    const std::string glb = GltfFixture().glb();
    std::string without = glb.substr(0, bin_offset(glb));
    put(without, 8, static_cast<std::uint32_t>(without.size()));
    CHECK(load(without).scene.instances.empty());
}

TEST_CASE("a binary file may use buffers by URI as well")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["buffers"] = {
        {{"byteLength", 42}}, {{"byteLength", 42}, {"uri", "data:;base64," + base64(fixture.bin)}}};
    fixture.json["bufferViews"][0]["buffer"] = 1;
    CHECK(load(fixture.glb()).scene.meshes.at(0).positions.at(1) == Vec3(1, 0, 0));

    fixture.json["buffers"][1].erase("uri");
    CHECK(contains(refused(fixture.glb()), "/buffers/1: no \"uri\""));
}

TEST_CASE("unknown chunks and bytes after the end are skipped")
{
    std::string glb = GltfFixture::triangle().glb();
    glb += bytes_of<std::uint32_t>({4}) + "XTRA" + "1234";
    put(glb, 8, static_cast<std::uint32_t>(glb.size()));
    CHECK(load(glb).warnings.empty());
    const LoadedScene loaded = load(glb + "rest");
    CHECK(loaded.scene.instances.size() == 1);
    CHECK(warns(loaded.warnings, {"GLB: 4 bytes", "ignored"}));
}

TEST_CASE("zeros may pad the JSON chunk")
{
    std::string glb = GltfFixture::triangle().glb();
    const std::string text = glb.substr(20, get(glb, 12));
    const std::string rest = glb.substr(bin_offset(glb));
    glb = glb.substr(0, 20) + text + std::string(4, '\0') + rest;
    put(glb, 12, get(glb, 12) + 4);
    put(glb, 8, static_cast<std::uint32_t>(glb.size()));
    CHECK(load(glb).scene.instances.size() == 1);
}

TEST_CASE("broken framing is refused")
{
    const std::string good = GltfFixture::triangle().glb();
    const auto changed = [&good](std::size_t offset, std::uint32_t value) {
        std::string glb = good;
        put(glb, offset, value);
        return glb;
    };
    CHECK(contains(refused(good.substr(0, 11)), "11 bytes are less than a header"));
    CHECK(contains(refused(good.substr(0, good.size() - 1)), "the header promises"));
    CHECK(contains(refused(changed(4, 1), ErrorCode::unsupported), "container version 1"));
    CHECK(contains(refused(changed(8, 12)), "no JSON chunk"));
    for (const std::uint32_t length : {0U, 4U, 11U}) {
        CHECK(contains(refused(changed(8, length)), "GLB: the header states a length of " +
                                                        std::to_string(length) +
                                                        " bytes, but has 12 itself"));
    }
    CHECK(contains(refused(changed(8, 15)), "3 bytes at byte 12"));
    CHECK(contains(refused(changed(12, 0xFFFFFFFF)), "chunk at byte 12: 4294967295 bytes"));
    CHECK(contains(refused(changed(16, 0x004E4942)), "the first chunk has type"));
    CHECK(contains(refused(changed(bin_offset(good), 0x7FFFFFFF)), "bytes, but"));
    CHECK(contains(refused(changed(bin_offset(good) + 4, 0x4E4F534A)), "a second JSON chunk"));
    // The BIN chunk gone, but still needed.
    CHECK(contains(refused(changed(bin_offset(good) + 4, 0x41525458)), "/buffers/0: no \"uri\""));
}

TEST_CASE("a file cut anywhere is refused or loads, but nothing else")
{
    const std::string good = GltfFixture::triangle().glb();
    for (std::size_t size = 0; size < good.size(); ++size) {
        const TempFolder folder;
        const Error error = load_error(folder.write("scene.glb", good.substr(0, size)));
        CAPTURE(size);
        CHECK(error.code() == ErrorCode::invalid_input);
    }
}

}  // namespace bdpt::test::glb_test
