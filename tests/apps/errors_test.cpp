#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::errors_test {
namespace {

using Words = std::vector<std::string>;

/// Runs what must fail with `code`, in one line that contains `text`, without touching `folder`.
void check_error(const ScratchFolder& folder, const Words& words, int code, const std::string& text)
{
    const auto before = folder.names();
    const Outcome outcome = run(words);
    CAPTURE(words, outcome.err, outcome.out);
    CHECK(outcome.exit_code == code);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.starts_with("bdpt: error: "));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.err.find(text) != std::string::npos);
    CHECK(folder.names() == before);
}

TEST_CASE("wrong usage gives exit code 2 and names the option", "[long]")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    const std::string out = (folder / "out.exr").string();
    const auto rejects = [&](const Words& more, const std::string& text) {
        Words words{"render", scene, "-o", out};
        words.insert(words.end(), more.begin(), more.end());
        check_error(folder, words, 2, text);
    };
    check_error(folder, {scene, "-o", out}, 2, "unknown command \"" + scene + "\"");
    check_error(folder, {"render", "-"}, 2, "--output is required");
    check_error(folder, {"render", scene, "--orbit", "4"}, 2, "--output is required");
    check_error(folder, {"render", "-o", out}, 2, "file is required");
    check_error(folder, {"info"}, 2, "file is required");
    check_error(folder, {"--frobnicate"}, 2, "unknown option --frobnicate");
    rejects({"--frobnicate"}, "unknown option --frobnicate");
    rejects({"--intergrator", "pt"}, "did you mean --integrator?");
    rejects({"another.gltf"}, "out.exr: several scenes would write it");
    rejects({"--size", "0x0"}, "--size \"0x0\"");
    // The next word is not taken for the value that is missing.
    rejects({"--size=", "16x16"}, "--size \"\"");
    rejects({"--aov=", "--quiet"}, "--aov \"\"");
    rejects({"--size", "640;480"}, "--size \"640;480\"");
    rejects({"--size", "640x480x3"}, "--size");
    rejects({"--size", "-5x5"}, "--size");
    rejects({"--size", "99999x1"}, "--size");
    rejects({"--spp", "0"}, "--spp");
    rejects({"--spp", "many"}, "--spp");
    rejects({"--time", "0s"}, "--time \"0s\"");
    rejects({"--time", "soon"}, "--time \"soon\"");
    rejects({"--time", "-5s"}, "--time");
    rejects({"--integrator", "magic"}, "--integrator");
    rejects({"--heuristic", "magic"}, "--heuristic");
    rejects({"--sampler", "magic"}, "--sampler");
    rejects({"--isa", "sse9"}, "--isa");
    rejects({"--max-depth", "0"}, "--max-depth");
    rejects({"--only", "some"}, "--only");
    rejects({"--only", "indirect", "--max-depth", "2"}, "--only indirect needs --max-depth 3");
    rejects({"--max-camera-depth", "-1"}, "--max-camera-depth");
    rejects({"--max-light-depth", "long"}, "--max-light-depth");
    rejects({"--light-paths", "-0.5"}, "--light-paths");
    rejects({"--light-paths", "few"}, "--light-paths");
    rejects({"--light-paths", "0", "--integrator", "lt"}, "--light-paths");
    rejects({"--light-paths", "0", "--connections", "1"}, "--connections");
    rejects({"--connections", "4097"}, "--connections");
    rejects({"--light-paths", "4097"}, "--light-paths");
    rejects({"--rr-start", "0"}, "--rr-start");
    rejects({"--env-sampling", "even"}, "--env-sampling");
    rejects({"--light-sampling", "bvh"}, "--light-sampling");
    rejects({"--light-samples", "0"}, "--light-samples");
    rejects({"--light-samples", "1025"}, "--light-samples");
    rejects({"--light-samples", "2", "--integrator", "lt"},
            "--light-samples cannot be combined with --integrator lt");
    rejects({"--disable", "s2"}, "--disable \"s2\"");
    rejects({"--disable", "s2t1,"}, "--disable \"s2t1,\"");
    rejects({"--connections", "2", "--integrator", "lt"},
            "--connections needs --integrator bdpt or vcm, not lt");
    for (const char* integrator : {"pt", "mis", "nee"}) {
        const std::string its = integrator;
        rejects({"--disable", "s2t1", "--integrator", its},
                "--disable needs --integrator bdpt, lt or vcm, not " + its);
        rejects({"--light-paths", "2", "--integrator", its},
                "--light-paths needs --integrator bdpt, lt or vcm, not " + its);
        rejects({"--connections", "0.5", "--integrator", its},
                "--connections needs --integrator bdpt or vcm, not " + its);
    }
    for (const char* integrator : {"pt", "lt", "bdpt"}) {
        const std::string its = integrator;
        rejects({"--merge-radius", "0.01", "--integrator", its},
                "--merge-radius needs --integrator vcm, not " + its);
        rejects({"--merge-alpha", "0.5", "--integrator", its},
                "--merge-alpha needs --integrator vcm, not " + its);
    }
    rejects({"--integrator", "vcm", "--merge-radius", "-0.1"}, "--merge-radius");
    rejects({"--integrator", "vcm", "--merge-radius", "nan"}, "--merge-radius");
    rejects({"--integrator", "vcm", "--merge-alpha", "0"}, "--merge-alpha \"0\"");
    rejects({"--integrator", "vcm", "--merge-alpha", "1.5"}, "--merge-alpha");
    rejects({"--integrator", "vcm", "--light-paths", "0"},
            "--integrator vcm needs --light-paths above 0");
    rejects({"--integrator", "vcm", "--heuristic", "maximum"},
            "--integrator vcm needs --heuristic power or balance, not maximum");
    rejects({"--integrator", "vcm", "--strategies", "s.exr"},
            "--strategies needs --integrator bdpt or lt, not vcm");
    rejects({"--lens-radius", "-1"}, "--lens-radius \"-1\"");
    rejects({"--lens-radius", "inf"}, "--lens-radius");
    rejects({"--f-stop", "0"}, "--f-stop \"0\"");
    rejects({"--f-stop", "nan"}, "--f-stop");
    rejects({"--f-stop", "2", "--lens-radius", "1"}, "--lens-radius");
    rejects({"--f-stop", "2", "--focus-distance", "0"}, "--focus-distance \"0\"");
    rejects({"--focus-distance", "2"}, "the camera has no lens");
    rejects({"--fov", "180"}, "--fov \"180\"");
    rejects({"--fov", "nan"}, "--fov");
    rejects({"--exposure", "nan"}, "--exposure");
    rejects({"--tone-map", "aces"}, "--tone-map");
    rejects({"--background", "reddish"}, "--background \"reddish\"");
    rejects({"--background", "#ff"}, "--background \"#ff\"");
    rejects({"--background", "0.5,0.5,1.5"}, "--background \"0.5,0.5,1.5\"");
    rejects({"--background", "1,1"}, "--background \"1,1\"");
    rejects({"--background", "#12345"}, "--background \"#12345\"");
    rejects({"--background", "#12345g"}, "--background");
    rejects({"--background", "#1234567"}, "--background");
    rejects({"--background", "# 12345"}, "--background");
    rejects({"--background", "#-12345"}, "--background");
    rejects({"--png-bits", "12"}, "--png-bits");
    rejects({"--env-rotation", "nan"}, "--env-rotation");
    rejects({"--env-rotation", "361"}, "--env-rotation \"361\"");
    rejects({"--env-intensity", "-1"}, "--env-intensity \"-1\"");
    rejects({"--env-intensity", "inf"}, "--env-intensity");
    rejects({"--fog", "-1"}, "--fog \"-1\"");
    rejects({"--fog", "nan"}, "--fog");
    rejects({"--fog", "inf"}, "--fog");
    rejects({"--fog", "1,2"}, "--fog \"1,2\"");
    rejects({"--fog", "1,2,-3"}, "--fog");
    rejects({"--fog", "1", "--fog-albedo", "1.5"}, "--fog-albedo \"1.5\"");
    rejects({"--fog", "1", "--fog-albedo", "0.5,0.5,x"}, "--fog-albedo");
    rejects({"--fog", "1", "--fog-anisotropy", "1"}, "--fog-anisotropy \"1\"");
    rejects({"--fog", "1", "--fog-anisotropy", "nan"}, "--fog-anisotropy");
    rejects({"--fog-albedo", "0.5"}, "--fog-albedo needs --fog");
    rejects({"--fog-anisotropy", "0.5"}, "--fog-anisotropy needs --fog");
    rejects({"--fog", "1", "--ground", "shadow", "--background", "black"},
            "--ground cannot be combined with --fog");
    rejects({"--look-at", "1,2"}, "--look-at \"1,2\"");
    rejects({"--from", "1,2,x"}, "--from \"1,2,x\"");
    rejects({"--from", "1,2,nan"}, "--from");
    rejects({"--from", "1,2,3", "--look-at", "1,2,3"}, "cannot look at its own position");
    rejects({"--seed", "-1"}, "--seed \"-1\"");
    rejects({"--seed", "18446744073709551616"}, "--seed");
    rejects({"--threads", "-1"}, "--threads");
    rejects({"--half", "--float"}, "--half");
    check_error(folder, {"render", scene, "-o", (folder / "out.gif").string()}, 2,
                "out.gif: unknown type");
    check_error(
        folder,
        {"render", scene, "--background", "transparent", "-o", (folder / "out.jpg").string()}, 2,
        "out.jpg: JPEG has no alpha");
    check_error(folder, {"render", scene, "-o", (folder / "out").string()}, 2, "unknown type");
}

