#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <bdpt/io/part_file.h>
#include <bdpt/io/write_image.h>
#include <bdpt/render.h>

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "part/part_contents.h"
#include "scene_builder.h"
#include "scratch_folder.h"

namespace bdpt::io::id_files_test {
namespace {

using test::ScratchFolder;

/// Walls and a lamp, with names that JSON has to escape and one that is no UTF-8.
Scene named_box()
{
    test::SceneBuilder builder;
    builder.walls(test::lambertian(Rgb(0.7f)), test::plastic(Rgb(0.6f), 0.3f));
    builder.lamp(0.9f, 0.4f, Rgb(5.0f));
    builder.desc.instances[0].name = "a \"floor\"\\";
    builder.desc.instances[1].name = "w\xc3\xa4nde";
    builder.desc.instances[2].name = "\xff\xfe";
    builder.desc.materials[0].name = "wood";
    return Scene(std::move(builder.desc));
}

RenderResult part_of(SampleRange samples)
{
    RenderOptions o;
    o.integrator = IntegratorKind::pt;
    o.film.width = 17;
    o.film.height = 11;
    o.film.crop = PixelRect{.x0 = 3, .y0 = 2, .x1 = 15, .y1 = 10};
    o.film.aovs = {Aov::alpha, Aov::object, Aov::material, Aov::instance};
    o.transport.max_depth = 1;
    o.sampling.samples = samples;
    return render(named_box(), test::room_camera(), o);
}

PartNotes notes()
{
    PartNotes result;
    result.metadata.camera = test::room_camera();
    return result;
}

RenderResult read(const std::filesystem::path& file)
{
    RenderResult part;
    merge_part(part, read_part_info(file));
    return part;
}

ErrorCode code_of(const std::filesystem::path& file)
{
    try {
        static_cast<void>(read(file));
    } catch (const Error& error) {
        return error.code();
    }
    FAIL("no error for " << file);
    return ErrorCode::internal;
}

TEST_CASE("parts hold all ids with their counts and names", "[part][ids]")
{
    const ScratchFolder folder;
    const auto file = folder / "a.part.exr";
    const RenderResult whole = part_of({.begin = 0, .end = 9});
    REQUIRE(whole.ids.ranks()[0] >= 3);
    write_part(file, whole, notes(), OldPart::replace);
    const RenderResult again = read(file);
    CHECK(again.ids.ranks() == whole.ids.ranks());
    CHECK(again.ids.names()[1] == whole.ids.names()[1]);
    // The name that is no UTF-8 comes back as another one, with the id that pixels have.
    REQUIRE(again.ids.names()[0].size() == whole.ids.names()[0].size());
    for (std::size_t i = 0; i < whole.ids.names()[0].size(); ++i) {
        CHECK(again.ids.names()[0][i].id == whole.ids.names()[0][i].id);
    }
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(again.ids.develop(again.film)[i].values == whole.ids.develop(whole.film)[i].values);
    }
    // And so does a file of what was read.
    write_part(folder / "b.part.exr", again, notes(), OldPart::replace);
    CHECK(test::read_text(folder / "b.part.exr") == test::read_text(file));

