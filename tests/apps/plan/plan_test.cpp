#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::plan_test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using nlohmann::json;

std::string path(const ScratchFolder& folder, const std::string& name)
{
    return (folder / name).string();
}

/// What of the render is the same with and without a plan.
Words scene_words(const ScratchFolder& folder)
{
    return {path(folder, "cube.gltf"), "--size", "24x16", "--max-depth", "4", "--spp", "12"};
}

Words joined(Words words, const Words& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Plans the render of a cube in three tasks, in the folder "job".
Outcome plan(const ScratchFolder& folder, const Words& more)
{
    write_cube(folder, "cube", {});
    return run(joined(joined({"plan"}, scene_words(folder)),
                      joined({"--parts", "3", "--for", "make", "-d", path(folder, "job"), "-o",
                              path(folder, "out.exr")},
                             more)));
}

Outcome checked(Outcome outcome, int code = 0)
{
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == code);
    return outcome;
}

Outcome render_task(const ScratchFolder& folder, const std::string& task, const Words& more = {})
{
    return run(joined({"render", "--plan", path(folder, "job/plan.json"), "--task", task}, more));
}

Outcome merge(const ScratchFolder& folder, const Words& more = {})
{
    return run(joined({"merge", "--plan", path(folder, "job/plan.json")}, more));
}

std::vector<Rgb> pixels(const ScratchFolder& folder, const std::string& name)
{
    return read_exr(folder / name).image.pixels;
}

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// One line of failure that has all of `texts`.
void check_refused(const Outcome& outcome, int code, const Words& texts)
{
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == code);
    for (const std::string& text : texts) {
        CHECK(contains(outcome.err, text));
    }
}

TEST_CASE("the tasks of a plan make the pixels of one render", "[plan]")
{
    const ScratchFolder folder;
    // auto, with what it chooses; and what is open no more.
    const Words how = GENERATE(Words{}, Words{"--integrator", "auto", "--env=none"},
                               Words{"--integrator", "lt", "--aov", "alpha", "--seed=7"},
                               Words{"--light-paths", "0.25", "--sampler", "independent"},
                               Words{"--background", "transparent", "--integrator", "mis"});
    checked(plan(folder, joined(how, {"--half", "-o", path(folder, "out.png")})));
    CHECK(fs::exists(folder / "job" / "Makefile"));
    for (const char* task : {"2", "0", "1"}) {
        checked(render_task(folder, task, {"--threads", "2"}));
    }
    checked(merge(folder));
    checked(merge(folder, {"-o", path(folder, "float.exr")}));
    checked(run(joined(joined({"render"}, scene_words(folder)),
                       joined(how, {"--half", "-o", path(folder, "whole.exr")}))));

    CHECK(pixels(folder, "out.exr") == pixels(folder, "whole.exr"));
    CHECK(pixels(folder, "float.exr") == pixels(folder, "whole.exr"));
    CHECK(read_exr(folder / "out.exr").integer("bdpt.spp") == 12);
    CHECK(fs::exists(folder / "out.png"));
}

