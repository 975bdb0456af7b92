#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "sealed_part.h"
#include "subprocess.h"

namespace bdpt::test::part_test {
namespace {

using Words = std::vector<std::string>;

/// `bdpt render` of a small cube, with the words `more`.
Words render_words(const ScratchFolder& folder, const Words& more)
{
    Words words{"render",       (folder / "cube.gltf").string(),
                "--size",       "24x16",
                "--integrator", "bdpt",
                "--max-depth",  "4",
                "--threads",    "2"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

Outcome render(const ScratchFolder& folder, const Words& more)
{
    const Outcome outcome = run(render_words(folder, more));
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 0);
    return outcome;
}

std::string path(const ScratchFolder& folder, const std::string& name)
{
    return (folder / name).string();
}

std::vector<Rgb> pixels(const ScratchFolder& folder, const std::string& name)
{
    return read_exr(folder / name).image.pixels;
}

/// The only line of a command that failed with `code` has all of `texts`.
void check_refused(const Outcome& outcome, int code, const Words& texts)
{
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == code);
    for (const std::string& text : texts) {
        CAPTURE(text);
        CHECK(outcome.err.find(text) != std::string::npos);
    }
    CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
}

TEST_CASE("a render goes on with its part, and has the pixels of one without", "[part]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    render(folder, {"-o", path(folder, "whole.exr"), "--spp", "12", "--aov", "albedo"});
    const std::string part = path(folder, "a.part.exr");
    render(folder, {"--part", part, "--spp", "12", "--samples", "0:5", "--aov", "albedo"});
    CHECK(folder.names() ==
          std::set<std::string>{"cube.bin", "cube.gltf", "whole.exr", "a.part.exr"});
    const Outcome second = render(
        folder, {"--part", part, "--spp", "12", "-o", path(folder, "a.exr"), "--aov", "albedo"});
    CHECK(second.err.find("resuming " + part + ": it has the samples 0:5") != std::string::npos);
    CHECK(second.err.find("wrote " + part + ": samples 0:12") != std::string::npos);
    CHECK(pixels(folder, "a.exr") == pixels(folder, "whole.exr"));
    CHECK(pixels(folder, "a.part.exr") == pixels(folder, "whole.exr"));

    // Complete: only images are written.
    const auto time = std::filesystem::last_write_time(part);
    const Outcome third = render(folder, {"--part", part, "--spp", "12", "-o",
                                          path(folder, "b.exr"), "--aov", "albedo", "--json"});
    CHECK(third.out.find("\"progress\"") == std::string::npos);
    CHECK(pixels(folder, "b.exr") == pixels(folder, "whole.exr"));
    CHECK(std::filesystem::last_write_time(part) == time);

    // More than were planned are of the same render, too.
    render(folder, {"--part", part, "--spp", "16", "--aov", "albedo"});
    CHECK(read_exr(part).integer("bdpt.spp") == 16);
}

TEST_CASE("what a part does not fit is refused by name, and --restart replaces it", "[part]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    const std::string part = path(folder, "a.part.exr");
    render(folder, {"--part", part, "--spp", "2"});
    const std::string before = read_text(part);
    const auto refused = [&](const Words& more, const std::string& what) {
        Words words{"--part", part, "--spp", "3", "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        check_refused(run(render_words(folder, words)), 4,
                      {part + ": is a part of another render: " + what, "--restart"});
        CHECK(read_text(part) == before);
    };
    refused({"--seed", "7"}, "option: seed (0, not 7)");
    refused({"--fov", "31"}, "camera: ");
    refused({"--env", "none"}, "scene: lights");
    refused({"--integrator", "mis"}, "option: integrator (bdpt, not mis)");

    write_text(part, before.substr(0, before.size() / 2));
    check_refused(run(render_words(folder, {"--part", part, "--spp", "3", "--quiet"})), 4,
                  {part + ": is not a part of a render", "--restart"});
    render(folder, {"--part", part, "--spp", "3", "--restart"});
    CHECK(read_exr(part).integer("bdpt.spp") == 3);
    // Also when what is there is sound, and ahead, and of another render.
    render(folder, {"--part", part, "--spp", "2", "--restart"});
    CHECK(read_exr(part).integer("bdpt.spp") == 2);
    render(folder, {"--part", part, "--spp", "1", "--restart", "--seed", "9"});
    CHECK(read_exr(part).integer("bdpt.spp") == 1);
}

TEST_CASE("parts of machines merge to the pixels of one render", "[part]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    const std::string integrator = GENERATE("bdpt", "lt", "mis");
    const auto part = [&](const std::string& range, const std::string& name) {
        render(folder, {"--spp", "12", "--samples", range, "--part", path(folder, name),
                        "--integrator", integrator, "--aov", "depth,alpha"});
        return path(folder, name);
    };
    render(folder, {"-o", path(folder, "whole.exr"), "--spp", "12", "--integrator", integrator,
                    "--aov", "depth,alpha"});
    const std::string a = part("0:3", "a.part.exr");
    const std::string b = part("3:7", "b.part.exr");
    const std::string c = part("9:12", "c.part.exr");
    const std::string out = path(folder, "out.exr");

    const Outcome missing = run({"merge", c, a, b, "-o", out});
    check_refused(missing, 12,
                  {"samples are missing: 7:9", "--integrator " + integrator, "--samples 7:9",
                   "--part " + path(folder, "7-9.part.exr")});
    CHECK_FALSE(std::filesystem::exists(out));
    CHECK(run({"merge", c, a, b, "-o", out, "--partial"}).exit_code == 0);
    CHECK(read_exr(out).integer("bdpt.spp") == 10);

    // In two steps, with one that is there twice and one that lies in another.
    const std::string d = part("7:9", "d.part.exr");
    const std::string e = part("4:6", "e.part.exr");
    const std::string ab = path(folder, "ab.part.exr");
    const Outcome step = run({"merge", b, a, a, e, "-o", ab});
    CAPTURE(step.err);
    CHECK(step.exit_code == 0);
    CHECK(step.err.find(a + ": skipped") != std::string::npos);
    CHECK(step.err.find(e + ": skipped") != std::string::npos);
    CHECK(run({"merge", d, ab, c, "-o", out, "-o", path(folder, "out.png")}).exit_code == 0);
    CHECK(pixels(folder, "out.exr") == pixels(folder, "whole.exr"));
    CHECK(read_exr(out).integer("bdpt.spp") == 12);
    CHECK(read_exr(out).header.channels().findChannel("depth.Z") != nullptr);
    CHECK(nlohmann::json::parse(read_exr(out).text("bdpt.settings"))["spp"] == 12);
    CHECK(read_exr(out).text("bdpt.scene") == "cube.gltf");

    // What lacks its end is noticed: by what the part wanted, or by what the user knows.
    check_refused(run({"merge", ab, d, "-o", out, "--spp", "13"}), 12, {"missing: 9:13"});
    const std::string overlap = part("5:10", "f.part.exr");
    check_refused(run({"merge", ab, overlap, "-o", out, "--quiet"}), 4, {ab, overlap, "5:7"});
    render(folder, {"--samples", "9:12", "--part", path(folder, "g.part.exr"), "--seed", "5",
                    "--integrator", integrator, "--aov", "depth,alpha"});
    check_refused(run({"merge", ab, path(folder, "g.part.exr"), "-o", out}), 4,
                  {"g.part.exr: is of another render than", "option: seed (5, not 0)"});
    check_refused(run({"merge", ab, path(folder, "cube.bin"), "-o", out}), 4, {"cube.bin"});
    check_refused(run({"merge", ab, "-o", ab}), 2, {"cannot be both an input and an output"});
}

TEST_CASE("a render that is killed, whenever, goes on to the same pixels", "[part]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    const Words how{"--size", "64x48", "--spp", "600"};
    const auto with = [&](Words words) {
        words.insert(words.begin(), how.begin(), how.end());
        return render_words(folder, words);
    };
    REQUIRE(run(with({"-o", path(folder, "whole.exr")})).exit_code == 0);
    std::mt19937 engine(std::random_device{}());
    std::uniform_int_distribution<int> delay(0, 40'000);  // [us]
    const std::string part = path(folder, "a.part.exr");
    int left_overs = 0;
    for (int round = 0; round < 12; ++round) {
        Subprocess command(Launch{.arguments = with({"--part", part, "--json"})});
        try {
            command.wait_for("\"progress\"");
            // Checkpoint after checkpoint, so that some of the kills meet a write.
            for (int i = 0; i < 6; ++i) {
                command.send(SIGUSR1);
                std::this_thread::sleep_for(std::chrono::microseconds(delay(engine) / 6));
            }
        } catch (const std::exception&) {
            break;  // done before it could be killed
        }
        command.send(SIGKILL);
        command.finish();
        left_overs += static_cast<int>(folder.names().size());
    }
    const Outcome last = run(with({"--part", part, "-o", path(folder, "a.exr")}));
    CAPTURE(last.err, left_overs);

    REQUIRE(last.exit_code == 0);
    CHECK(pixels(folder, "a.exr") == pixels(folder, "whole.exr"));
    CHECK(read_exr(part).integer("bdpt.spp") == 600);
}

TEST_CASE("SIGUSR1 writes a part, and the render goes on", "[part]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    const std::string part = path(folder, "a.part.exr");
    Subprocess command(Launch{
        .arguments = render_words(folder, {"--part", part, "--spp", "2000000000", "--json"})});
    command.wait_for("\"progress\"");
    command.send(SIGUSR1);
    command.wait_for("\"part\"");
    CHECK(read_exr(part).integer("bdpt.spp") > 0);
    command.send(SIGTERM);
    const Outcome outcome = command.finish();
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 143);
    const auto done =
        nlohmann::json::parse(outcome.out.substr(outcome.out.rfind('\n', outcome.out.size() - 2)));
    CHECK(done["stopped_by"] == "SIGTERM");
    CHECK(read_exr(part).integer("bdpt.spp") == done["samples"]);
}

TEST_CASE("a second SIGTERM does not keep the part from being written", "[part][long]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    const std::string part = path(folder, "a.part.exr");
    // One pass of this takes seconds.
    Subprocess command(
        Launch{.arguments = {"render", path(folder, "cube.gltf"), "--size", "1500x1500", "--spp",
                             "2000000000", "--threads", "1", "--part", part}});
    command.wait_for("camera auto");
    command.send(SIGTERM);
    command.wait_for("stopping after the current pass");
    command.send(SIGTERM);
    const Outcome outcome = command.finish();
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 143);
    CHECK(read_exr(part).integer("bdpt.spp") > 0);
    CHECK(folder.names() == std::set<std::string>{"cube.bin", "cube.gltf", "a.part.exr"});
}

TEST_CASE("a full disk costs a checkpoint, and the exit code only at the end", "[part]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    const std::string part = path(folder, "a.part.exr");
    render(folder, {"--part", part, "--spp", "1"});
    const std::string before = read_text(part);
    Subprocess command(
        Launch{.arguments = render_words(folder, {"--part", part, "--spp", "2000000000", "--json"}),
               .file_size = before.size() / 2});
    command.wait_for("\"progress\"");
    command.send(SIGUSR1);
    command.wait_for("the render continues");
    CHECK(read_text(part) == before);
    command.wait_for("\"progress\"");
    command.send(SIGTERM);
    const Outcome outcome = command.finish();
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 6);
    CHECK(outcome.out.find("File too large; the render continues") != std::string::npos);
    CHECK(read_text(part) == before);
    CHECK(folder.names() == std::set<std::string>{"cube.bin", "cube.gltf", "a.part.exr"});
}

