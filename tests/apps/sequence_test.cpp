#include <OpenEXR/ImfMatrixAttribute.h>
#include <bdpt/render_options.h>
#include <signal.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "options/groups/sequence_arguments.h"
#include "options/output_files.h"
#include "options/value_types.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::sequence_test {
namespace {

using job::FrameRange;
using Words = std::vector<std::string>;

const std::string moving_scene = BDPT_SOURCE_DIR "/scenes/motion.gltf";

/// Renders `scene` small, with the words `more`.
Outcome render(const std::string& scene, const Words& more)
{
    Words words{"render", scene,       "--size", "16x9",  "--spp", "2",           "--integrator",
                "mis",    "--threads", "2",      "--env", "none",  "--max-depth", "3"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
}

Outcome render_well(const std::string& scene, const Words& more)
{
    const Outcome outcome = render(scene, more);
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 0);
    return outcome;
}

std::vector<Rgb> pixels(const ScratchFolder& folder, const std::string& name)
{
    return read_exr(folder / name).image.pixels;
}

std::size_t lines_with(const std::string& text, const std::string& what)
{
    std::istringstream stream(text);
    std::size_t count = 0;
    for (std::string line; std::getline(stream, line);) {
        count += line.find(what) != std::string::npos ? 1U : 0U;
    }
    return count;
}

TEST_CASE("frames are a first, a last and a step, all whole", "[sequence]")
{
    CHECK(job::parse_frames("1:24") == FrameRange{.first = 1, .last = 24});
    CHECK(job::parse_frames("-3:9:4") == FrameRange{.first = -3, .last = 9, .step = 4});
    CHECK(job::parse_frames("7") == FrameRange{.first = 7, .last = 7});
    for (const char* word :
         {"", "1:", ":1", "2:1", "1:2:0", "1:2:-1", "1:2:3:4", "1.5:2", "a:b", "0:2000000"}) {
        CAPTURE(word);
        CHECK_FALSE(job::parse_frames(word));
    }
    CHECK(job::parse_rate("24") == 24.0);
    CHECK(job::parse_rate("24000/1001") == 24000.0 / 1001.0);
    for (const char* word : {"", "0", "-24", "24/0", "24/", "/2", "nan", "24fps", "1e300"}) {
        CAPTURE(word);
        CHECK_FALSE(job::parse_rate(word));
    }
}

TEST_CASE("names of files take a number and a camera", "[sequence]")
{
    CHECK(job::with_number("a#b/out.####.exr", 12) == "a#b/out.0012.exr");
    CHECK(job::with_number("out.##.exr", 12345) == "out.12345.exr");
    CHECK(job::with_number("out.####.exr", -5) == "out.-0005.exr");
    CHECK(job::with_number("out.exr", 5) == "out.exr");
    CHECK_THROWS_AS(job::with_number("shot#2.####.exr", 1), job::OptionError);
    CHECK(job::with_camera("{camera}/out.{camera}.exr", "a") == "{camera}/out.a.exr");
    CHECK(job::with_camera("{camera}.exr", "../etc/x\n\\y") == "_._etc_x__y.exr");
    CHECK(job::with_camera("{camera}.exr", "{camera}") == "{camera}.exr");
}

TEST_CASE("a frame has the pixels of its time, and its own noise", "[sequence]")
{
    const ScratchFolder folder;
    const std::string pattern = (folder / "f.####.exr").string();
    const Outcome outcome = render_well(
        moving_scene, {"--frames", "0:4:2", "--fps", "4", "--seed", "3", "-o", pattern});
    CHECK(folder.names() == std::set<std::string>{"f.0000.exr", "f.0002.exr", "f.0004.exr"});
    CHECK(lines_with(outcome.err, "bdpt: frame ") == 3);
    CHECK(lines_with(outcome.err, "(--max-depth)") == 1);
    CHECK(lines_with(outcome.err, "") == 5);  // that and another one for all
    CHECK(outcome.err.find("frame 2 (2 of 3): 2 spp in") != std::string::npos);
    const std::string alone = (folder / "alone.exr").string();
    for (const int frame : {0, 2, 4}) {
        const auto seed = seed_of_frame(3, frame);
        const std::string time = std::to_string(0.25 * frame);
        render_well(moving_scene,
                    {"--frame-time", time, "--seed", std::to_string(seed), "-o", alone});
        const std::string name = "f.000" + std::to_string(frame) + ".exr";
        CHECK(pixels(folder, name) == pixels(folder, "alone.exr"));
        const ExrFile exr = read_exr(folder / name);
        CHECK(exr.integer("imageCounter") == frame);
        CHECK(Imf::framesPerSecond(exr.header).n == 4);
        CHECK(Imf::framesPerSecond(exr.header).d == 1);
        CHECK(exr.text("bdpt.frame") == std::to_string(frame));
    }
    CHECK(pixels(folder, "f.0000.exr") != pixels(folder, "f.0002.exr"));
    // One of them by itself, with the seed of all, and from another moment on.
    render_well(moving_scene, {"--frames", "1:1", "--fps", "4", "--same-noise", "--frame-time",
                               "0.25", "-o", alone});
    render_well(moving_scene, {"--frame-time", "0.5", "-o", (folder / "b.exr").string()});
    CHECK(pixels(folder, "alone.exr") == pixels(folder, "b.exr"));
}

TEST_CASE("a turntable goes around what the camera looks at", "[sequence]")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {.cameras = two_cameras}).string();
    const Words view{"--from", "1,2,5", "--look-at", "1,0,0"};
    const auto world_to_camera = [&](const std::string& name) {
        const ExrFile exr = read_exr(folder / name);
        return exr.header.typedAttribute<Imf::M44fAttribute>("worldToCamera").value();
    };
    Words words = view;
    words.insert(words.end(), {"--orbit", "4", "-o", (folder / "t.##.exr").string()});
    render_well(scene, words);
    // Counter-clockwise from above: from +z to +x.
    const std::vector<std::string> places{"1,2,5", "6,2,0", "1,2,-5", "-4,2,0"};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::string out = (folder / "alone.exr").string();
        render_well(scene, {"--from", places[i], "--look-at", "1,0,0", "-o", out});
        CAPTURE(i);
        CHECK(world_to_camera("t.0" + std::to_string(i + 1) + ".exr")
                  .equalWithAbsError(world_to_camera("alone.exr"), 1e-5f));
    }
    // Some views by themselves; without --look-at around what is in the middle of the view.
    const std::string third = (folder / "third.exr").string();
    words.insert(words.end(), {"--frames", "3:3", "-o", third});
    render_well(scene, words);
    CHECK(pixels(folder, "third.exr") == pixels(folder, "t.03.exr"));
    render_well(scene, {"--orbit", "2", "--frames", "2", "-o", third});
    CHECK(world_to_camera("third.exr")[3][2] == Approx(5.0f));  // the cube is 5 m away
    const Outcome away =
        render(scene, {"--from", "0,0,-5", "--orbit", "2", "--frames", "2", "-o", third});
    CHECK(away.exit_code == 2);
    CHECK(away.err.find("--look-at") != std::string::npos);
}

