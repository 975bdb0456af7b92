#include <bdpt/io/write_image.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::scene_choice_test {
namespace {

/// A cube with two variants, the second of which shines.
std::string with_variants(const ScratchFolder& folder)
{
    const std::string more = R"("extensionsUsed": ["KHR_materials_variants"],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "day"}, {"name": "night"}]}},)";
    return write_cube(folder, "variants", {.cameras = two_cameras, .more = more}).string();
}

TEST_CASE("a variant, an animation or a time that there is not is refused")
{
    const ScratchFolder folder;
    const std::string scene = with_variants(folder);
    const std::string out = (folder / "out.exr").string();
    const auto check = [&](const std::vector<std::string>& words, int code,
                           const std::string& text) {
        std::vector<std::string> all{"render", scene, "-o", out};
        all.insert(all.end(), words.begin(), words.end());
        const Outcome outcome = run(all);
        CAPTURE(words, outcome.err);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.err.find(text) != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(out));
    };
    check({"--variant", "dusk"}, 3,
          "no variant \"dusk\"; the file has 2 variants: 0 \"day\", 1 \"night\"");
    check({"--animation", "run"}, 3, "no animation \"run\"; the file has no animations");
    check({"--frame-time", "nan"}, 2, "--frame-time");
    check({"--frame-time", "soon"}, 2, "--frame-time");
    check({"--max-memory", "much"}, 2, "--max-memory");
    check({"--max-memory", "1K"}, 4, "of memory, but the limit is 1.02 kB (--max-memory)");
    check({"--texture-filter", "nearest"}, 2, "--texture-filter");
    for (const char* shutter :
         {"-1", "nan", "inf", "0.1s", "", "0.2,0.1", "0.1,", ",0.1", "1,2,3"}) {
        check({std::string("--shutter=") + shutter}, 2, "--shutter");
    }
}

bool holds(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST_CASE("all commands refuse what --strict forbids, and jobs have it")
{
    const ScratchFolder folder;
    const std::string material = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})";
    const std::string more = R"("textures": [{"source": 0}], "images": [{"uri": "gone.png"}],
        "extensionsUsed": ["KHR_materials_scatter"],)";
    const std::string scene =
        write_cube(folder, "cube", {.material = material, .cameras = two_cameras, .more = more})
            .string();
    const std::string out = (folder / "out.exr").string();
    const std::vector<std::string> render{"render", scene, "-o",           out, "--spp", "1",
                                          "--size", "8x8", "--integrator", "pt"};
    const Outcome lenient = run(render);
    CAPTURE(lenient.err);
    CHECK(lenient.exit_code == 0);
    CHECK(holds(lenient.err, "warning: " + scene + ": /images/0: \"gone.png\": no such file"));
    CHECK(holds(lenient.err, "bdpt: " + scene +
                                 ": /extensionsUsed/0: extension KHR_materials_scatter is a "
                                 "draft, which may change"));
    std::filesystem::remove(out);
    const std::string job = (folder / "job.json").string();
    std::ofstream(job) << R"({"bdpt_job": 1, "file": "cube.gltf", "strict": true})";
    std::vector<std::string> strict = render;
    strict.emplace_back("--strict");
    for (const std::vector<std::string>& words :
         {strict,
          {"render", job, "-o", out, "--spp", "1"},
          {"info", scene, "--strict"},
          {"info", scene, "--strict", "--json"},
          {"verify", scene, "--strict"},
          {"inspect", scene, "--strict", "--pixel", "1,1"},
          {"plan", scene, "--strict", "-o", out, "--spp", "8", "--parts", "2", "--for", "make",
           "-d", (folder / "plan").string()},
          {"bench", scene, "--strict", "-o", (folder / "bench").string()}}) {
        const Outcome outcome = run(words);
        CAPTURE(words, outcome.err);
        CHECK(outcome.exit_code == 5);
        CHECK(holds(outcome.err, "error: " + scene +
                                     ": /extensionsUsed/0: extension "
                                     "KHR_materials_scatter is a draft, which may change; --strict "
                                     "refuses this, and 1 more"));
        CHECK_FALSE(std::filesystem::exists(out));
    }
    CHECK(run({"info", scene}).exit_code == 0);
}

