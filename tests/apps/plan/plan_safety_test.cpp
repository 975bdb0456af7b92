#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "plan/plan.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

// A plan.json may come from a stranger.

namespace bdpt::test::plan_safety_test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using nlohmann::json;

/// A plan of two tasks in the folder "job" of a scratch folder.
class PlannedCube {
public:
    PlannedCube()
    {
        write_cube(folder_, "cube", {});
        const Outcome outcome = plan({});
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
    }

    [[nodiscard]] fs::path operator/(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] std::string file() const { return (folder_ / "job/plan.json").string(); }

    [[nodiscard]] Outcome plan(const Words& more) const
    {
        Words words{"plan",         (folder_ / "cube.gltf").string(),
                    "--size",       "8x4",
                    "--spp",        "2",
                    "--integrator", "pt",
                    "--parts",      "2",
                    "--for",        "make",
                    "-d",           (folder_ / "job").string(),
                    "-o",           (folder_ / "out.exr").string()};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    [[nodiscard]] Outcome task(const std::string& number) const
    {
        return run({"render", "--plan", file(), "--task", number, "--quiet"});
    }
    [[nodiscard]] Outcome merge(const Words& more = {}) const
    {
        Words words{"merge", "--plan", file(), "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    void change(const std::function<void(json&)>& change) const
    {
        json plan = json::parse(read_text(file()));
        change(plan);
        write_text(file(), plan.dump());
    }

private:
    ScratchFolder folder_;
};

/// One line of failure that has all of `texts`.
void check_refused(const Outcome& outcome, int code, const Words& texts)
{
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == code);
    for (const std::string& text : texts) {
        CAPTURE(text);
        CHECK(outcome.err.find(text) != std::string::npos);
    }
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
}

TEST_CASE("no plan makes --restart remove what bdpt has not written there", "[plan]")
{
    const PlannedCube job;
    const std::string outside = (job / "precious").string();
    write_text(outside, "thesis");
    write_text(job / "job/notes.txt", "mine");
    const std::vector<std::function<void(json&)>> lies{
        [&](json& plan) { plan["engine_files"] = {outside}; },
        [&](json& plan) { plan["engine_files"] = {"../precious"}; },
        [&](json& plan) { plan["engine_files"] = {"notes.txt"}; },
        [&](json& plan) { plan["rates"] = outside; },
        [&](json& plan) { plan["rates"] = "notes.txt"; },
        [&](json& plan) { plan["tasks"][0]["part"] = outside; },
        [&](json& plan) { plan["tasks"][0]["part"] = "../precious"; },
        [&](json& plan) { plan["tasks"][0]["part"] = "notes.txt"; },
        [&](json& plan) { plan["tasks"][0]["part"] = "task-0/../../precious"; },
        [&](json& plan) { plan["tasks"][0]["part"] = "task-0.part.exr/../notes.txt"; },
    };
    for (const auto& lie : lies) {
        REQUIRE(job.plan({"--restart"}).exit_code == 0);
        job.change(lie);
        CAPTURE(read_text(job.file()));
        check_refused(job.task("0"), 4, {job.file() + ": /"});
        check_refused(job.merge(), 4, {job.file() + ": /"});
        CHECK(job.plan({"--restart"}).exit_code == 0);
        CHECK(read_text(outside) == "thesis");
        CHECK(read_text(job / "job/notes.txt") == "mine");
    }

    // Of a link the link goes, and nothing is written through it.
    fs::create_symlink(outside, job / "job/task-0.part.exr");
    check_refused(job.task("0"), 4, {"task-0.part.exr: is a symbolic link"});
    check_refused(job.merge(), 4, {"task-0.part.exr: is a symbolic link"});
    CHECK(job.plan({"--restart", "--seed", "3"}).exit_code == 0);
    CHECK_FALSE(fs::is_symlink(job / "job/task-0.part.exr"));
    CHECK(read_text(outside) == "thesis");
}

TEST_CASE("a plan has no words that write elsewhere, load code or call a machine", "[plan]")
{
    const PlannedCube job;
    const std::string before = read_text(job.file());
    const auto refused = [&](const std::string& list, const std::string& word) {
        CAPTURE(list, word);
        write_text(job.file(), before);
        job.change([&](json& plan) { plan[list].push_back(word); });
        const std::string place = job.file() + ": /" + list + "/";
        check_refused(job.task("0"), 4, {place, word, "an option that a plan may have"});
        check_refused(job.merge(), 4, {place, word});
        CHECK(fs::exists(job / "job/plan.json"));
        CHECK_FALSE(fs::exists(job / "x"));
    };
    const std::string elsewhere = (job / "x").string();
    for (const std::string& word :
         {"--stats=" + elsewhere, "--part=" + elsewhere, "-o" + elsewhere, "--output=" + elsewhere,
          "--save-rates=" + elsewhere, "--strategies=" + elsewhere,
          std::string("--display=localhost"), std::string("--restart"), "--env=" + elsewhere,
          "--rates=" + elsewhere, "--denoiser-library=" + elsewhere, "--ktx-library=" + elsewhere,
          "--volume=" + elsewhere, elsewhere, std::string("--plan=other"),
          std::string("--config=x")}) {
        refused("render", word);
        refused("merge", word);
    }
    // They are for who types.
    check_refused(job.plan({"--denoise", "--denoiser-library", BDPT_FAKE_OIDN, "--restart"}), 2,
                  {"--denoiser-library", "bdpt merge --plan"});
}

TEST_CASE("a plan replaces images of bdpt, and no other files", "[plan]")
{
    const PlannedCube job;
    for (const char* task : {"0", "1"}) {
        REQUIRE(job.task(task).exit_code == 0);
    }
    const fs::path out = job / "out.exr";
    for (const std::string& text :
         {std::string("thesis"), std::string("\x76\x2f\x31\x01 theirs")}) {
        write_text(out, text);
        check_refused(job.merge(), 6, {out.string() + ": cannot write: the plan names it", "-o"});
        CHECK(read_text(out) == text);
    }
    CHECK(job.merge({"-o", (job / "other.exr").string()}).exit_code == 0);
    fs::remove(out);
    CHECK(job.merge().exit_code == 0);
    const std::vector<Rgb> pixels = read_exr(out).image.pixels;
    CHECK(job.merge().exit_code == 0);  // an image of ours
    CHECK(read_exr(out).image.pixels == pixels);
    // Who names a file replaces it.
    write_text(job / "other.exr", "thesis");
    CHECK(job.merge({"-o", (job / "other.exr").string()}).exit_code == 0);
    CHECK(read_exr(job / "other.exr").image.pixels == pixels);
}

TEST_CASE("plans are of a sensible size", "[plan]")
{
    const PlannedCube job;
    const auto refused = [&](const std::string& file, int code, const Words& texts) {
        for (const Words& words :
             {Words{"merge", "--plan", file}, Words{"render", "--plan", file, "--task", "0"}}) {
            Launch launch{.arguments = words};
#ifndef BDPT_SANITIZED
            launch.address_space = rlim_t{2} << 30;
#endif
            check_refused(run(launch), code, texts);
        }
    };
    refused("/dev/zero", 3, {"/dev/zero: cannot be read: not a regular file"});
    refused((job / "job").string(), 3, {"job: cannot be read: not a regular file"});
    fs::resize_file(job.file(), std::uintmax_t{100} << 30);  // takes no room
    refused(job.file(), 4, {"plan.json: 107374182400 bytes, but the limit is"});
}

TEST_CASE("each number and text of a plan is checked", "[plan]")
{
    const PlannedCube job;
    const std::string before = read_text(job.file());
    const auto refused = [&](const std::string& place, const json& value) {
        CAPTURE(place, value.dump());
        write_text(job.file(), before);
        job.change([&](json& plan) { plan[json::json_pointer(place)] = value; });
        check_refused(job.task("0"), 4, {job.file() + ": "});
    };
    for (const json& value : {json(1e300), json(-1), json(0.5), json("1"), json(nullptr)}) {
        refused("/format", value);
        refused("/images/0/frame", value == -1 ? json(1e10) : value);
        refused("/images/0/seed", value);
        refused("/tasks/0/samples", value);
        refused("/tasks/0/images", value);
    }
    refused("/tasks/0/images", "0:2");
    refused("/tasks/0/samples", "0:1,2:3");
    refused("/tasks", json::array());
    refused("/identity/option: seed", 3);
    refused("/scene", json::array());
}

TEST_CASE("the plans of all engines can be read again, and are replaced with their files", "[plan]")
{
    const PlannedCube job;
    for (const char* engine : {"slurm", "kubernetes", "make"}) {
        CAPTURE(engine);
        REQUIRE(job.plan({"--for", engine, "--restart"}).exit_code == 0);
        const job::Plan plan = job::read_plan(job.file());
        std::size_t files = 0;
        for (const auto& entry : fs::directory_iterator(job / "job")) {
            ++files;
            CAPTURE(entry.path());
            CHECK((entry.path().filename() == "plan.json" ||
                   std::find(plan.engine_files.begin(), plan.engine_files.end(),
                             entry.path().filename()) != plan.engine_files.end()));
        }
        CHECK(files == plan.engine_files.size() + 1);
    }
}

// The time limit of tests is what this fails by: with the product of images and tasks it takes
// hours.
TEST_CASE("a plan of many images and tasks is merged in time", "[plan][long]")
{
    const ScratchFolder folder;
    constexpr int count = 100'000;
    job::Plan plan{.scene = "scene.glb", .outputs = {"out.####.exr"}};
    plan.images.clear();
    for (int i = 0; i < count; ++i) {
        plan.images.push_back({.frame = i, .seed = 5});
        plan.tasks.push_back({.first_image = static_cast<std::size_t>(i),
                              .images = 1,
                              .samples = {.begin = 0, .end = 64},
                              .part = "task-" + std::to_string(i) + ".####.part.exr"});
    }
    plan.identity.components = {{.name = "option: width", .value = "8"}};
    write_text(folder / "plan.json", to_text(plan));
    CHECK(job::read_plan(folder / "plan.json") == plan);
    check_refused(run({"merge", "--plan", (folder / "plan.json").string(), "--quiet"}), 12,
                  {"samples are missing: frame 0 to frame 99999 (tasks 0-99999 of "});
}

}  // namespace
}  // namespace bdpt::test::plan_safety_test
