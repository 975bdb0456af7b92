#include <cstddef>
#include <filesystem>
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

namespace bdpt::test::plan_sequence_test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using nlohmann::json;

std::string path(const ScratchFolder& folder, const std::string& name)
{
    return (folder / name).string();
}

Words joined(Words words, const Words& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

Outcome checked(Outcome outcome, int code = 0, const Words& texts = {})
{
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == code);
    for (const std::string& text : texts) {
        CAPTURE(text);
        CHECK(outcome.err.find(text) != std::string::npos);
    }
    return outcome;
}

/// A scene that moves, three frames of it, and how, but for samples.
Words sequence_of(const ScratchFolder& folder)
{
    fs::copy_file(BDPT_SOURCE_DIR "/scenes/motion.gltf", folder / "walk.gltf",
                  fs::copy_options::skip_existing);
    return {path(folder, "walk.gltf"),
            "--size",
            "16x9",
            "--env",
            "none",
            "--max-depth",
            "3",
            "--frames",
            "0:4:2",
            "--fps",
            "4"};
}

Words frames_of(const ScratchFolder& folder)
{
    return joined(sequence_of(folder), {"--spp", "4"});
}

Outcome plan(const ScratchFolder& folder, const Words& what, int parts, const Words& more = {})
{
    return run(joined(joined({"plan"}, what), joined({"--parts", std::to_string(parts), "--for",
                                                      "make", "-d", path(folder, "job")},
                                                     more)));
}

Outcome task(const ScratchFolder& folder, std::size_t number)
{
    return run({"render", "--plan", path(folder, "job/plan.json"), "--task", std::to_string(number),
                "--threads", "2"});
}

Outcome merge(const ScratchFolder& folder, const Words& more = {})
{
    return run(joined({"merge", "--plan", path(folder, "job/plan.json")}, more));
}

json plan_of(const ScratchFolder& folder)
{
    return json::parse(read_text(folder / "job" / "plan.json"));
}

std::vector<Rgb> pixels(const ScratchFolder& folder, const std::string& name)
{
    return read_exr(folder / name).image.pixels;
}

/// All tasks, the last one first.
void render_all(const ScratchFolder& folder)
{
    for (std::size_t number = plan_of(folder)["tasks"].size(); number-- > 0;) {
        checked(task(folder, number));
    }
}

TEST_CASE("the tasks of a plan make the frames of one render", "[plan]")
{
    const ScratchFolder folder;
    const Words what = joined(
        frames_of(folder), GENERATE(Words{}, Words{"--same-noise"}, Words{"--integrator", "lt"}));
    const int parts = GENERATE(1, 2, 7);
    checked(
        plan(folder, what, parts, {"-o", path(folder, "a.##.exr"), "-o", path(folder, "a.##.png")}),
        0, {"frames may flicker"});
    CHECK(plan_of(folder)["tasks"].size() == static_cast<std::size_t>(parts));
    render_all(folder);
    checked(merge(folder));
    checked(run(joined(joined({"render"}, what), {"-o", path(folder, "b.##.exr")})));
    for (const std::string frame : {"00", "02", "04"}) {
        CHECK(pixels(folder, "a." + frame + ".exr") == pixels(folder, "b." + frame + ".exr"));
        CHECK(read_exr(folder / ("a." + frame + ".exr")).integer("bdpt.spp") == 4);
        CHECK(fs::exists(folder / ("a." + frame + ".png")));
    }
    CHECK(read_exr(folder / "a.02.exr").integer("imageCounter") == 2);
}

TEST_CASE("a turntable and all cameras are planned as they are rendered", "[plan]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {.cameras = two_cameras});
    // Without --size the images of the cameras are of different ones, large ones.
    const Words turn{"--orbit",         "3",     "--cameras", "all",          "--crop",
                     "620,350,660,370", "--spp", "2",         "--integrator", "mis"};
    const Words what = joined({path(folder, "cube.gltf")}, turn);
    const int parts = GENERATE(4, 8);
    checked(plan(folder, what, parts, {"-o", path(folder, "a.{camera}.#.exr")}));
    render_all(folder);
    checked(merge(folder));
    checked(run(joined(joined({"render"}, what), {"-o", path(folder, "b.{camera}.#.exr")})));
    for (const std::string view : {"front.1", "side.1", "front.3", "side.3"}) {
        CHECK(pixels(folder, "a." + view + ".exr") == pixels(folder, "b." + view + ".exr"));
    }
    CHECK(plan_of(folder)["images"].size() == 6);
    CHECK(pixels(folder, "a.side.1.exr") != pixels(folder, "a.side.3.exr"));
}