TEST_CASE("all cameras make images, named after them", "[sequence][long]")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {.cameras = two_cameras}).string();
    const auto render_all = [&](const std::string& file) {
        return run({"render", file, "--spp", "2", "--integrator", "mis", "--cameras", "all", "-o",
                    (folder / "all.{camera}.exr").string()});
    };
    const Outcome outcome = render_all(scene);
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.find("camera side (2 of 2): 2 spp") != std::string::npos);
    const ExrFile side = read_exr(folder / "all.side.exr");
    CHECK(side.image.width == side.image.height);  // as the camera has it
    for (const std::string camera : {"front", "side"}) {
        CHECK(run({"render", scene, "--spp", "2", "--integrator", "mis", "--camera", camera, "-o",
                   (folder / "one.exr").string()})
                  .exit_code == 0);
        CHECK(pixels(folder, "all." + camera + ".exr") == pixels(folder, "one.exr"));
    }
    const std::string twins =
        write_cube(folder, "twins",
                   {.cameras = R"({"name": "a/b", "camera": 0, "translation": [0, 0, 5]},
                                  {"name": "a_b", "camera": 1, "translation": [0, 0, 5]},)"})
            .string();
    const Outcome refused = render_all(twins);
    CHECK(refused.exit_code == 4);
    CHECK(refused.err.find("\"a/b\" and \"a_b\"") != std::string::npos);
    const Outcome none = render_all(write_cube(folder, "blind", {}).string());
    CHECK(none.exit_code == 3);
    CHECK(none.err.find("no camera") != std::string::npos);
}