TEST_CASE("a scene may have files in the folders of --allow-folder")
{
    const ScratchFolder folder;
    std::filesystem::create_directories(folder / "scene/scene");
    std::filesystem::create_directories(folder / "store");
    const std::string cube = write_cube(folder, "scene/cube", {.cameras = two_cameras}).string();
    std::filesystem::rename(folder / "scene/cube.bin", folder / "store/1234");
    std::filesystem::create_symlink("../../store/1234", folder / "scene/scene/cube.bin");
    const std::string store = (folder / "store").string();
    const std::string out = (folder / "out.exr").string();
    const auto render = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"render", cube,  "-o",           out, "--spp", "1",
                                       "--size", "8x8", "--integrator", "pt"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    const Outcome refused = render({});
    CAPTURE(refused.err);
    CHECK(refused.exit_code == 4);
    CHECK(holds(refused.err, "/buffers/0/uri: \"scene/cube.bin\": is a link to \""));
    CHECK(holds(refused.err, "outside of the scene's folder; --allow-folder allows others"));
    CHECK(render({"--allow-folder", (folder / "scene").string(), "--allow-folder", store})
              .exit_code == 0);
    CHECK(render({"--allow-folder", (folder / "nowhere").string()}).exit_code == 3);
    CHECK(holds(run({"info", cube, "--allow-folder", store}).out, "12 in the scene"));
    // No file may state it, but each task of a plan may be given it.
    const std::string job = (folder / "job.json").string();
    std::ofstream(job)
        << R"({"bdpt_job": 1, "file": "scene/cube.gltf", "allow_folder": ["store"]})";
    const Outcome of_job = run({"render", job, "-o", out});
    CHECK(of_job.exit_code == 4);
    CHECK(holds(of_job.err, "allow_folder"));
    const std::string plan = (folder / "plan").string();
    CHECK(run({"plan", cube, "-o", out, "--spp", "8", "--size", "8x8", "--parts", "1", "--for",
               "make", "-d", plan, "--allow-folder", store})
              .exit_code == 0);
    const std::vector<std::string> task{"render", "--plan", plan + "/plan.json", "--task", "0"};
    CHECK(run(task).exit_code == 4);
    std::vector<std::string> allowed = task;
    allowed.insert(allowed.end(), {"--allow-folder", store});
    CHECK(run(allowed).exit_code == 0);
}

TEST_CASE("a limit of memory is one for render and info")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {.cameras = two_cameras}).string();
    CHECK(run({"info", scene, "--max-memory", "1M"}).exit_code == 0);
    const Outcome refused = run({"info", scene, "--max-memory", "2K"});
    CHECK(refused.exit_code == 0);
    CHECK(refused.out.find("would fail with exit code 4: " + scene + ": ") != std::string::npos);
    const auto limits = nlohmann::json::parse(
        run({"info", "--limits", "--max-memory", "2G", "--json"}).out)["limits"];
    CHECK(limits["memory_bytes"] == 2147483648U);
    CHECK(limits["texture_bytes"] == 8589934592U);  // of any scene
}