TEST_CASE("merge writes the frames that are complete, and names the others", "[plan]")
{
    const ScratchFolder folder;
    checked(plan(folder, frames_of(folder), 6, {"-o", path(folder, "a.##.exr")}));
    const std::string file = path(folder, "job/plan.json");
    checked(merge(folder), 12,
            {"samples are missing: frame 0 to frame 4 (tasks 0-5 of " + file + ")"});
    checked(merge(folder, {"--partial"}), 12, {"frame 0 to frame 4"});
    for (const std::size_t number : {2U, 3U, 4U}) {
        checked(task(folder, number));
    }
    checked(merge(folder), 12,
            {"samples are missing: frame 0, frame 4 (tasks 0-1,5 of " + file + ")",
             "bdpt render --plan " + file + " --task 5; --partial"});
    CHECK_FALSE(fs::exists(folder / "a.00.exr"));
    CHECK(read_exr(folder / "a.02.exr").integer("bdpt.spp") == 4);
    CHECK_FALSE(fs::exists(folder / "a.04.exr"));
    checked(merge(folder, {"--partial"}), 0, {"samples are missing: frame 0 (tasks 0-1 of "});
    CHECK_FALSE(fs::exists(folder / "a.00.exr"));
    CHECK(read_exr(folder / "a.04.exr").integer("bdpt.spp") == 2);
    // The time to wait is for all frames together.
    checked(merge(folder, {"--wait=1s"}), 12, {"frame 0, frame 4"});
}

TEST_CASE("a task of several frames goes on where it ended, and needs no scene when done", "[plan]")
{
    const ScratchFolder folder;
    checked(plan(folder, frames_of(folder), 1, {"-o", path(folder, "a.##.exr")}));
    checked(task(folder, 0));
    const fs::path second = folder / "job" / "task-0.0002.part.exr";
    fs::remove(second);
    fs::rename(folder / "walk.gltf", folder / "hidden");
    checked(task(folder, 0), 3, {"walk.gltf"});
    fs::rename(folder / "hidden", folder / "walk.gltf");
    const auto third = read_text(folder / "job" / "task-0.0004.part.exr");
    checked(task(folder, 0), 0, {"frame 2 (2 of 3)"});
    CHECK(fs::exists(second));
    CHECK(read_text(folder / "job" / "task-0.0004.part.exr") == third);
    fs::remove(folder / "walk.gltf");
    checked(task(folder, 0));
}

TEST_CASE("frames are refused when a file is not what was planned", "[plan]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {.cameras = two_cameras});
    const Words what{path(folder, "cube.gltf"), "--size", "8x8", "--spp", "2", "--orbit", "2"};
    checked(run({"render", path(folder, "cube.gltf"), "--size", "8x4", "--spp", "1", "-o",
                 path(folder, "sky.exr")}));
    checked(plan(folder, joined(what, {"--env", path(folder, "sky.exr")}), 2,
                 {"-o", path(folder, "a.#.exr")}));
    const std::string buffer = read_text(folder / "cube.bin");
    write_text(folder / "cube.bin", buffer + " ");
    checked(task(folder, 1), 4, {"plan.json: is the plan of another render: file: cube.bin"});
    write_text(folder / "cube.bin", buffer);
    write_text(folder / "sky.exr", read_text(folder / "sky.exr") + " ");
    checked(task(folder, 1), 4, {"is the plan of another render: file: --env sky.exr"});
    CHECK_FALSE(fs::exists(folder / "job" / "task-1.0002.part.exr"));
}

TEST_CASE("the part of one frame does not pass for that of another", "[plan]")
{
    const ScratchFolder folder;
    const int parts = GENERATE(3, 6);  // in whole frames, and not
    checked(plan(folder, frames_of(folder), parts, {"-o", path(folder, "a.##.exr")}));
    checked(task(folder, 0));
    const json there = plan_of(folder);
    const auto last = static_cast<std::size_t>(parts) - 1;
    const std::string name = "job/task-" + std::to_string(last) + ".0004.part.exr";
    fs::copy_file(folder / "job" / "task-0.0000.part.exr", folder / name);
    checked(merge(folder, {"--partial"}), 4,
            {name + ": is of another render than ", "option: seed"});
    checked(task(folder, last), 4, {name + ": is a part of another render"});

    // Of the right seed and frame, but of another scene: it does not go with the others.
    checked(plan(folder, frames_of(folder), 6, {"-o", path(folder, "a.##.exr"), "--restart"}));
    checked(task(folder, 0));
    checked(run(joined(joined({"render"}, sequence_of(folder)),
                       {"--frames", "0", "--samples", "2:4", "--fov", "20", "--isa",
                        there["identity"]["build: instruction set"], "--part",
                        path(folder, "job/task-1.0000.part.exr")})));
    checked(merge(folder, {"--partial"}), 4, {"task-1.0000.part.exr", "camera: "});
}