TEST_CASE("frames that were killed go on with their parts", "[sequence]")
{
    const ScratchFolder folder;
    const Words whole{"--frames", "0:3", "--fps", "8", "-o", (folder / "a.#.exr").string()};
    render_well(moving_scene, whole);
    const Words kept{"--frames",
                     "0:3",
                     "--fps",
                     "8",
                     "--json",
                     "-o",
                     (folder / "b.#.exr").string(),
                     "--part",
                     (folder / "b.#.part.exr").string()};
    Words words{"render", moving_scene, "--size", "16x9",  "--spp", "2",           "--integrator",
                "mis",    "--threads",  "2",      "--env", "none",  "--max-depth", "3"};
    words.insert(words.end(), kept.begin(), kept.end());
    {
        Subprocess command(Launch{.arguments = words});
        command.wait_for(R"("event":"done","frame":1)");
        command.send(SIGKILL);
        command.finish();
    }
    CHECK(folder.names().contains("b.1.part.exr"));
    const Outcome outcome = render_well(moving_scene, kept);
    CHECK(lines_with(outcome.out, R"("event":"progress","frame":0)") == 0);
    CHECK(lines_with(outcome.out, R"("event":"progress","frame":1)") == 0);
    CHECK(lines_with(outcome.out, R"("event":"progress","frame":3)") > 0);
    for (const char* frame : {"0", "1", "2", "3"}) {
        const std::string end = std::string(".") + frame + ".exr";
        CHECK(pixels(folder, "a" + end) == pixels(folder, "b" + end));
    }
    // What merge says of samples that are missing is about this frame.
    const Outcome missing = run({"merge", (folder / "b.2.part.exr").string(), "-o",
                                 (folder / "m.exr").string(), "--spp", "4"});
    CHECK(missing.exit_code == 12);
    CHECK(missing.err.find("--frames 2:2 --samples 2:4") != std::string::npos);
    CHECK(run({"merge", (folder / "b.2.part.exr").string(), "-o", (folder / "m.exr").string()})
              .exit_code == 0);
    CHECK(read_exr(folder / "m.exr").integer("imageCounter") == 2);
}

TEST_CASE("a signal ends a sequence after the frame that it meets", "[sequence]")
{
    const ScratchFolder folder;
    Subprocess command(Launch{.arguments = {"render", moving_scene, "--size", "16x9", "--time",
                                            "600s", "--env", "none", "--frames", "5:9", "--fps",
                                            "8", "--json", "-o", (folder / "s.#.exr").string()}});
    command.wait_for(R"("event":"progress","frame":5)");
    command.send(SIGTERM);
    const Outcome outcome = command.finish();
    CHECK(outcome.exit_code == 143);
    CHECK(folder.names() == std::set<std::string>{"s.5.exr"});
}

TEST_CASE("words about several images that make no sense are refused", "[sequence]")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {.cameras = two_cameras}).string();
    const std::string many = (folder / "o.##.exr").string();
    const std::string one = (folder / "o.exr").string();
    const std::string camera = (folder / "o.{camera}.exr").string();
    const auto refused = [&](const Words& words, const std::string& text) {
        const Outcome outcome = render(scene, words);
        CAPTURE(words, outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find(text) != std::string::npos);
        CHECK(lines_with(outcome.err, "") == 1);
        CHECK(folder.names() == std::set<std::string>{"cube.bin", "cube.gltf"});
    };
    refused({"--frames", "1:2", "-o", many}, "--frames needs --fps or --orbit");
    refused({"--frames", "2:1", "--fps", "24", "-o", many}, "--frames \"2:1\"");
    refused({"--frames", "1:2", "--fps", "0", "-o", many}, "--fps \"0\"");
    refused({"--fps", "24", "-o", one}, "--fps needs --frames or --orbit");
    refused({"--same-noise", "-o", one}, "--same-noise");
    refused({"--orbit", "3", "-o", one}, one + ": several frames need #### in the name");
    refused({"--orbit", "3", "-o", many, "--stats", (folder / "s.json").string()}, "s.json");
    refused({"--orbit", "3", "-o", many, "--part", (folder / "p.part.exr").string()}, "p.part");
    refused({"--orbit", "0", "-o", many}, "--orbit");
    refused({"--orbit", "3", "--frames", "2:4", "-o", many}, "views from 1 to 3");
    refused({"--orbit", "2", "-o", (folder / "#.##.exr").string()}, "one run of #");
    refused({"--cameras", "all", "-o", one}, "{camera} in the name");
    refused({"--cameras", "all", "--camera", "front", "-o", camera},
            "--cameras cannot be combined with --camera");
    refused({"--cameras", "some", "-o", camera}, "--cameras");
}

}  // namespace
}  // namespace bdpt::test::sequence_test