TEST_CASE("the film counts as a part of the memory of a render")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {.cameras = two_cameras}).string();
    const auto render = [&](const std::vector<std::string>& words) {
        std::vector<std::string> all{"render", scene, "-o",     (folder / "out.exr").string(),
                                     "--spp",  "1",   "--quiet"};
        all.insert(all.end(), words.begin(), words.end());
        return run(all);
    };
    // Two halves of samples, three sums of 16 bytes each, and an image of floats.
    constexpr int pixel = 2 * 3 * 16 + 3 * 4;
    const Outcome too_large = render({"--size", "1000x1000", "--max-memory", "100M"});
    CAPTURE(too_large.err);
    CHECK(too_large.exit_code == 4);
    CHECK(too_large.err.find("the film of 1000x1000 pixels needs 108 MB of memory, but the limit "
                             "is 105 MB (--max-memory)") != std::string::npos);
    CHECK(render({"--size", "1000x1000", "--max-memory", "250M", "--crop", "0,0,8,8"}).exit_code ==
          0);
    CHECK(render({"--size", "64x32", "--max-memory", "2M"}).exit_code == 0);
    // Layers are a part of it: this one more than doubles nothing, but is too much.
    const std::vector<std::string> small{"--size", "64x32",        "--max-memory",
                                         "500K",   "--integrator", "pt"};
    CHECK(render(small).exit_code == 0);
    std::vector<std::string> layers = small;
    layers.insert(layers.end(), {"--aov", "albedo,normal,position"});
    const Outcome with_layers = render(layers);
    CAPTURE(with_layers.err);
    CHECK(with_layers.exit_code == 4);
    // What the film leaves is too little for the scene.
    const std::string limit = std::to_string(pixel * 64 * 32 + 1000);
    const Outcome no_room = render({"--size", "64x32", "--max-memory", limit});
    CAPTURE(no_room.err);
    CHECK(no_room.exit_code == 4);
    CHECK(no_room.err.find(scene + ": the file needs ") != std::string::npos);
    CHECK(no_room.err.find("but 1 kB of 222 kB are left (--max-memory)") != std::string::npos);
}

/// The integrator and its light paths and connections that a render of `words` says it uses.
nlohmann::json chosen_by(const Outcome& outcome)
{
    const auto start = nlohmann::json::parse(outcome.out.substr(0, outcome.out.find('\n')));
    REQUIRE(start.at("event") == "start");
    const nlohmann::json& settings = start.at("settings");
    nlohmann::json chosen;
    for (const char* name : {"integrator", "light_paths", "connections", "connection_rays"}) {
        chosen[name] = settings.value(name, nlohmann::json());
    }
    return chosen;
}

TEST_CASE("auto chooses by its own limit of memory, never by what the machine has left")
{
    const ScratchFolder folder;
    const std::string scene = std::string(BDPT_SOURCE_DIR) + "/scenes/cornell-box.gltf";
    const auto render = [&](const std::vector<std::string>& words) {
        std::vector<std::string> all{"render", scene,   "-o",        (folder / "out.exr").string(),
                                     "--size", "96x96", "--samples", "0:1",
                                     "--json"};
        all.insert(all.end(), words.begin(), words.end());
        return run(all);
    };
    const Outcome free = render({});
    REQUIRE(free.exit_code == 0);
    const nlohmann::json chosen = chosen_by(free);
    CAPTURE(chosen.dump());
    REQUIRE(chosen.at("integrator") == "bdpt");
    REQUIRE(chosen.at("light_paths") < 1.0);  // shared, so that they take memory
    bool is_refused = false;
    for (const char* limit : {"30M", "6M", "3M", "2500K"}) {
        const Outcome limited = render({"--max-memory", limit});
        CAPTURE(limit, limited.out, limited.err);
        if (limited.exit_code == 0) {
            CHECK(chosen_by(limited) == chosen);
        } else {
            CHECK(limited.exit_code == 4);
            is_refused = is_refused || limited.out.find(
                                           "the set of light paths for 96x96 pixels "
                                           "(--light-path-memory) needs ") != std::string::npos;
        }
    }
    CHECK(is_refused);
    const Outcome small = render({"--light-path-memory", "1K"});
    REQUIRE(small.exit_code == 0);
    CHECK(chosen_by(small) != chosen);
    CHECK(render({"--light-path-memory", "1K", "--max-memory", "2500K"}).exit_code == 0);
}

/// A PNG image of 64 x 64 pixels, black and white in turn.
void write_stripes(const std::filesystem::path& file)
{
    constexpr int side = 64;
    io::DisplayImage image{.width = side, .height = side, .rgb = {}};
    for (int i = 0; i < side * side; ++i) {
        image.rgb.insert(image.rgb.end(), 3, i % 2 == 0 ? std::uint8_t{0} : std::uint8_t{255});
    }
    io::write_png(file, image, {});
}