TEST_CASE("a plan pins all that auto has chosen", "[plan]")
{
    const ScratchFolder folder;
    // A room whose spotlight shines at the wall behind the camera.
    write_cube(folder, "room",
               {.cameras = R"({"camera": 0, "translation": [0, 0, 0.9]},
                              {"rotation": [0, 1, 0, 0],
                               "extensions": {"KHR_lights_punctual": {"light": 0}}},)",
                .inside_out = true,
                .more = R"("extensionsUsed": ["KHR_lights_punctual"],
                           "extensions": {"KHR_lights_punctual": {"lights": [
                               {"type": "spot", "intensity": 10,
                                "spot": {"outerConeAngle": 0.3}}]}},)"});
    const Words room{
        path(folder, "room.gltf"), "--size", "24x16", "--max-depth", "4", "--spp", "256", "-o",
        path(folder, "out.exr")};
    checked(run(joined(joined({"plan"}, room),
                       {"--parts", "2", "--for", "make", "-d", path(folder, "job")})));
    const json there = json::parse(read_text(folder / "job" / "plan.json"));
    const Words pinned = there["render"];
    const Words all{"--integrator=bdpt", "--light-paths=", "--connections="};
    for (const std::string& word : all) {
        CAPTURE(word);
        CHECK(std::any_of(pinned.begin(), pinned.end(),
                          [&](const std::string& other) { return other.starts_with(word); }));
    }
    // The settings that a render tells say the same.
    const Outcome outcome = checked(run(joined({"render", "--json"}, room)));
    const json settings = json::parse(outcome.out.substr(0, outcome.out.find('\n')))["settings"];
    CHECK(settings["chosen_by"] == "auto");
    const auto is_pinned = [&](const std::string& word) {
        CAPTURE(word);
        CHECK(std::find(pinned.begin(), pinned.end(), word) != pinned.end());
    };
    is_pinned("--integrator=" + settings["integrator"].get<std::string>());
    is_pinned("--light-paths=" + settings["light_paths"].dump());
    is_pinned("--connections=" + settings["connections"].dump());
}

TEST_CASE("a plan pins how many connections auto has chosen", "[plan]")
{
    const ScratchFolder folder;
    const Words box{BDPT_SOURCE_DIR "/scenes/cornell-box.gltf",
                    "--size",
                    "64x48",
                    "--spp",
                    "16",
                    "-o",
                    path(folder, "out.exr")};
    checked(run(joined(joined({"plan"}, box),
                       {"--parts", "2", "--for", "make", "-d", path(folder, "job")})));
    const json there = json::parse(read_text(folder / "job" / "plan.json"));
    const Words pinned = there["render"];
    const Outcome outcome = checked(run(joined({"render", "--json"}, box)));
    const json settings = json::parse(outcome.out.substr(0, outcome.out.find('\n')))["settings"];
    REQUIRE(settings.contains("connection_rays"));
    const std::string word = "--connection-rays=" + settings["connection_rays"].dump();
    CHECK(std::find(pinned.begin(), pinned.end(), word) != pinned.end());
}

TEST_CASE("a plan pins what another machine would choose otherwise", "[plan]")
{
    const ScratchFolder folder;
    checked(plan(folder, {}));
    const json there = json::parse(read_text(folder / "job" / "plan.json"));
    const Words words = there["render"];
    const auto has = [&](const std::string& start) {
        return std::any_of(words.begin(), words.end(),
                           [&](const std::string& word) { return word.starts_with(start); });
    };
    CHECK(has("--isa="));
    CHECK_FALSE(has("--isa=native"));
    CHECK(has("--integrator="));
    CHECK_FALSE(has("--integrator=auto"));
    CHECK(there["tasks"].size() == 3);
    CHECK(there["tasks"][1]["samples"] == "4:8");
}

TEST_CASE("a task refuses a scene that is not the one that was planned, before it renders",
          "[plan]")
{
    const ScratchFolder folder;
    checked(plan(folder, {}));
    checked(render_task(folder, "0"));
    const std::string part = read_text(folder / "job" / "task-0.part.exr");
    write_cube(folder, "cube", {.material = emissive_material});
    check_refused(render_task(folder, "1"), 4,
                  {"plan.json: is the plan of another render: scene: materials"});
    CHECK_FALSE(fs::exists(folder / "job" / "task-1.part.exr"));
    CHECK(read_text(folder / "job" / "task-0.part.exr") == part);

    // Nor does merge take parts of another render for the plan's.
    checked(run(joined(joined({"render"}, scene_words(folder)),
                       {"--seed", "3", "--part", path(folder, "job/task-1.part.exr")})));
    check_refused(merge(folder), 4, {"task-1.part.exr: is of another render than", "plan.json"});
    check_refused(merge(folder, {"--wait"}), 4, {"is of another render than"});
}