    RenderResult sum;
    const std::vector<SampleRange> ranges{
        {.begin = 4, .end = 9}, {.begin = 0, .end = 1}, {.begin = 1, .end = 4}};
    for (const SampleRange& range : ranges) {
        write_part(file, part_of(range), notes(), OldPart::replace);
        merge_part(sum, read_part_info(file));
    }
    CHECK(sum.ids == again.ids);
}

TEST_CASE("a part whose ids lie is refused", "[part][ids]")
{
    const ScratchFolder folder;
    const auto file = folder / "b.part.exr";
    write_part(folder / "a.part.exr", part_of({.begin = 0, .end = 2}), notes(), OldPart::replace);
    const std::string sealed = test::read_text(folder / "a.part.exr");
    const std::string bytes = sealed.substr(0, sealed.size() - 40);
    const auto write_sealed = [&file](std::string_view text) {
        OutputFile output(file);
        output.write(text);
        seal(output, text.size());
        output.commit();
    };
    write_sealed(bytes);
    REQUIRE(test::read_text(file) == sealed);
    const std::string wood = std::to_string(static_cast<std::uint32_t>(name_id("wood")));
    const std::string ranks = R"({"ranks":2,"names":[["a )";
    const std::vector<std::pair<std::string, std::string>> lies{
        {R"("ids":[{)", R"("idz":[{)"},
        {ranks, R"({"ranks":3,"names":[["a )"},
        {ranks, R"({"ranks":1,"names":[["a )"},
        {ranks, R"({"rankS":2,"names":[["a )"},
        {R"(["wood",)" + wood, R"(["wood",)" + std::string(wood.size() - 1, ' ') + "0"},
        {R"(["wood",)" + wood, R"(["wood",)" + std::string(wood.size(), '1')},
        {"object.0.0", "object.9.0"},
    };
    for (const auto& [truth, lie] : lies) {
        CAPTURE(truth, lie);
        const std::size_t place = bytes.find(truth);
        REQUIRE(place != std::string::npos);
        REQUIRE(truth.size() == lie.size());
        write_sealed(std::string(bytes).replace(place, truth.size(), lie));
        CHECK(code_of(file) == ErrorCode::invalid_input);
    }
    // Whatever else it says is an error or harmless.
    std::mt19937 engine(7);
    for (int i = 0; i < 300; ++i) {
        std::string mutant = bytes;
        mutant[engine() % mutant.size()] = static_cast<char>(engine() % 256);
        write_sealed(mutant);
        try {
            const RenderResult part = read(file);
            static_cast<void>(part.ids.develop(part.film));
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::invalid_input);
        }
    }
}

TEST_CASE("images of ids have the metadata of Cryptomatte", "[ids]")
{
    const ScratchFolder folder;
    const auto file = folder / "a.exr";
    const RenderResult part = part_of({.begin = 0, .end = 2});
    ExrOptions options;
    options.type = ExrChannelType::half_float;
    options.manifests = part.ids.manifests();
    const std::vector<Layer> layers = part.ids.develop(part.film);
    write_exr(file, part.film.develop(), layers, options);
    const test::ExrFile exr = test::read_exr(file);
    for (const auto& [key, layer] : {std::pair<std::string, std::string>{"3ae39a5", "CryptoObject"},
                                     {"be359d6", "CryptoMaterial"}}) {
        CHECK(exr.text(("cryptomatte/" + key + "/name").c_str()) == layer);
        CHECK(exr.text(("cryptomatte/" + key + "/hash").c_str()) == "MurmurHash3_32");
        CHECK(exr.text(("cryptomatte/" + key + "/conversion").c_str()) == "uint32_to_float32");
        for (const char* channel : {"00.r", "01.g", "02.b", "02.a"}) {
            const Imf::Channel* found = exr.header.channels().findChannel(layer + channel);
            REQUIRE(found != nullptr);
            CHECK(found->type == Imf::FLOAT);
        }
    }
    const auto names = nlohmann::json::parse(exr.text("cryptomatte/3ae39a5/manifest"));
    CHECK(names.size() == part.ids.names()[0].size());
    CHECK(names.at("a \"floor\"\\") == hex_text(name_id("a \"floor\"\\")));
    CHECK(names.at("w\xc3\xa4nde") == hex_text(name_id("w\xc3\xa4nde")));
    CHECK(names.at("\xef\xbf\xbd\xef\xbf\xbd") == hex_text(name_id("\xff\xfe")));
    CHECK(nlohmann::json::parse(exr.text("cryptomatte/be359d6/manifest")).at("wood") ==
          hex_text(name_id("wood")));

    // Files without the layers say nothing about them.
    write_exr(file, part.film.develop(), {layers.data(), 3}, options);
    const test::ExrFile objects = test::read_exr(file);
    CHECK(objects.header.find("cryptomatte/3ae39a5/name") != objects.header.end());
    CHECK(objects.header.find("cryptomatte/be359d6/name") == objects.header.end());
}

}  // namespace
}  // namespace bdpt::io::id_files_test
