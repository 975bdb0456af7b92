#include "../gltf_fixture.h"
#include "catch.hpp"
#include "gltf/compression/compression.h"

#include <bdpt/scene_desc.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

namespace bdpt::test::compressed_test {
using namespace bdpt::io;

namespace {

using nlohmann::json;

const std::filesystem::path data_folder =
    std::filesystem::path(BDPT_SOURCE_DIR) / "tests" / "data" / "compressed";

struct Corner {
    Vec3 position;
    Vec3 normal;
    Vec2 uv;
    Vec4 color;
    [[nodiscard]] bool operator==(const Corner&) const = default;
};

/// Triangles in world space, in any order.
std::vector<std::array<Corner, 3>> triangles_of(const LoadedScene& loaded)
{
    std::vector<std::array<Corner, 3>> triangles;
    for (const InstanceDesc& instance : loaded.scene.instances) {
        const MeshDesc& mesh = loaded.scene.meshes.at(static_cast<std::size_t>(instance.mesh));
        const Mat3 normal_matrix = glm::transpose(glm::inverse(Mat3(instance.world_from_object)));
        for (const UVec3& triangle : mesh.triangles) {
            std::array<Corner, 3> corners;
            for (int c = 0; c < 3; ++c) {
                const std::size_t v = triangle[c];
                corners[static_cast<std::size_t>(c)] = {
                    Vec3(instance.world_from_object * Vec4(mesh.positions[v], 1.0f)),
                    glm::normalize(normal_matrix * mesh.normals.at(v)), mesh.uvs[0].at(v),
                    mesh.colors.at(v)};
            }
            triangles.push_back(corners);
        }
    }
    return triangles;
}

Vec3 centre(const std::array<Corner, 3>& t)
{
    return (t[0].position + t[1].position + t[2].position) / 3.0f;
}

Vec3 face(const std::array<Corner, 3>& t)
{
    return glm::cross(t[1].position - t[0].position, t[2].position - t[0].position);
}

/// Compares triangle by triangle; positions may be off by `tolerance` metres.
void check_equal(const LoadedScene& plain, const LoadedScene& packed, float tolerance)
{
    const auto expected = triangles_of(plain);
    const auto found = triangles_of(packed);
    REQUIRE(found.size() == expected.size());
    std::vector<bool> taken(expected.size(), false);
    std::size_t wrong = 0;
    for (const auto& triangle : found) {
        std::size_t nearest = 0;
        for (std::size_t i = 1; i < expected.size(); ++i) {
            if (glm::distance(centre(expected[i]), centre(triangle)) <
                glm::distance(centre(expected[nearest]), centre(triangle))) {
                nearest = i;
            }
        }
        bool same = !taken[nearest] && glm::dot(face(triangle), face(expected[nearest])) > 0.0f;
        taken[nearest] = true;
        for (const Corner& corner : triangle) {
            const auto matches = [&](const Corner& other) {
                return glm::distance(corner.position, other.position) < tolerance &&
                       glm::distance(corner.normal, other.normal) < 0.02f &&
                       glm::distance(corner.uv, other.uv) < 0.002f &&
                       glm::distance(corner.color, other.color) < 0.01f;
            };
            const auto& others = expected[nearest];
            same = same && std::any_of(others.begin(), others.end(), matches);
        }
        wrong += same ? 0 : 1;
    }
    CHECK(wrong == 0);
}

bool can_read(const std::string& name)
{
    const bool possible =
        (!contains(name, "draco") || has_draco()) && (!contains(name, "meshopt") || has_meshopt());
    if (!possible) {
        WARN("skipped: this build cannot read " << name);
    }
    return possible;
}

std::string read_text(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// A GLB in its parts.
struct Glb {
    json document;
    std::string bin;

    explicit Glb(const std::string& name)
    {
        const std::string bytes = read_text(data_folder / name);
        REQUIRE(bytes.size() > 20);
        std::uint32_t length = 0;
        std::memcpy(&length, bytes.data() + 12, sizeof length);
        document = json::parse(bytes.substr(20, length));
        bin = bytes.substr(20 + length + 8);
    }

    [[nodiscard]] std::string bytes() const
    {
        GltfFixture fixture;
        fixture.json = document;
        fixture.bin = bin;
        return fixture.glb();
    }

    [[nodiscard]] LoadedScene load() const
    {
        const TempFolder folder;
        return load_gltf(folder.write("scene.glb", bytes()));
    }

    [[nodiscard]] Error error() const
    {
        const TempFolder folder;
        return load_error(folder.write("scene.glb", bytes()));
    }
};

json& draco_of(Glb& glb)
{
    return glb.document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
}

/// The byte `i` of the Draco data.
char& draco_byte(Glb& glb, std::size_t i)
{
    const auto view = draco_of(glb)["bufferView"].get<std::size_t>();
    return glb.bin.at(glb.document["bufferViews"][view].value("byteOffset", std::size_t{0}) + i);
}

/// The first compressed view with this mode.
json& view_of(Glb& glb, const std::string& mode)
{
    for (json& view : glb.document["bufferViews"]) {
        if (view["extensions"]["EXT_meshopt_compression"]["mode"] == mode) {
            return view;
        }
    }
    throw std::runtime_error("no view with mode " + mode);
}

json& meshopt_of(Glb& glb, const std::string& mode)
{
    return view_of(glb, mode)["extensions"]["EXT_meshopt_compression"];
}

}  // namespace

TEST_CASE("compressed meshes are equal to the plain one, at rest and in motion")
{
    for (const char* name : {"wave-draco.glb", "wave-draco-sequential.glb", "wave-meshopt.glb",
                             "wave-meshopt-medium.glb", "wave-quantized.glb"}) {
        CAPTURE(name);
        if (!can_read(name)) {
            continue;
        }
        for (const std::optional<double> time : {std::optional<double>(), std::optional(0.6)}) {
            const LoadedScene packed = load_gltf(data_folder / name, {.time = time});
            check_equal(load_gltf(data_folder / "wave.glb", {.time = time}), packed, 0.002f);
            CHECK(packed.warnings.empty());
        }
    }
}

TEST_CASE("KHR_meshopt_compression is read like EXT_meshopt_compression")
{
    if (!can_read("meshopt")) {
        return;
    }
    Glb glb("wave-meshopt.glb");
    std::string text = glb.document.dump();
    for (std::size_t at = text.find("EXT_meshopt"); at != std::string::npos;
         at = text.find("EXT_meshopt")) {
        text.replace(at, 3, "KHR");
    }
    glb.document = json::parse(text);
    check_equal(load_gltf(data_folder / "wave.glb"), glb.load(), 0.002f);
}

TEST_CASE("a fallback buffer is not read where its views are compressed")
{
    if (!can_read("meshopt")) {
        return;
    }
    Glb glb("wave-meshopt.glb");
    for (json& buffer : glb.document["buffers"]) {
        buffer.erase("extensions");  // Nobody has to say that it is one.
    }
    glb.document["buffers"][1]["uri"] = "not-there.bin";
    CHECK(glb.load().scene.meshes.size() == 1);
    // But one that a plain view uses as well is.
    glb.document["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 1}});
    CHECK(glb.error().code() == ErrorCode::not_found);
}

TEST_CASE("primitives may share their Draco data")
{
    if (!can_read("draco")) {
        return;
    }
    Glb glb("wave-draco.glb");
    json& primitives = glb.document["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[1]["mode"] = 5;  // The data holds triangles, whatever their order was.
    const LoadedScene loaded = glb.load();
    REQUIRE(loaded.scene.meshes.size() == 2);
    CHECK(loaded.scene.meshes[0].triangles == loaded.scene.meshes[1].triangles);
    CHECK(loaded.scene.meshes[0].positions == loaded.scene.meshes[1].positions);
}

TEST_CASE("broken descriptions of compressed data are refused by name")
{
    struct Case {
        const char* file;
        std::function<void(Glb&)> edit;
        const char* text;
        ErrorCode code = ErrorCode::invalid_input;
    };
    const char* const meshopt = "wave-meshopt.glb";
    const char* const draco = "wave-draco.glb";
    const std::vector<Case> cases{
        {meshopt, [](Glb& g) { meshopt_of(g, "ATTRIBUTES")["byteLength"] = 1u << 30; },
         "/extensions/EXT_meshopt_compression: 1073741824 bytes at byte"},
        {meshopt,
         [](Glb& g) {
             meshopt_of(g, "ATTRIBUTES")["byteOffset"] = std::numeric_limits<std::uint64_t>::max();
         },
         "bytes at byte 18446744073709551615, but buffer 0 has"},
        {meshopt, [](Glb& g) { meshopt_of(g, "ATTRIBUTES")["count"] = 1; },
         "/count: 1 elements of"},
        {meshopt,
         [](Glb& g) {
             meshopt_of(g, "ATTRIBUTES")["count"] = std::numeric_limits<std::uint64_t>::max();
         },
         "but the limit for all buffers is"},
        {meshopt, [](Glb& g) { meshopt_of(g, "ATTRIBUTES")["count"] = 1'000'000'000 / 16; },
         "more than 1000 times packed"},
        {meshopt, [](Glb& g) { meshopt_of(g, "ATTRIBUTES")["byteStride"] = 260; },
         "/byteStride: 260 does not fit"},
        {meshopt, [](Glb& g) { meshopt_of(g, "TRIANGLES")["byteStride"] = 3; },
         "/byteStride: 3 does not fit"},
        {meshopt, [](Glb& g) { meshopt_of(g, "TRIANGLES")["count"] = 577; },
         "/count: 577 is not a multiple of 3"},
        {meshopt, [](Glb& g) { meshopt_of(g, "TRIANGLES")["filter"] = "OCTAHEDRAL"; },
         "/filter: filters need the mode ATTRIBUTES"},
        {meshopt, [](Glb& g) { meshopt_of(g, "TRIANGLES")["mode"] = "STRIPS"; },
         "/mode: \"STRIPS\" is not a mode"},
        {meshopt, [](Glb& g) { meshopt_of(g, "ATTRIBUTES")["filter"] = "COLOR"; },
         "/filter: the filter \"COLOR\" is not supported", ErrorCode::unsupported},
        {meshopt, [](Glb& g) { meshopt_of(g, "ATTRIBUTES")["filter"] = "BLUR"; },
         "/filter: \"BLUR\" is not a filter"},
        {meshopt, [](Glb& g) { meshopt_of(g, "TRIANGLES").erase("count"); },
         "\"count\" is missing"},
        {meshopt, [](Glb& g) { meshopt_of(g, "TRIANGLES")["buffer"] = 5; }, "/buffer: index 5"},
        {meshopt, [](Glb& g) { meshopt_of(g, "TRIANGLES")["byteLength"] = 7; },
         "/extensions/EXT_meshopt_compression: the data is not a meshopt stream"},
        {draco, [](Glb& g) { draco_of(g)["bufferView"] = 99; },
         "/KHR_draco_mesh_compression/bufferView: index 99"},
        {draco, [](Glb& g) { draco_of(g).erase("attributes"); }, "\"attributes\" is missing"},
        {draco, [](Glb& g) { draco_of(g)["attributes"]["POSITION"] = 77; },
         "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: Draco: there is no "
         "attribute 77"},
        {draco, [](Glb& g) { draco_of(g)["attributes"]["POSITION"] = 1ull << 40; },
         "/attributes/POSITION: 1099511627776 is not an attribute id"},
        {draco, [](Glb& g) { draco_of(g)["attributes"]["POSITION"] = "a"; },
         "/attributes/POSITION: must be a non-negative integer"},
        {draco, [](Glb& g) { g.document["meshes"][0]["primitives"][0]["mode"] = 0; },
         "/meshes/0/primitives/0/mode: 0, but Draco holds triangles"},
        {draco, [](Glb& g) { draco_byte(g, 0) = 'X'; }, "do not begin like Draco data"},
        {draco, [](Glb& g) { draco_byte(g, 6) = 9; }, "bitstream 2.9; only 2.2",
         ErrorCode::unsupported},
        {draco, [](Glb& g) { draco_byte(g, 7) = 0; }, "the data is not a mesh"},
        // The number of faces of an edgebreaker mesh, of seven bits a byte.
        {draco,
         [](Glb& g) {
             constexpr char digits[] = "\xff\xff\xff\xff\x0f\xff\xff\xff\xff\x0f";
             std::memcpy(&draco_byte(g, 12), digits, 10);
         },
         "4294967295 elements become"},
    };
    for (const Case& one : cases) {
        CAPTURE(one.file, one.text);
        if (!can_read(one.file)) {
            continue;
        }
        Glb glb(one.file);
        one.edit(glb);
        const Error error = glb.error();
        CAPTURE(error.what());
        CHECK(error.code() == one.code);
        CHECK(contains(error.what(), one.text));
    }
}

TEST_CASE("any changed byte of compressed data is an error or a mesh, mostly another one", "[long]")
{
    for (const char* name : {"wave-draco.glb", "wave-draco-sequential.glb", "wave-meshopt.glb"}) {
        CAPTURE(name);
        if (!can_read(name)) {
            continue;
        }
        const Glb sound(name);
        const TempFolder folder;
        const auto expected = triangles_of(sound.load());
        std::size_t refused = 0;
        std::size_t equal = 0;
        for (std::size_t i = 0; i < sound.bin.size(); ++i) {
            CAPTURE(i);
            Glb broken = sound;
            broken.bin[i] = static_cast<char>(broken.bin[i] ^ (1 << (i % 8)));
            const std::filesystem::path file = folder.write("broken.glb", broken.bytes());
            try {
                equal += triangles_of(load_gltf(file)) == expected ? 1U : 0U;
            } catch (const Error& error) {
                ++refused;
                if (error.code() == ErrorCode::out_of_memory ||
                    error.code() == ErrorCode::internal || contains(error.what(), "\n")) {
                    FAIL_CHECK(error.what());
                }
            }
        }
        CHECK(refused > 0);
        CAPTURE(equal, refused);  // some bytes are padding, or of what moves only
        CHECK(sound.bin.size() - refused - equal > sound.bin.size() / 3);
    }
}

TEST_CASE("a build without a decoder says so")
{
    const auto check = [](const char* name, const char* library, bool here) {
        CAPTURE(name);
        Glb glb(name);
        const Error required = glb.error();
        glb.document.erase("extensionsRequired");
        const Error used = glb.error();
        if (here) {
            CHECK(std::string(required.what()).empty());
            CHECK(std::string(used.what()).empty());
            return;
        }
        CHECK(required.code() == ErrorCode::unsupported);
        CHECK(contains(required.what(), "_compression\", which this build cannot decode"));
        CHECK(used.code() == ErrorCode::unsupported);
        CHECK(contains(used.what(), std::string("this build of bdpt has no ") + library));
    };
    check("wave-draco.glb", "Draco", has_draco());
    check("wave-meshopt.glb", "meshoptimizer", has_meshopt());
}

TEST_CASE("truncated compressed data is refused")
{
    for (const char* name : {"wave-draco.glb", "wave-draco-sequential.glb"}) {
        if (!can_read(name)) {
            continue;
        }
        Glb glb(name);
        json& view = glb.document["bufferViews"][draco_of(glb)["bufferView"].get<std::size_t>()];
        const auto whole = view["byteLength"].get<std::size_t>();
        for (std::size_t length = 1; length < whole; length += 3) {
            CAPTURE(name, length);
            view["byteLength"] = length;
            CHECK(glb.error().code() == ErrorCode::invalid_input);
        }
    }
}

}  // namespace bdpt::test::compressed_test