TEST_CASE("a task that is done ends without the scene", "[plan]")
{
    const ScratchFolder folder;
    checked(plan(folder, {}));
    checked(render_task(folder, "1"));
    fs::remove(folder / "cube.gltf");
    const Outcome again = checked(render_task(folder, "1", {"--json"}));
    CHECK(json::parse(again.out)["samples"] == 4);
    check_refused(render_task(folder, "2"), 3, {"cube.gltf"});
    check_refused(render_task(folder, "1", {"--restart"}), 3, {"cube.gltf"});
}

TEST_CASE("a folder with scene and plan may be moved", "[plan]")
{
    const ScratchFolder folder;
    const ScratchFolder elsewhere;
    write_cube(folder, "cube", {});
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    checked(run({"plan", "cube.gltf", "--size", "8x8", "--spp", "2", "--parts", "2", "--for",
                 "slurm", "-d", "job", "-o", "out.exr"}));
    fs::current_path(before);
    fs::rename(folder.path() / "job", elsewhere / "job");
    for (const char* name : {"cube.gltf", "cube.bin"}) {
        fs::rename(folder / name, elsewhere / name);
    }
    for (const char* task : {"0", "1"}) {
        checked(render_task(elsewhere, task));
    }
    checked(merge(elsewhere));
    CHECK(elsewhere.names() == std::set<std::string>{"cube.gltf", "cube.bin", "job", "out.exr"});
}

TEST_CASE("the number of a task may be in the environment", "[plan]")
{
    const ScratchFolder folder;
    checked(plan(folder, {}));
    const Words words{"render", "--plan", path(folder, "job/plan.json"), "--task", "env:INDEX"};
    checked(run(Launch{.arguments = words, .environment = {{"INDEX", "2"}}}));
    CHECK(fs::exists(folder / "job" / "task-2.part.exr"));
    check_refused(run(words), 2, {"--task \"env:INDEX\""});
    check_refused(run(Launch{.arguments = words, .environment = {{"INDEX", "3"}}}), 2,
                  {"--task \"3\"", "0 to 2"});
}

TEST_CASE("another plan is replaced on demand only, with its parts", "[plan]")
{
    const ScratchFolder folder;
    checked(plan(folder, {}));
    checked(render_task(folder, "0"));
    const std::string before = read_text(folder / "job" / "plan.json");
    checked(plan(folder, {}));  // the same again
    CHECK(fs::exists(folder / "job" / "task-0.part.exr"));
    check_refused(plan(folder, {"--seed", "2"}), 6, {"plan.json: is another plan", "--restart"});
    check_refused(plan(folder, {"--for", "slurm"}), 6, {"plan.json: is another plan"});
    CHECK(read_text(folder / "job" / "plan.json") == before);

    checked(plan(folder, {"--for", "slurm", "--restart"}));
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder / "job")) {
        names.insert(entry.path().filename().string());
    }
    CHECK(names == std::set<std::string>{"plan.json", "submit.sh", "tasks.sbatch", "merge.sbatch"});
}

TEST_CASE("merge of a plan names the tasks that are missing", "[plan]")
{
    const ScratchFolder folder;
    checked(plan(folder, {}));
    const std::string file = path(folder, "job/plan.json");
    check_refused(merge(folder), 12, {"samples are missing: 0:12 (tasks 0-2 of " + file + ")"});
    check_refused(merge(folder, {"--partial"}), 12, {"samples are missing: 0:12"});
    CHECK_FALSE(fs::exists(folder / "out.exr"));
    checked(render_task(folder, "1"));
    check_refused(
        merge(folder), 12,
        {"samples are missing: 0:4,8:12 (tasks 0,2 of " + file + ")",
         "bdpt render --plan " + file + " --task 0 && bdpt render --plan " + file + " --task 2"});
    checked(merge(folder, {"--partial"}));
    CHECK(read_exr(folder / "out.exr").integer("bdpt.spp") == 4);
}