TEST_CASE("words about parts that make no sense are refused", "[part]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    const auto refused = [&](const Words& more, const std::string& what) {
        check_refused(run(render_words(folder, more)), 2, {what});
    };
    refused({"--orbit", "4"}, "--output is required");
    refused({"--part", "a.png"}, "--part \"a.png\"");
    refused({"--restart", "-o", path(folder, "a.exr")}, "--restart");
    for (const char* range : {"4", "4:", ":4", "4:4", "5:4", "-1:4", "0:2,3:4", "0:4294967296"}) {
        refused({std::string("--samples=") + range, "--part", path(folder, "a.exr")}, "--samples");
    }
    refused({"--part", path(folder, "a.exr"), "-o", path(folder, "a.exr")}, "--part");
    check_refused(run({"merge", "-o", path(folder, "a.exr")}), 2, {"part is required"});
    check_refused(run({"merge", path(folder, "a.exr")}), 2, {"--output is required"});
    check_refused(run({"merge", path(folder, "x.exr"), "-o", path(folder, "a.exr")}), 3,
                  {"x.exr: no such file"});
}

TEST_CASE("a part that was given another film is refused by name", "[part]")
{
    const ScratchFolder folder;
    write_cube(folder, "cube", {});
    const std::string part = path(folder, "a.part.exr");
    render(folder, {"--part", part, "--spp", "2"});
    std::string bytes = read_text(part);
    const std::string truth = R"("size":[24,16])";
    const std::size_t place = bytes.find(truth);
    REQUIRE(place != std::string::npos);
    // Of the same length, so that all else stays in its place, and with a seal that holds.
    write_text(part, sealed_part(bytes.replace(place, truth.size(), R"("size":[25,16])")));
    check_refused(run(render_words(folder, {"--part", part, "--spp", "3", "--quiet"})), 4,
                  {part + ": the part's films are not those of its render", "--restart"});
}

}  // namespace
}  // namespace bdpt::test::part_test