TEST_CASE("an input is never overwritten by the output")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    const std::string sky = (folder / "sky.exr").string();
    write_text(sky, "precious");
    check_error(folder, {"render", scene, "--env", sky, "-o", sky}, 2,
                "cannot be both an input and an output");
    CHECK(read_text(sky) == "precious");
}

TEST_CASE("a missing input gives exit code 3 and names it")
{
    const ScratchFolder folder;
    const std::string out = (folder / "out.exr").string();
    const std::string scene = write_cube(folder, "cube", {.cameras = two_cameras}).string();
    const std::string missing = (folder / "missing.gltf").string();
    check_error(folder, {"render", missing, "-o", out}, 3, missing);
    check_error(folder, {"info", missing}, 3, missing);
    check_error(folder, {"render", scene, "-o", out, "--camera", "top"}, 3,
                "no camera \"top\"; this scene has 2 cameras: 0 \"front\", 1 \"side\"");
    check_error(folder, {"render", scene, "-o", out, "--camera", "2"}, 3, "no camera \"2\"");
    check_error(folder, {"render", scene, "-o", out, "--scene", "attic"}, 3, "attic");
    check_error(folder, {"render", scene, "-o", out, "--env", missing}, 3, missing);

    const std::string blind = write_cube(folder, "blind", {}).string();
    check_error(folder, {"render", blind, "-o", out, "--camera", "0"}, 3, "the scene has none");
    std::filesystem::remove(folder / "blind.bin");
    check_error(folder, {"render", blind, "-o", out}, 3, "blind.bin");
}

