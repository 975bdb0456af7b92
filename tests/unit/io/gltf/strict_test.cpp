#include "../gltf_fixture.h"
#include "catch.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bdpt::test::strict_test {
using namespace bdpt::io;
using nlohmann::json;

namespace {

/// A file whose picture is not all that it says.
struct Lossy {
    std::string place;  ///< in the warning or note
    std::function<void(GltfFixture&)> change;
    bool is_note = false;  ///< it is told as a note
};

void add_texture(GltfFixture& fixture, const json& texture, const json& image)
{
    fixture.json["images"] = json::array({image});
    fixture.json["textures"] = json::array({texture});
    fixture.json["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    fixture.json["meshes"][0]["primitives"][0]["material"] = 0;
}

void add_camera(GltfFixture& fixture, const json& camera)
{
    fixture.json["cameras"] = json::array({camera});
    fixture.json["nodes"][0]["camera"] = 0;
}

const std::vector<Lossy>& lossy_files()
{
    static const std::vector<Lossy> files{
        {"/images/0: \"gone.png\": no such file",
         [](GltfFixture& file) { add_texture(file, {{"source", 0}}, {{"uri", "gone.png"}}); }},
        {"/images/0",
         [](GltfFixture& file) { add_texture(file, {{"source", 0}}, {{"uri", "data:,text"}}); }},
        {"/textures/0 (EXT_texture_avif)",
         [](GltfFixture& file) {
             add_texture(file, {{"extensions", {{"EXT_texture_avif", {{"source", 0}}}}}},
                         {{"uri", "a.avif"}});
         }},
        {"/materials/0/pbrMetallicRoughness/baseColorTexture: texCoord 2",
         [](GltfFixture& file) {
             add_texture(file, {{"source", 0}}, {{"uri", "gone.png"}});
             file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 2;
         }},
        {"/extensionsUsed/0: extension MSFT_texture_dds",
         [](GltfFixture& file) { file.json["extensionsUsed"] = {"MSFT_texture_dds"}; }},
        {"/extensionsUsed/0: extension EXT_unheard_of",
         [](GltfFixture& file) { file.json["extensionsUsed"] = {"EXT_unheard_of"}; }},
        {"/extensionsUsed/0: extension KHR_materials_scatter is a draft",
         [](GltfFixture& file) { file.json["extensionsUsed"] = {"KHR_materials_scatter"}; }, true},
        {"/extensionsRequired/0: extension KHR_materials_volume_scatter is a draft",
         [](GltfFixture& file) {
             file.json["extensionsRequired"] = {"KHR_materials_volume_scatter"};
             file.json["extensionsUsed"] = {"KHR_materials_volume_scatter"};
         },
         true},
        {"/meshes/0/primitives/1: mode 0",
         [](GltfFixture& file) {
             file.json["meshes"][0]["primitives"].push_back(
                 {{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
         }},
        {"/cameras/0/perspective/yfov: 4",
         [](GltfFixture& file) {
             add_camera(file,
                        {{"type", "perspective"}, {"perspective", {{"yfov", 4}, {"znear", 1}}}});
         }},
    };
    return files;
}

}  // namespace

TEST_CASE("a strict load refuses files whose picture would lack something, or needs a draft")
{
    for (const Lossy& lossy : lossy_files()) {
        CAPTURE(lossy.place);
        GltfFixture fixture = GltfFixture::triangle();
        lossy.change(fixture);
        const LoadedScene loaded = fixture.load();
        CHECK(loaded.scene.instances.size() == 1);
        CHECK(warns(loaded.warnings, {lossy.place}) == !lossy.is_note);
        CHECK(warns(loaded.notes, {lossy.place}) == lossy.is_note);
        const Error error = fixture.error({.strict = true});
        CHECK(error.code() == ErrorCode::unsupported);
        CHECK(contains(error.what(), "scene.gltf: " + lossy.place));
        CHECK(contains(error.what(), "; --strict refuses this"));
        CHECK_FALSE(contains(error.what(), "more"));
    }
}

TEST_CASE("a strict load counts what else it refuses, but not what is harmless")
{
    GltfFixture fixture = GltfFixture::triangle();
    add_texture(fixture, {{"source", 0}}, {{"uri", "gone.png"}});
    fixture.json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 2;
    fixture.json["extensionsUsed"] = {"EXT_unheard_of", "KHR_materials_scatter"};
    const Error error = fixture.error({.strict = true});
    CHECK(contains(error.what(), "/extensionsUsed/0: extension EXT_unheard_of"));
    CHECK(contains(error.what(), "--strict refuses this, and 2 more"));
}

TEST_CASE("a strict load takes files that are merely odd")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["materials"] = {{{"pbrMetallicRoughness", {{"roughnessFactor", 2}}}}};
    fixture.json["meshes"][0]["primitives"][0]["material"] = 0;
    fixture.json["scenes"][0]["nodes"] = {0, 0};
    fixture.json["extensionsUsed"] = {"KHR_materials_ior", "FB_ngon_encoding"};
    const LoadedScene loaded = fixture.load({.strict = true});
    CHECK(loaded.warnings.size() == 2);
    CHECK(loaded.notes.empty());
}

TEST_CASE("a strict load refuses what --ignore-required would leave out")
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["extensionsRequired"] = {"EXT_unheard_of"};
    fixture.json["extensionsUsed"] = {"EXT_unheard_of"};
    CHECK(fixture.load({.ignore_required = true}).warnings.size() == 1);
    const Error error = fixture.error({.ignore_required = true, .strict = true});
    CHECK(error.code() == ErrorCode::unsupported);
    CHECK(contains(error.what(), "/extensionsRequired/0"));
}

}  // namespace bdpt::test::strict_test