TEST_CASE("another plan of frames is replaced with all its parts", "[plan]")
{
    const ScratchFolder folder;
    checked(plan(folder, frames_of(folder), 1, {"-o", path(folder, "a.##.exr")}));
    checked(task(folder, 0));
    checked(plan(folder, frames_of(folder), 2, {"-o", path(folder, "a.##.exr")}), 6,
            {"is another plan"});
    checked(plan(folder, frames_of(folder), 2, {"-o", path(folder, "a.##.exr"), "--restart"}));
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder / "job")) {
        names.insert(entry.path().filename().string());
    }
    CHECK(names == std::set<std::string>{"plan.json", "Makefile"});
}

TEST_CASE("words about plans of frames that make no sense are refused", "[plan]")
{
    const ScratchFolder folder;
    const Words what = frames_of(folder);
    const Words place{"-o", path(folder, "a.##.exr")};
    checked(plan(folder, what, 2, {"-o", path(folder, "a.exr")}), 2,
            {"a.exr: several frames need ####"});
    checked(plan(folder, what, 13, place), 2, {"--parts \"13\"", "12 samples of 3 images"});
    checked(plan(folder, joined(what, {"--cameras", "all"}), 2, place), 2, {"{camera}"});
    checked(plan(folder, joined(what, {"--part", "p.#.exr"}), 2, place), 2, {"--part"});
    checked(plan(folder, {path(folder, "walk.gltf"), "--frames", "1:2"}, 2, place), 2, {"--fps"});
    checked(plan(folder, {path(folder, "walk.gltf"), "--same-noise"}, 2, place), 2,
            {"--same-noise"});
    CHECK_FALSE(fs::exists(folder / "job"));

    checked(plan(folder, what, 3, place));
    checked(merge(folder, {"-o", path(folder, "one.exr")}), 2,
            {"one.exr: expected #### in the name, because the plan has 3 images"});
    checked(
        run({"render", "--plan", path(folder, "job/plan.json"), "--task", "0", "--frames", "1:1"}),
        2, {"--plan", "combined with --frames"});
    const auto broken = [&](const json& change) {
        json there = plan_of(folder);
        there.merge_patch(change);
        write_text(folder / "job" / "broken.json", there.dump());
        return run({"render", "--plan", path(folder, "job/broken.json"), "--task", "0"});
    };
    checked(broken({{"images", json::array()}}), 4,
            {"broken.json: /tasks/0/images: must be a range of the 0 images"});
    checked(broken({{"images", {{{"frame", 0}, {"seed", 1}}}}}), 4,
            {"broken.json: /tasks/1/images: must be a range of the 1 images, but is \"1:2\""});
    json images = plan_of(folder)["images"];
    images.push_back(images.back());
    checked(broken({{"images", images}}), 4, {"it has 4 images, but its options give 3"});
}

TEST_CASE("tasks share all images and samples out, and take about one time")
{
    job::Plan plan;
    plan.images.assign(5, job::PlanImage{.frame = 1, .seed = 1});
    for (const std::int64_t count : {1, 2, 4, 5, 6, 9, 40}) {
        const auto tasks = job::split_plan(plan, {.begin = 0, .end = 8}, count);
        CAPTURE(count);
        REQUIRE(tasks.size() == static_cast<std::size_t>(count));
        std::vector<SampleSet> samples(5);
        std::set<fs::path> parts;
        for (const job::PlanTask& task : tasks) {
            parts.insert(task.part);
            for (std::size_t i = 0; i < task.images; ++i) {
                SampleSet& there = samples.at(task.first_image + i);
                CHECK(there.overlap(SampleSet(task.samples)).empty());
                there.add(task.samples);
            }
        }
        CHECK(parts.size() == tasks.size());
        CHECK(samples == std::vector<SampleSet>(5, SampleSet({.begin = 0, .end = 8})));
    }
    const auto count = [](double seconds) {
        return job::tasks_of_time(10, {.begin = 0, .end = 64}, seconds, 1.0, 6.0);
    };
    CHECK(count(70.0) == 10);  // an image each
    CHECK(count(209.0) == 5);  // two
    CHECK(count(210.0) == 4);  // three
    CHECK(count(1e9) == 1);
    CHECK(count(38.0) == 20);  // half an image
    CHECK(count(0.0) == 640);
    CHECK(job::tasks_of_time(1, {.begin = 0, .end = 64}, 1e9, 1.0, 6.0) == 1);
}

}  // namespace
}  // namespace bdpt::test::plan_sequence_test