TEST_CASE("an invalid input gives exit code 4 and names it")
{
    const ScratchFolder folder;
    const std::string out = (folder / "out.exr").string();
    const std::string scene = write_cube(folder, "cube", {}).string();
    const std::string bad = (folder / "bad.gltf").string();
    const std::string whole = read_text(scene);
    std::string text;
    std::string expected = bad;
    SECTION("nothing") {}
    SECTION("half a file")
    {
        text = whole.substr(0, whole.size() / 2);
    }
    SECTION("broken JSON")
    {
        text = "{\"asset\": {\"version\": \"2.0\"},, }";
    }
    SECTION("half a GLB")
    {
        text = std::string("glTF\x02\0\0\0\x00\x10\0\0", 12) + "{}";
    }
    SECTION("an index out of range")
    {
        text = whole;
        const std::string_view good = "\"POSITION\": 0";
        text.replace(text.find(good), good.size(), "\"POSITION\": 9");
    }
    SECTION("an empty scene")
    {
        text = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]})";
        expected = "no triangles and no light with a radius\n";
    }
    SECTION("nothing but points")
    {
        text = whole;
        const std::string_view position = "\"attributes\"";
        text.replace(text.find(position), position.size(), "\"mode\": 0, \"attributes\"");
        expected = "a radius (/meshes/0/primitives/0: mode 0: points and lines are not rendered)";
    }
    write_text(bad, text);
    check_error(folder, {"render", bad, "-o", out}, 4, expected);
}