TEST_CASE("merge waits for parts that are absent, torn or not complete", "[plan]")
{
    const ScratchFolder folder;
    checked(plan(folder, {}));
    const auto part = [&](int task) {
        return path(folder, "job/task-" + std::to_string(task) + ".part.exr");
    };
    checked(render_task(folder, "0"));
    // One is torn, one has not the samples of its task, one is not there.
    const std::string whole = read_text(part(0));
    write_text(part(0), whole.substr(0, whole.size() / 2));
    write_text(part(1), whole);
    check_refused(merge(folder), 4, {"task-0.part.exr"});
    check_refused(merge(folder, {"--wait=1s"}), 12,
                  {"task-0.part.exr", "samples are missing: 4:12 (tasks 1-2 of "});

    Subprocess waiting(
        Launch{.arguments = {"merge", "--plan", path(folder, "job/plan.json"), "--wait=10m"}});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    for (const char* task : {"0", "1", "2"}) {
        checked(render_task(folder, task, {"--restart"}));
    }
    checked(waiting.finish());
    CHECK(read_exr(folder / "out.exr").integer("bdpt.spp") == 12);
}

TEST_CASE("merge waits for the parts that are named, without a plan, too", "[plan]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    const std::string a = path(folder, "a.part.exr");
    const std::string b = path(folder, "b.part.exr");
    const std::string out = path(folder, "out.exr");
    const auto render = [&](const std::string& samples, const std::string& file) {
        checked(run({"render", path(folder, "cube.gltf"), "--size", "8x8", "--samples", samples,
                     "--part", file}));
    };
    render("0:4", a);
    check_refused(run({"merge", a, b, "-o", out}), 3, {"b.part.exr"});
    check_refused(run({"merge", b, "-o", out, "--wait=1s"}), 12, {"no part was found"});
    // a is complete as far as it knows, but b was named, too.
    Subprocess waiting(Launch{.arguments = {"merge", a, b, "-o", out, "--wait"}});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    CHECK_FALSE(fs::exists(out));
    render("4:6", b);
    checked(waiting.finish());
    CHECK(read_exr(out).integer("bdpt.spp") == 6);

    Subprocess endless(Launch{.arguments = {"merge", a, "-o", out, "--spp", "9", "--wait"}});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    endless.send(SIGTERM);
    CHECK(endless.finish().exit_code == 143);
}

TEST_CASE("as many tasks are planned as take the time", "[plan]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    // A sample takes some microseconds: all fits into a minute, and none into next to nothing.
    const auto tasks = [&](const std::string& minutes) {
        checked(run({"plan", path(folder, "cube.gltf"), "--size", "8x8", "--spp", "16", "--minutes",
                     minutes, "--for", "make", "-d", path(folder, "job"), "-o",
                     path(folder, "out.exr"), "--restart"}));
        return json::parse(read_text(folder / "job" / "plan.json"))["tasks"].size();
    };
    CHECK(tasks("1") == 1);
    CHECK(tasks("1e-9") == 16);
}

