#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::scenes_test {
namespace {

using Words = std::vector<std::string>;

/// Scenes a.gltf and b.gltf, and one that is broken.
struct Scenes {
    Scenes()
    {
        write_cube(folder, "a", {});
        write_cube(folder, "b", {.material = emissive_material});
        write_text(folder / "broken.gltf", "{");
        std::filesystem::create_directory(folder / "out");
    }

    [[nodiscard]] Outcome render(const Words& words) const
    {
        Words all{"render", "--size", "8", "--spp", "1", "--integrator", "mis"};
        all.insert(all.end(), words.begin(), words.end());
        return run(Launch{.arguments = all, .folder = folder / ""});
    }
    [[nodiscard]] std::set<std::string> written() const
    {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
            names.insert(entry.path().filename().string());
        }
        return names;
    }

    ScratchFolder folder;
};

TEST_CASE("several scenes are rendered one after the other", "[scenes]")
{
    const Scenes scenes;
    const Outcome outcome = scenes.render({"a.gltf", "b.gltf", "-o", "out/{name}.png", "-o",
                                           "out/{name}.exr", "--stats", "out/{name}.json"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(scenes.written() ==
          std::set<std::string>{"a.exr", "a.json", "a.png", "b.exr", "b.json", "b.png"});
    // The same as each alone.
    REQUIRE(scenes.render({"b.gltf", "-o", "out/alone.exr"}).exit_code == 0);
    CHECK(read_exr(scenes.folder / "out" / "b.exr").image.pixels ==
          read_exr(scenes.folder / "out" / "alone.exr").image.pixels);
    CHECK(read_exr(scenes.folder / "out" / "a.exr").image.pixels !=
          read_exr(scenes.folder / "out" / "b.exr").image.pixels);
    REQUIRE(scenes.render({"a.gltf", "-o", "out/only-{name}.png"}).exit_code == 0);
    CHECK(scenes.written().contains("only-a.png"));
}

TEST_CASE("several scenes without outputs have their default ones", "[scenes]")
{
    const Scenes scenes;
    CHECK(scenes.render({"a.gltf", "b.gltf"}).exit_code == 0);
    CHECK(read_png(scenes.folder / "a.png").width == 8);
    CHECK(read_png(scenes.folder / "b.png").width == 8);
}

TEST_CASE("a scene that fails does not end the others", "[scenes]")
{
    const Scenes scenes;
    const Outcome outcome =
        scenes.render({"a.gltf", "broken.gltf", "none.gltf", "b.gltf", "-o", "out/{name}.png"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 4);  // that of the first failure
    CHECK(scenes.written() == std::set<std::string>{"a.png", "b.png"});
    CHECK(outcome.err.find("bdpt: error: broken.gltf: ") != std::string::npos);
    CHECK(outcome.err.find("bdpt: error: none.gltf: no such file") != std::string::npos);
    CHECK(outcome.err.ends_with("bdpt: 2 of 4 scenes failed\n"));
}

TEST_CASE("what two scenes would write is refused before anything is rendered", "[scenes]")
{
    const Scenes scenes;
    std::filesystem::create_directory(scenes.folder / "more");
    std::filesystem::copy(scenes.folder / "a.gltf", scenes.folder / "more" / "a.gltf");
    const auto refused = [&](const Words& words, const std::string& message) {
        const auto before = scenes.folder.names();
        const Outcome outcome = scenes.render(words);
        CAPTURE(words, outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find(message) != std::string::npos);
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
        CHECK(scenes.written().empty());
        CHECK(scenes.folder.names() == before);
    };
    refused({"a.gltf", "b.gltf", "-o", "out/x.png"}, "out/x.png: several scenes would write it");
    refused({"a.gltf", "more/a.gltf", "-o", "out/{name}.png"}, "out/a.png: several scenes");
    refused({"a.gltf", "a.gltf"}, "a.png: several scenes would write it");
    refused({"a.gltf", "b.gltf", "-o", "{name}.gltf"},
            "a.gltf: cannot be both an input and an output");
    refused({"a.gltf", "b.gltf", "--stats", "s.json"}, "s.json: several scenes would write it");
    refused({"a.gltf", "b.gltf", "-o", "-"}, "-: several scenes would write it");
    refused({"a.gltf", "-", "-o", "out/{name}.png"}, "-: only scene files");
    refused({"a.gltf", "job.json", "-o", "out/{name}.png"}, "job.json: only scene files");
    refused({"a.gltf", "b.gltf", "--part", "{name}.part.exr"}, "--part is for one scene");
    refused({"a.gltf", "b.gltf", "--save-job", "j.json"}, "--save-job is for one scene");
}

}  // namespace
}  // namespace bdpt::test::scenes_test