TEST_CASE("models in other formats are called by their names", "[other formats]")
{
    const ScratchFolder folder;
    const auto check_named = [&](const char* name, std::string_view bytes, const char* kind) {
        const std::filesystem::path file = folder / name;
        write_text(file, std::string(bytes));
        check_error(folder, {"render", file.string(), "-o", (folder / "o.exr").string()}, 4,
                    fmt::format("{}: not a glTF file but {}: export it as .glb first",
                                file.string(), kind));
    };
    check_named("m.obj", "mtllib m.mtl\nv 1 2 3\n", "a Wavefront OBJ file");
    check_named("m.STL", std::string(100, '\0'), "an STL file");
    check_named("m.dae", "<?xml version=\"1.0\"?><COLLADA/>", "a COLLADA file");
    // What may be glTF is read as that, whatever its name.
    write_text(folder / "g.obj", read_text(write_cube(folder, "cube", {})));
    CHECK(run({"info", (folder / "g.obj").string()}).exit_code == 0);
}

TEST_CASE("an unsupported required extension gives exit code 5 and names it")
{
    const ScratchFolder folder;
    const std::string scene =
        write_cube(folder, "cube", {.more = R"("extensionsUsed": ["ACME_magic"],
                               "extensionsRequired": ["ACME_magic"],)"})
            .string();
    check_error(folder, {"render", scene, "-o", (folder / "out.exr").string()}, 5, "ACME_magic");
}

TEST_CASE("an output that cannot be written gives exit code 6 before anything is rendered")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    // These would take years to render.
    const Words base{"render", scene, "--spp", "2000000000", "-o"};
    const auto rejects = [&](const std::string& out) {
        Words words = base;
        words.push_back(out);
        check_error(folder, words, 6, out + ": cannot write");
    };
    rejects((folder / "missing/out.exr").string());
    rejects("/proc/out.png");
    std::filesystem::create_directory(folder / "folder.exr");
    rejects((folder / "folder.exr").string());

    SECTION("also when it is only the second one")
    {
        check_error(folder,
                    {"render", scene, "--spp", "2000000000", "-o", (folder / "good.exr").string(),
                     "-o", (folder / "missing/out.png").string()},
                    6, "missing/out.png");
    }
}

TEST_CASE("a disk that fills up gives exit code 6 and leaves nothing")
{
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    const auto before = folder.names();
    const Outcome outcome =
        run(Launch{.arguments = {"render", scene, "--spp", "1", "--size", "64x36", "--quiet", "-o",
                                 (folder / "out.exr").string()},
                   .file_size = 2000});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 6);
    CHECK(outcome.err.find("File too large") != std::string::npos);
    CHECK(folder.names() == before);
}

TEST_CASE("too little memory gives exit code 7")
{
#ifdef BDPT_SANITIZED
    WARN("skipped: sanitizers need the address space");
#else
    const ScratchFolder folder;
    const std::string scene = write_cube(folder, "cube", {}).string();
    const auto before = folder.names();
    const Outcome outcome =
        run(Launch{.arguments = {"render", scene, "--size", "20000x20000", "--quiet", "--spp", "1",
                                 "-o", (folder / "out.exr").string()},
                   .address_space = rlim_t{4} << 30});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 7);
    CHECK(outcome.err.find("bdpt: error: the film of 20000x20000 pixels needs ") == 0);
    CHECK(outcome.err.find("(address space of the process, ulimit -v)\n") != std::string::npos);
    CHECK(folder.names() == before);
#endif
}

TEST_CASE("with --json an error is an event too")
{
    const ScratchFolder folder;
    const std::string missing = (folder / "missing.gltf").string();
    const auto check = [](const Outcome& outcome, int code) {
        CAPTURE(outcome.out, outcome.err);
        CHECK(outcome.exit_code == code);
        const auto event = nlohmann::json::parse(outcome.out);
        CHECK(event["event"] == "error");
        CHECK(event["code"] == code);
        CHECK(outcome.err == "bdpt: error: " + event["message"].get<std::string>() + "\n");
    };
    check(run({"render", missing, "--json", "-o", (folder / "out.exr").string()}), 3);
    check(run({"render", missing, "--json", "--wrong"}), 2);
}

}  // namespace
}  // namespace bdpt::test::errors_test