TEST_CASE("words about plans that make no sense are refused, and nothing is written", "[plan]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    const auto refused = [&](const Words& more, int code, const Words& texts) {
        check_refused(run(joined({"plan", path(folder, "cube.gltf")}, more)), code, texts);
        CHECK_FALSE(fs::exists(folder / "job"));
    };
    const Words place{"-d", path(folder, "job"), "-o", path(folder, "out.exr"), "--for", "make"};
    const auto with = [&](const Words& more) { return joined(place, more); };
    refused(place, 2, {"--parts"});
    refused(with({"--parts", "2", "--minutes", "3"}), 2, {"--parts"});
    refused(with({"--parts", "65"}), 2, {"--parts \"65\"", "64 samples"});
    refused(with({"--parts", "0"}), 2, {"--parts"});
    refused(with({"--minutes", "0"}), 2, {"--minutes \"0\""});
    refused(with({"--parts", "2", "--time", "3s"}), 2, {"--time"});
    refused(with({"--parts", "2", "--part", "a.exr"}), 2, {"--part"});
    refused(with({"--parts", "2", "--for", "sge"}), 2, {"--for"});
    refused(with({"--parts", "2", "--camera", "none"}), 3, {"none"});
    refused({"-d", path(folder, "job"), "--parts", "2", "--for", "make"}, 2, {"--output"});
    refused({"-d", path(folder, "no/job"), "-o", path(folder, "out.exr"), "--for", "make",
             "--parts", "2"},
            6, {"no"});
    refused({"-d", path(folder, "cube.bin"), "-o", path(folder, "out.exr"), "--for", "make",
             "--parts", "2"},
            6, {"cube.bin: cannot write: this is not a folder"});

    checked(plan(folder, {}));
    const std::string file = path(folder, "job/plan.json");
    check_refused(render_task(folder, "3"), 2, {"--task \"3\"", "0 to 2", "bdpt render --help"});
    check_refused(run({"render", "--plan", file}), 2, {"--task N"});
    check_refused(render_task(folder, "0", {"--seed", "5"}), 2, {"--plan", "combined with --seed"});
    check_refused(run({"merge", "--plan", file, "--spp", "5"}), 2,
                  {"--spp cannot be combined with --plan"});
    check_refused(run({"merge", "--plan", file, "--wait=soon"}), 2, {"--wait \"soon\""});
    check_refused(run({"render", "--plan", path(folder, "x.json"), "--task", "0"}), 3,
                  {"x.json: no such file"});
    check_refused(run({"render", "--plan", path(folder, "cube.gltf"), "--task", "0"}), 4,
                  {"cube.gltf: is not a plan of bdpt plan"});
    json other = json::parse(read_text(file));
    for (const json& format : {json("new"), json(1)}) {
        other["format"] = format;
        write_text(folder / "job" / "plan.json", other.dump());
        check_refused(render_task(folder, "0"), 4,
                      {"plan.json: is not a plan of bdpt plan: format ", "this program reads 2"});
    }
    other["format"] = 99;
    write_text(folder / "job" / "plan.json", other.dump());
    check_refused(render_task(folder, "0"), 4,
                  {"plan.json: is a plan of format 99, which a newer bdpt wrote; this program "
                   "reads format 2"});
    write_text(folder / "job" / "plan.json", "{}");
    check_refused(render_task(folder, "0"), 4, {"plan.json: is not a plan of bdpt plan"});
    write_text(folder / "job" / "plan.json", "");
    check_refused(render_task(folder, "0"), 4,
                  {"plan.json: JSON: ends in the middle, after 0 bytes"});
}

TEST_CASE("a template takes the place of the file of its name, and gets the values of the plan")
{
    const ScratchFolder folder;
    fs::create_directory(folder / "mine");
    std::ofstream(folder / "mine/Makefile") << "@COUNT@ to @LAST@:@TASKS@ @OTHER@\n";
    checked(plan(folder, {"--template", path(folder, "mine/Makefile"), "--quiet"}));
    std::ifstream written(folder / "job/Makefile");
    std::string line;
    std::getline(written, line);
    CHECK(line == "3 to 2: task-0 task-1 task-2 @OTHER@");
    const Outcome other = plan(folder, {"--template", path(folder, "mine/tasks.sbatch")});
    CHECK(other.exit_code == 2);
    CHECK(contains(other.err, "expected a file with the name Makefile"));
    fs::remove(folder / "mine/Makefile");
    checked(plan(folder, {"--template", path(folder, "mine/Makefile")}), 3);
}

}  // namespace
}  // namespace bdpt::test::plan_test