TEST_CASE("option --texture-filter reaches the textures, and the files say which one it was")
{
    const ScratchFolder folder;
    write_stripes(folder / "stripes.png");
    const std::string scene =
        write_cube(folder, "striped",
                   {.material = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
                    .cameras = two_cameras,
                    .more = R"("images": [{"uri": "stripes.png"}], "textures": [{"source": 0}],)"})
            .string();
    const auto render = [&](const std::string& name, const std::vector<std::string>& words) {
        const std::filesystem::path out = folder / name;
        std::vector<std::string> all{"render", scene,    "-o",  out.string(), "--spp",
                                     "1",      "--size", "8x4", "--json"};
        all.insert(all.end(), words.begin(), words.end());
        const Outcome outcome = run(all);
        CAPTURE(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return outcome.out.find(R"("texture_filter":"mip")") != std::string::npos;
    };
    CHECK_FALSE(render("plain.exr", {}));
    CHECK_FALSE(render("bilinear.exr", {"--texture-filter", "bilinear"}));
    CHECK(render("mip.exr", {"--texture-filter", "mip"}));
}

/// A cube that goes by 1 m to the right within a second.
std::string sliding_cube(const ScratchFolder& folder)
{
    const std::filesystem::path scene = write_cube(folder, "slide", {.cameras = two_cameras});
    nlohmann::json document = nlohmann::json::parse(std::ifstream(scene));
    std::size_t cube = 0;
    while (!document["nodes"][cube].contains("mesh")) {
        ++cube;
    }
    const std::size_t buffer = document["buffers"].size();
    const std::size_t view = document["bufferViews"].size();
    const std::size_t accessor = document["accessors"].size();
    // Little-endian floats: 0, 1; 0, 0, 0, 1, 0, 0.
    document["buffers"].push_back(
        {{"byteLength", 32},
         {"uri",
          "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAA="}});
    document["bufferViews"].push_back({{"buffer", buffer}, {"byteLength", 32}});
    document["accessors"].push_back(
        {{"bufferView", view}, {"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}});
    document["accessors"].push_back({{"bufferView", view},
                                     {"byteOffset", 8},
                                     {"componentType", 5126},
                                     {"count", 2},
                                     {"type", "VEC3"}});
    document["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", cube}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", accessor}, {"output", accessor + 1}}}}}};
    write_text(scene, document.dump());
    return scene.string();
}

TEST_CASE("a shutter blurs, unless it has no length")
{
    const ScratchFolder folder;
    const std::string scene = sliding_cube(folder);
    const auto rendered = [&](const std::string& name, const std::vector<std::string>& words) {
        const std::string out = (folder / name).string();
        std::vector<std::string> all{"render", scene, "-o", out, "--spp", "4", "--size", "16x8"};
        all.insert(all.end(), words.begin(), words.end());
        const Outcome outcome = run(all);
        CAPTURE(words, outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return read_exr(out);
    };
    const ExrFile still = rendered("still.exr", {"--frame-time", "0.5"});
    const ExrFile moment = rendered("moment.exr", {"--frame-time", "0.5", "--shutter", "0"});
    const ExrFile shifted = rendered("shifted.exr", {"--frame-time", "0", "--shutter=0.5,0.5"});
    const ExrFile blurred = rendered("blurred.exr", {"--frame-time", "0.5", "--shutter=-0.4,0.5"});
    CHECK(moment.image.pixels == still.image.pixels);
    CHECK(shifted.image.pixels == still.image.pixels);
    CHECK_FALSE(blurred.image.pixels == still.image.pixels);
    const auto settings = nlohmann::json::parse(blurred.text("bdpt.settings"));
    CHECK(settings["shutter"] == nlohmann::json{-0.4, 0.5});
    // A shutter alone plays the animation from its beginning, before a camera that the user places.
    const std::vector<std::string> placed{"--from", "0,0,6", "--look-at", "0,0,0"};
    const auto seen = [&](const std::string& name, std::vector<std::string> words) {
        words.insert(words.end(), placed.begin(), placed.end());
        return rendered(name, words).image.pixels;
    };
    const auto playing = seen("playing.exr", {"--shutter", "0.5"});
    CHECK(playing == seen("from.exr", {"--frame-time", "0", "--shutter", "0.5"}));
    CHECK_FALSE(playing == seen("resting.exr", {"--frame-time", "0"}));
}

TEST_CASE("a camera that the user places stands still while the file's own moves")
{
    const ScratchFolder folder;
    const std::filesystem::path scene = sliding_cube(folder);
    // What slides is what carries the first camera.
    nlohmann::json document = nlohmann::json::parse(std::ifstream(scene));
    std::size_t camera = 0;
    while (!document["nodes"][camera].contains("camera")) {
        ++camera;
    }
    const std::size_t carrier = document["nodes"].size();
    document["nodes"].push_back({{"children", {camera}}});
    document["animations"][0]["channels"][0]["target"]["node"] = carrier;
    for (nlohmann::json& root : document["scenes"][0]["nodes"]) {
        root = root == camera ? carrier : root.get<std::size_t>();
    }
    write_text(scene, document.dump());
    const auto pixels = [&](const std::vector<std::string>& words) {
        const std::string out = (folder / "out.exr").string();
        std::vector<std::string> all{"render", scene.string(), "-o",           out, "--spp", "4",
                                     "--size", "16x8",         "--frame-time", "0"};
        all.insert(all.end(), words.begin(), words.end());
        const Outcome outcome = run(all);
        CAPTURE(words, outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return read_exr(out).image.pixels;
    };
    CHECK_FALSE(pixels({"--shutter", "0.5"}) == pixels({}));
    CHECK(pixels({"--shutter", "0.5", "--from", "0,0,6"}) == pixels({"--from", "0,0,6"}));
}

TEST_CASE("images say which part of a file they show, and what the file says about itself")
{
    const ScratchFolder folder;
    const std::string more = R"("extensionsUsed": ["KHR_materials_variants", "KHR_xmp_json_ld"],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "day"}]},
                       "KHR_xmp_json_ld": {"packets": [{"dc:title": "none"}, {"dc:title": "Box"}]}},)";
    const std::filesystem::path scene =
        write_cube(folder, "cube", {.cameras = two_cameras, .more = more});
    nlohmann::json document = nlohmann::json::parse(std::ifstream(scene));
    document["asset"]["extensions"]["KHR_xmp_json_ld"]["packet"] = 1;
    write_text(scene, document.dump());
    const Outcome outcome =
        run({"render", scene.string(), "-o", (folder / "out.exr").string(), "--spp", "1", "--size",
             "8x4", "--variant", "day", "--frame-time", "0.5"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.find("the file has no animations") != std::string::npos);
    const ExrFile exr = read_exr(folder / "out.exr");
    const auto settings = nlohmann::json::parse(exr.text("bdpt.settings"));
    CHECK(settings["variant"] == "day");
    CHECK(settings["frame_time"] == 0.5);
    CHECK_FALSE(settings.contains("animation"));
    CHECK(exr.text("bdpt.xmp") == R"({"dc:title":"Box"})");
}

TEST_CASE("info lists variants and animations")
{
    const ScratchFolder folder;
    const std::string scene = with_variants(folder);
    const Outcome outcome = run({"info", scene, "--variant", "night"});
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.out.find("variants    0 \"day\"") != std::string::npos);
    const auto info = nlohmann::json::parse(run({"info", scene, "--json"}).out);
    CHECK(info["variants"] == nlohmann::json::array({"day", "night"}));
    CHECK(info["animations"].empty());
    CHECK(run({"info", scene, "--variant", "dusk"}).exit_code == 3);
}

TEST_CASE("info tells the limits, with and without a file")
{
    const Outcome outcome = run({"info", "--limits"});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.out.find("triangles            500000000") != std::string::npos);
    const auto alone = nlohmann::json::parse(run({"info", "--limits", "--json"}).out);
    CHECK(alone["limits"]["node_depth"] == 512);
    CHECK(alone.size() == 1);
    const ScratchFolder folder;
    const auto both =
        nlohmann::json::parse(run({"info", with_variants(folder), "--limits", "--json"}).out);
    const auto constant_limits = [](nlohmann::json json) {
        json["limits"].erase("memory_bytes");  // what is free at that moment
        return json["limits"];
    };
    CHECK(constant_limits(both) == constant_limits(alone));
    CHECK(both["limits"]["memory_bytes"].get<double>() > 0.0);
    CHECK(both.contains("triangles"));
}

}  // namespace
}  // namespace bdpt::test::scene_choice_test
