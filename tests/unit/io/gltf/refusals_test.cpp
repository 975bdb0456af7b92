#include "../gltf_fixture.h"
#include "catch.hpp"

#include <functional>
#include <string>

namespace bdpt::test::refusals_test {
using namespace bdpt::io;

namespace {

struct Refusal {
    std::string name;
    std::function<void(nlohmann::json&)> edit;  // of a sound triangle
    std::string message;                        // that must be part of the error's
    ErrorCode code = ErrorCode::invalid_input;
};

const std::vector<Refusal>& refusals()
{
    using Json = nlohmann::json;
    static const std::vector<Refusal> all{
        {"no asset", [](Json& j) { j.erase("asset"); }, "\"asset\" is missing"},
        {"no version", [](Json& j) { j["asset"].erase("version"); },
         "/asset: \"version\" is missing"},
        {"version 1", [](Json& j) { j["asset"]["version"] = "1.0"; },
         "/asset/version: glTF \"1.0\"", ErrorCode::unsupported},
        {"version is a number", [](Json& j) { j["asset"]["version"] = 2.0; },
         "/asset/version: must be a string, but is 2.0"},
        {"minimum version", [](Json& j) { j["asset"]["minVersion"] = "2.1"; },
         "/asset/minVersion: requires glTF \"2.1\"", ErrorCode::unsupported},
        {"required extension",
         [](Json& j) {
             j["extensionsRequired"] = {"KHR_materials_ior", "EXT_odd"};
         },
         "/extensionsRequired/1: the file requires \"EXT_odd\"", ErrorCode::unsupported},
        {"required extension that is merely known",
         [](Json& j) { j["extensionsRequired"] = {"EXT_texture_avif"}; }, "EXT_texture_avif",
         ErrorCode::unsupported},
        {"extension name", [](Json& j) { j["extensionsUsed"] = {1}; },
         "/extensionsUsed/0: must be a string, but is 1"},
        {"default scene", [](Json& j) { j["scene"] = 1; },
         "/scene: index 1, but the number of scenes is 1"},
        {"negative scene", [](Json& j) { j["scene"] = -1; },
         "/scene: must be a non-negative integer, but is -1"},
        {"scene node", [](Json& j) { j["scenes"][0]["nodes"] = {7}; },
         "/scenes/0/nodes/0: index 7, but the number of nodes is 1"},
        {"nodes no array", [](Json& j) { j["nodes"] = "none"; },
         "/nodes: must be an array, but is \"none\""},
        {"node no object", [](Json& j) { j["nodes"][0] = 5; },
         "/nodes/0: must be an object, but is 5"},
        {"child", [](Json& j) { j["nodes"][0]["children"] = {1}; },
         "/nodes/0/children/0: index 1, but the number of nodes is 1"},
        {"own child", [](Json& j) { j["nodes"][0]["children"] = {0}; }, "/nodes/0: a cycle"},
        {"mesh", [](Json& j) { j["nodes"][0]["mesh"] = 1; },
         "/nodes/0/mesh: index 1, but the number of meshes is 1"},
        {"mesh as text", [](Json& j) { j["nodes"][0]["mesh"] = "0"; },
         "/nodes/0/mesh: must be a non-negative integer, but is \"0\""},
        {"camera", [](Json& j) { j["nodes"][0]["camera"] = 0; },
         "/nodes/0/camera: index 0, but the number of cameras is 0"},
        {"skin", [](Json& j) { j["nodes"][0]["skin"] = 3; },
         "/nodes/0/skin: index 3, but the number of skins is 0"},
        {"short matrix",
         [](Json& j) {
             j["nodes"][0]["matrix"] = {1, 2, 3};
         },
         "/nodes/0/matrix: must be 16 numbers, but is an array of 3"},
        {"huge translation",
         [](Json& j) {
             j["nodes"][0]["translation"] = {0, 1e300, 0};
         },
         "/nodes/0/translation/1: must be a finite single-precision number, but is 1e+300"},
        {"text in a scale",
         [](Json& j) {
             j["nodes"][0]["scale"] = {1, "2", 3};
         },
         "/nodes/0/scale/1: must be a number, but is \"2\""},
        {"null in a rotation",
         [](Json& j) {
             j["nodes"][0]["rotation"] = {0, 0, nullptr, 1};
         },
         "/nodes/0/rotation/2: must be a number, but is null"},
        {"no primitives", [](Json& j) { j["meshes"][0].erase("primitives"); },
         "/meshes/0: \"primitives\" is missing"},
        {"no attributes", [](Json& j) { j["meshes"][0]["primitives"][0].erase("attributes"); },
         "/meshes/0/primitives/0: \"attributes\" is missing"},
        {"attribute",
         [](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 2; },
         "/meshes/0/primitives/0/attributes/POSITION: index 2, but the number of accessors is 2"},
        {"attribute name",
         [](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["a/b~c"] = 2; },
         "/meshes/0/primitives/0/attributes/a~1b~0c: index 2"},
        {"indices", [](Json& j) { j["meshes"][0]["primitives"][0]["indices"] = 9; },
         "/meshes/0/primitives/0/indices: index 9, but the number of accessors is 2"},
        {"material", [](Json& j) { j["meshes"][0]["primitives"][0]["material"] = 0; },
         "/meshes/0/primitives/0/material: index 0, but the number of materials is 0"},
        {"mode", [](Json& j) { j["meshes"][0]["primitives"][0]["mode"] = 7; },
         "/meshes/0/primitives/0/mode: 7 is not a primitive mode"},
        {"mode beyond int", [](Json& j) { j["meshes"][0]["primitives"][0]["mode"] = 4294967300; },
         "/meshes/0/primitives/0/mode: 4294967300 is out of range"},
        {"indices of the wrong type", [](Json& j) { j["accessors"][1]["componentType"] = 5122; },
         "/accessors/1/componentType: 5122, but indices are 5121, 5123 or 5125"},
        {"positions of the wrong type", [](Json& j) { j["accessors"][0]["type"] = "VEC2"; },
         "/accessors/0/type: must be VEC3"},
        {"component type", [](Json& j) { j["accessors"][0]["componentType"] = 5130; },
         "/accessors/0/componentType: 5130 is not a component type"},
        {"accessor type", [](Json& j) { j["accessors"][0]["type"] = "VEC5"; },
         "/accessors/0/type: \"VEC5\" is not an accessor type"},
        {"count missing", [](Json& j) { j["accessors"][0].erase("count"); },
         "/accessors/0: \"count\" is missing"},
        {"count zero", [](Json& j) { j["accessors"][0]["count"] = 0; },
         "/accessors/0/count: 0, but must be at least 1"},
        {"count is a fraction", [](Json& j) { j["accessors"][0]["count"] = 3.5; },
         "/accessors/0/count: must be a non-negative integer, but is 3.5"},
        {"count beyond the view", [](Json& j) { j["accessors"][0]["count"] = 4; },
         "/accessors/0: 4 elements need 48 B at byte 0, but bufferView 0 has 36 bytes"},
        {"count beyond memory",
         [](Json& j) {
             j["accessors"][0]["count"] = 4000000000000;
             j["accessors"][0].erase("bufferView");
         },
         "/accessors/0/count: 4000000000000 elements need 48 TB"},
        {"count beyond 64 bits",
         [](Json& j) { j["accessors"][0]["count"] = 18446744073709551615u; },
         "/accessors/0/count: 18446744073709551615 elements need 221 EB"},
        {"accessor offset", [](Json& j) { j["accessors"][0]["byteOffset"] = 4; },
         "/accessors/0: 3 elements need 36 B at byte 4"},
        {"accessor offset beyond 64 bits",
         [](Json& j) { j["accessors"][0]["byteOffset"] = 18446744073709551612u; },
         "/accessors/0: 3 elements need 36 B at byte 18446744073709551612"},
        {"accessor view", [](Json& j) { j["accessors"][0]["bufferView"] = 2; },
         "/accessors/0/bufferView: index 2, but the number of bufferViews is 2"},
        {"stride below the element", [](Json& j) { j["bufferViews"][0]["byteStride"] = 8; },
         "/accessors/0: elements of 12 bytes overlap: bufferView 0 has stride 8"},
        {"stride beyond the view", [](Json& j) { j["bufferViews"][0]["byteStride"] = 16; },
         "/accessors/0: 3 elements need 44 B"},
        {"stride not of 4", [](Json& j) { j["bufferViews"][0]["byteStride"] = 13; },
         "/bufferViews/0/byteStride: 13, but must be a multiple of 4 up to 252"},
        {"view beyond the buffer", [](Json& j) { j["bufferViews"][1]["byteLength"] = 7; },
         "/bufferViews/1: 7 bytes at byte 36, but buffer 0 has 42 bytes"},
        {"view offset beyond 64 bits",
         [](Json& j) { j["bufferViews"][1]["byteOffset"] = 18446744073709551615u; },
         "/bufferViews/1: 6 bytes at byte 18446744073709551615"},
        {"view buffer", [](Json& j) { j["bufferViews"][0]["buffer"] = 1; },
         "/bufferViews/0/buffer: index 1, but the number of buffers is 1"},
        {"buffer length", [](Json& j) { j["buffers"][0]["byteLength"] = 43; },
         "/buffers/0/byteLength: 43 bytes, but there are 42"},
        {"buffer length beyond all",
         [](Json& j) { j["buffers"][0]["byteLength"] = 9223372036854775807; },
         "/buffers/0/byteLength: 9223372036854775807 bytes, but the limit"},
        {"buffer without a uri", [](Json& j) { j["buffers"][0].erase("uri"); },
         "/buffers/0: no \"uri\""},
        {"sparse count",
         [](Json& j) {
             j["accessors"][0]["sparse"] = {
                 {"count", 4},
                 {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                 {"values", {{"bufferView", 0}}}};
         },
         "/accessors/0/sparse/count: 4, but the accessor has 3 elements"},
        {"sparse indices",
         [](Json& j) {
             j["accessors"][0]["sparse"] = {
                 {"count", 3},
                 {"indices", {{"bufferView", 1}, {"componentType", 5125}}},
                 {"values", {{"bufferView", 0}}}};
         },
         "/accessors/0/sparse/indices: 3 elements need 12 B at byte 0, but bufferView 1 has 6"},
        {"sparse values",
         [](Json& j) {
             j["accessors"][0]["sparse"] = {
                 {"count", 3},
                 {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                 {"values", {{"bufferView", 0}, {"byteOffset", 1}}}};
         },
         "/accessors/0/sparse/values: 3 elements need 36 B at byte 1"},
        {"texture image",
         [](Json& j) {
             j["textures"] = {{{"source", 0}}};
             j["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
         },
         "/textures/0/source: index 0, but the number of images is 0"},
        {"texture sampler",
         [](Json& j) {
             j["textures"] = {{{"sampler", 0}}};
             j["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
         },
         "/textures/0/sampler: index 0, but the number of samplers is 0"},
        {"image with two sources",
         [](Json& j) {
             j["images"] = {{{"uri", "a.png"}, {"bufferView", 0}}};
         },
         "/images/0: both \"uri\" and \"bufferView\""},
        {"image view",
         [](Json& j) {
             j["images"] = {{{"bufferView", 2}}};
         },
         "/images/0/bufferView: index 2, but the number of bufferViews is 2"},
        {"camera type",
         [](Json& j) {
             j["cameras"] = {{{"type", "fisheye"}}};
         },
         "/cameras/0/type: \"fisheye\" is not a type of camera"},
        {"camera without values",
         [](Json& j) {
             j["cameras"] = {{{"type", "perspective"}}};
         },
         "/cameras/0: \"perspective\" is missing"},
    };
    return all;
}

std::string json_error(const std::string& text, const GltfOptions& options = {})
{
    const TempFolder folder;
    const Error error = load_error(folder.write("scene.gltf", text), options);
    CHECK(error.code() == ErrorCode::invalid_input);
    return error.what();
}

}  // namespace

TEST_CASE("what is unsafe or ambiguous is refused by place and value")
{
    for (const Refusal& refusal : refusals()) {
        GltfFixture fixture = GltfFixture::triangle();
        fixture.json = nlohmann::json::parse(fixture.text());
        refusal.edit(fixture.json);
        const Error error = fixture.error();
        CAPTURE(refusal.name, error.what());
        CHECK(error.code() == refusal.code);
        CHECK(contains(error.what(), "scene.gltf: "));
        CHECK(contains(error.what(), refusal.message));
        CHECK_FALSE(contains(error.what(), "\n"));
    }
}

TEST_CASE("the triangle that those changes break is sound itself")
{
    CHECK(std::string(GltfFixture::triangle().error().what()).empty());
}

TEST_CASE("broken JSON is refused")
{
    CHECK(contains(json_error("{\"asset\":{\"version\":\"2.0\"}"),
                   "JSON: ends in the middle, after 26 bytes: it was cut off"));
    CHECK(contains(json_error("{\"asset\":{\"version\":\"2."), "JSON: ends in the middle"));
    CHECK(contains(json_error("{\"asset\":{\"version\":\"2.0\"}} x"),
                   "JSON: byte 29: line 1, column 29: invalid literal"));
    CHECK(contains(json_error("{\"asset\":{\"version\":1e999}}"), "JSON"));
    CHECK(contains(json_error("{\"asset\":{\"version\":\"\xff\"}}"), "JSON"));
    CHECK(contains(json_error("[]"), "must be a JSON object"));
    CHECK(contains(json_error("{\"scene\":0,\"scene\":1}"), "\"scene\" occurs twice"));
}

TEST_CASE("a file of another kind is called by its name")
{
    const std::pair<std::string, std::string> kinds[] = {
        {"", "not a glTF file but an empty file"},
        {" \n\t", "a file of white space"},
        {std::string(64, '\0'), "a file that starts with zeros"},
        {"\x89PNG\r\n\x1a\n", "not a glTF file but a PNG image"},
        {"\xff\xd8\xff\xe0", "a JPEG image"},
        {"\n<!DOCTYPE HTML>\n<html>", "an HTML page"},
        {"\xef\xbb\xbf<html lang=\"en\">", "an HTML page"},
        {"<svg/>", "an HTML or XML file"},
        {"version https://git-lfs.github.com/spec/v1\n", "a Git LFS pointer"},
        {"PK\x03\x04", "a ZIP archive"},
    };
    for (const auto& [bytes, name] : kinds) {
        CAPTURE(name);
        CHECK(contains(json_error(bytes), name));
    }
    CHECK(contains(json_error("solid cube\n"), "an STL file: export it as .glb first"));
    CHECK(contains(json_error("# Read me\n"),
                   "not a glTF file but another kind of file: expected .gltf"));
    CHECK(contains(json_error("glTF"), "GLB: truncated"));
}

TEST_CASE("a broken texture that no material uses costs nothing but a warning")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["images"] = {{{"uri", "missing.png"}}};
    fixture.json["textures"] = {{{"source", 0}},
                                {{"source", 7}},
                                {{"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}},
                                {{"sampler", 0}}};
    fixture.json["materials"] = {{{"emissiveTexture", {{"index", 0}}}}};
    const LoadedScene loaded = fixture.load();
    CHECK(loaded.scene.instances.size() == 1);
    REQUIRE(loaded.warnings.size() == 1);
    CHECK(warns(loaded.warnings, {"a broken texture that no material uses is left out",
                                  "/textures/1/source: index 7, but the number of images is 1"}));
    // One that is used is still refused, wherever the material names it.
    fixture.json["materials"][0]["extensions"]["KHR_materials_sheen"]["sheenColorTexture"] = {
        {"index", 3}};
    CHECK(contains(fixture.error().what(),
                   "/textures/3/sampler: index 0, but the number of samplers is 0"));
}

TEST_CASE("deep, rich and long JSON is refused")
{
    CHECK(contains(json_error("{\"asset\":{\"version\":\"2.0\"},\"extras\":" +
                              std::string(200000, '[') + std::string(200000, ']') + "}"),
                   "JSON: nested deeper than 64"));
    // The root is one of them.
    const auto nested = [](std::size_t depth) {
        return "{\"asset\":{\"version\":\"2.0\"},\"extras\":" + std::string(depth - 1, '[') +
               std::string(depth - 1, ']') + "}";
    };
    const TempFolder folder;
    CHECK(std::string(load_error(folder.write("scene.gltf", nested(64))).what()).empty());
    CHECK(contains(json_error(nested(65)), "deeper than 64"));

    GltfOptions options;
    options.limits.json_values = 10;
    CHECK(contains(json_error(GltfFixture::triangle().text(), options), "more than 10 values"));
    options = {};
    options.limits.json_bytes = 20;
    CHECK(contains(json_error(GltfFixture::triangle().text(), options), "but the limit is 20"));
}

TEST_CASE("node graphs that are no forest are refused")
{
    const auto error_of = [](const nlohmann::json& nodes, const GltfOptions& options = {}) {
        GltfFixture fixture = GltfFixture::triangle();
        fixture.json["nodes"] = nodes;
        const Error error = fixture.error(options);
        CHECK(error.code() == ErrorCode::invalid_input);
        return std::string(error.what());
    };
    CHECK(contains(error_of({{{"children", {1}}}, {{"children", {2}}}, {{"children", {1}}}}),
                   "/nodes/2/children/0: node 1 is a child of node 0 already"));
    CHECK(contains(error_of({{{"children", {1, 1}}}, nlohmann::json::object()}),
                   "/nodes/0/children/1: node 1 is a child of node 0 already"));
    CHECK(contains(error_of({nlohmann::json::object(), {{"children", {2}}}, {{"children", {1}}}}),
                   "/nodes/1: a cycle"));

    nlohmann::json chain;
    for (int i = 1; i <= 513; ++i) {
        chain.push_back({{"children", {i}}});
    }
    chain[512].erase("children");
    CHECK(contains(error_of(chain), "/nodes/512: nested deeper than 512 nodes"));
    GltfOptions options;
    options.limits.node_depth = 513;
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["nodes"] = chain;
    CHECK(std::string(fixture.error(options).what()).empty());
    options.limits.nodes = 512;
    CHECK(contains(error_of(chain, options), "/nodes: 513 nodes, but the limit is 512"));
}

TEST_CASE("scenes beyond the limits are refused")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.add_mesh_node({{"attributes", {{"POSITION", 0}}}});
    GltfOptions options;
    options.limits.triangles = 1;
    CHECK(contains(fixture.error(options).what(), "/meshes/1/primitives/0: more than 1 triangles"));
    options = {};
    options.limits.instances = 1;
    CHECK(contains(fixture.error(options).what(), "/nodes: more than 1 instances"));
    options = {};
    options.limits.buffer_bytes = 41;
    CHECK(contains(fixture.error(options).what(), "/buffers/0/byteLength: 42 bytes"));
}

TEST_CASE("a world transform that overflows is refused")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["nodes"] = {{{"children", {1}}, {"scale", {1e30, 1, 1}}},
                             {{"mesh", 0}, {"scale", {1e30, 1, 1}}}};
    const Error error = fixture.error();
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(error.what(), "/nodes/1: the transform to world space is not finite"));
}

}  // namespace bdpt::test::refusals_test
