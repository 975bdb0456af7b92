#include "options/option_list.h"

#include <bdpt/error.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "options/render_arguments.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::job_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Words = std::vector<std::string>;

/// A folder with a scene, and another one for jobs.
class Studio {
public:
    Studio()
    {
        write_cube(folder_, "cube", {.cameras = two_cameras});
        fs::create_directory(folder_ / "jobs");
    }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string write(const std::string& text) const
    {
        write_text(folder_ / "jobs" / "a.json", text);
        return path("jobs/a.json");
    }
    Outcome render(const std::string& job, Words more = {}) const
    {
        more.insert(more.begin(), {"render", write(job), "--quiet"});
        return run(more);
    }
    /// The message, which is one line, of a job that is refused with that exit code.
    std::string refused(const std::string& job, int code = 4, const Words& more = {}) const
    {
        const Outcome outcome = render(job, more);
        CAPTURE(job, outcome.err);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
        CHECK_FALSE(fs::exists(path("jobs/o.exr")));
        return outcome.err;
    }

private:
    ScratchFolder folder_;
};

std::string job_with(const std::string& members)
{
    return R"({"bdpt_job": 1, "file": "../cube.gltf", "output": ["o.exr"])" +
           (members.empty() ? "" : ", " + members) + "}";
}

TEST_CASE("a job renders what its options would, from wherever it is started", "[job]")
{
    const Studio studio;
    REQUIRE(studio
                .render(job_with(R"("spp": 3, "size": [16, 9], "seed": 5, "integrator": "bdpt",
                    "light_paths": 0.5, "from": [3, 2, 4], "look_at": "0,0,0", "half": true,
                    "filter": "tent", "env_intensity": 0.5)"))
                .exit_code == 0);
    REQUIRE(run({"render",
                 studio.path("cube.gltf"),
                 "-o",
                 studio.path("same.exr"),
                 "--spp",
                 "3",
                 "--size",
                 "16x9",
                 "--seed",
                 "5",
                 "--integrator",
                 "bdpt",
                 "--light-paths",
                 "0.5",
                 "--from",
                 "3,2,4",
                 "--look-at",
                 "0,0,0",
                 "--half",
                 "--filter",
                 "tent",
                 "--env-intensity",
                 "0.5",
                 "--quiet"})
                .exit_code == 0);
    CHECK(run({"compare", studio.path("jobs/o.exr"), studio.path("same.exr"), "--threshold",
               "mse=0", "--quiet"})
              .exit_code == 0);
}

TEST_CASE("options beside a job come before those in it", "[job]")
{
    const Studio studio;
    const std::string job = job_with(R"("spp": 3, "size": "16x9")");
    REQUIRE(studio.render(job, {"--spp", "1", "-o", studio.path("p.png")}).exit_code == 0);
    CHECK(fs::exists(studio.path("p.png")));
    CHECK_FALSE(fs::exists(studio.path("jobs/o.exr")));
    const Outcome wrong = studio.render(job, {"--samples", "0:1", "--noise", "2%"});
    CHECK(wrong.exit_code == 2);
    CHECK(wrong.err.find("--noise cannot be combined with --samples") != std::string::npos);
}

TEST_CASE("a saved job is what was typed, and renders that", "[job]")
{
    const Studio studio;
    const std::string saved = studio.path("jobs/saved.json");
    const Words typed{
        "--size",        "16x9",    "--spp",    "2",     "--seed",          "18446744073709551615",
        "--light-paths", "0.25",    "--camera", "auto",  "--denoise=layer", "--env",
        "none",          "--clamp", "1e3",      "--half"};
    Words words{
        "render", studio.path("cube.gltf"), "-o", studio.path("jobs/o.exr"), "--save-job", saved,
        "--quiet"};
    words.insert(words.end(), typed.begin(), typed.end());
    REQUIRE(run(words).exit_code == 0);
    CHECK_FALSE(fs::exists(studio.path("jobs/o.exr")));
    const json job = json::parse(read_text(saved));
    json expected = json::parse(R"({"bdpt_job": 1, "size": "16x9", "spp": 2,
        "seed": 18446744073709551615, "light_paths": 0.25, "camera": "auto", "denoise": "layer",
        "env": "none", "clamp": 1000.0, "half": true})");
    expected["file"] = studio.path("cube.gltf");
    expected["output"] = {studio.path("jobs/o.exr")};
    CHECK(job == expected);
    // What is saved of a job is that job.
    const std::string again = studio.path("jobs/again.json");
    REQUIRE(run({"render", saved, "--save-job", again, "--quiet"}).exit_code == 0);
    CHECK(read_text(again) == read_text(saved));
}

TEST_CASE("a job may not be saved where it would overwrite what it reads or writes", "[job]")
{
    const Studio studio;
    const Words words{"render", studio.path("cube.gltf"), "-o", studio.path("jobs/o.exr"),
                      "--save-job"};
    const auto refuse = [&](const std::string& file, int code, const Words& more = {}) {
        Words all = words;
        all.push_back(file);
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = run(all);
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == code);
    };
    refuse(studio.path("job.txt"), 2);
    refuse(studio.path("none/job.json"), 6);
    refuse(studio.path("cube.json"), 2, {"-o", studio.path("cube.json")});
}

TEST_CASE("a job without an output renders into the default one", "[job]")
{
    const Studio studio;
    const std::string job = studio.path("j.json");
    CHECK(run({"render", studio.path("cube.gltf"), "--size", "8", "--spp", "1", "--save-job", job})
              .exit_code == 0);
    fs::create_directory(studio.path("desk"));
    const Outcome outcome =
        run(Launch{.arguments = {"render", job}, .folder = studio.path("desk")});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(fs::exists(studio.path("desk/cube.png")));
}

TEST_CASE("a job writes only into its folder", "[job]")
{
    const Studio studio;
    fs::create_directory_symlink(studio.path(""), studio.path("jobs/up"));
    fs::create_symlink("../dangling.exr", studio.path("jobs/link.exr"));
    const std::string rest = R"("spp": 8, "size": "8x8", "integrator": "bdpt")";
    const auto job = [&](const std::string& option, const std::string& file) {
        return R"({"bdpt_job": 1, "file": "../cube.gltf", "adaptive": true, )" + rest + ", \"" +
               option + "\": \"" + file + "\"}";
    };
    const std::vector<std::pair<std::string, std::string>> outputs{
        {"output", ".exr"},     {"output", ".png"},     {"stats", ".json"},
        {"save_rates", ".exr"}, {"strategies", ".exr"}, {"part", ".exr"}};
    for (const auto& [option, end] : outputs) {
        for (const std::string& file : {"../x" + end, studio.path("x" + end), "up/x" + end,
                                        "new/../../x" + end, "../jobs-too/x" + end}) {
            const std::string message = studio.refused(job(option, file), 4);
            CHECK(message.find("jobs/a.json: --") != std::string::npos);
            CHECK(message.find("writes only into its folder") != std::string::npos);
        }
    }
    static_cast<void>(studio.refused(job("output", "link.exr"), 4));
    static_cast<void>(studio.refused(job("output", "{camera}/../../x.exr"), 4));
    CHECK_FALSE(fs::exists(studio.path("dangling.exr")));
    CHECK_FALSE(fs::exists(studio.path("cube.png")));
    // Who types names any file.
    const std::string out = studio.path("x.exr");
    CHECK(studio.render(job("output", "../x.exr"), {"-o", out}).exit_code == 0);
    CHECK(studio.render(job("stats", "../x.json"), {"-o", out, "--stats", studio.path("x.json")})
              .exit_code == 0);
    CHECK(fs::exists(studio.path("x.json")));
    const Outcome saved = run(
        {"render", studio.path("cube.gltf"), "-o", out, "--save-job", studio.path("jobs/s.json")});
    CHECK(saved.exit_code == 4);
    CHECK(saved.err.find("jobs/s.json: --output") != std::string::npos);
    CHECK_FALSE(fs::exists(studio.path("jobs/s.json")));
}

TEST_CASE("a job replaces files of bdpt, and no others", "[job]")
{
    const Studio studio;
    const std::string job =
        R"({"bdpt_job": 1, "file": "../cube.gltf", "output": ["o.exr", "o.png", "o.jpg", "o.hdr", "o.webp"],
            "stats": "s", "adaptive": true, "save_rates": "r.png", "strategies": "t.exr",
            "part": "p.part.exr", "spp": 8, "size": "8x8", "integrator": "bdpt"})";
    REQUIRE(studio.render(job).exit_code == 0);
    const Outcome again = studio.render(job);
    CAPTURE(again.err);
    CHECK(again.exit_code == 0);
    for (const char* name :
         {"o.exr", "o.png", "o.jpg", "o.hdr", "o.webp", "s", "r.png", "t.exr", "t.png"}) {
        const std::string file = studio.path("jobs/" + std::string(name));
        const std::string ours = read_text(file);
        for (const std::string& text : {std::string("thesis"), ours.substr(0, 8) + "theirs"}) {
            write_text(file, text);
            const Outcome refused = studio.render(job);
            CAPTURE(refused.err, name);
            CHECK(refused.exit_code == 6);
            CHECK(refused.err.find(file + ": cannot write: a job names it") != std::string::npos);
            CHECK(read_text(file) == text);
        }
        write_text(file, ours);
    }
    write_text(studio.path("jobs/o.exr"), "thesis");
    CHECK(studio.render(job, {"-o", studio.path("jobs/o.exr")}).exit_code == 0);
    // The scene of the job gives the default output its name.
    fs::create_directory(studio.path("desk"));
    const Launch launch{.arguments = {"render", studio.write(R"({"bdpt_job": 1, "spp": 1,
                            "size": 8, "file": "../cube.gltf"})")},
                        .folder = studio.path("desk")};
    CHECK(run(launch).exit_code == 0);
    CHECK(run(launch).exit_code == 0);
    write_text(studio.path("desk/cube.png"), "thesis");
    CHECK(run(launch).exit_code == 6);
    CHECK(read_text(studio.path("desk/cube.png")) == "thesis");
}

TEST_CASE("mistakes in a job are told with their place", "[job]")
{
    const Studio studio;
    const auto told = [&](const std::string& members, const std::string& text) {
        const std::string message = studio.refused(job_with(members));
        CAPTURE(members, message);
        CHECK(message.find("jobs/a.json: " + text) != std::string::npos);
    };
    told(R"("sppp": 3)", R"(/"sppp": is not an option of a job (did you mean "spp"?))");
    told(R"("spp": 0)", "/spp: must be a whole number from 1 to 2147483648, but is 0");
    told(R"("spp": "64")", "/spp: must be a whole number");
    told(R"("spp": 1.5)", "/spp: must be a whole number");
    told(R"("spp": [1])", "/spp: must be a text, a number, true or false");
    told(R"("spp": null)", "/spp: must be a text, a number, true or false");
    told(R"("half": 7)", "/half: must be ");
    told(R"("integrator": "ptt")", "/integrator: must be pt, nee, mis, lt, bdpt, vcm or auto");
    told(R"("look_at": [0, 1])", "/look_at: must be three numbers x,y,z");
    told(R"("size": [640, "x"])", "/size: must be WIDTHxHEIGHT");
    told(R"("denoise": true, "denoiser_library": "evil.so")",
         "/\"denoiser_library\": is not an option");
    told(R"("ktx_library": "evil.so")", "/\"ktx_library\": is not an option");
    told(R"("plan": "plan.json", "task": 0)", "/\"plan\": is not an option of a job");
    told(R"("quiet": true)", "/\"quiet\": is not an option of a job");
    const auto refused = [&](const std::string& text, const std::string& message, int code = 4) {
        CHECK(studio.refused(text, code).find(message) != std::string::npos);
    };
    refused(R"({"bdpt_job": 1, "file": "../cube.gltf", "output": ["o.exr", {}]})",
            "/output/1: must be a text");
    refused("[]", "is not a job");
    refused("{}", "has no \"bdpt_job\"");
    refused(R"({"bdpt_job": 2, "file": "x.gltf"})",
            "/bdpt_job: has format 2, of a newer bdpt; this program reads format 1");
    refused(R"({"bdpt_job": "1"})", "/bdpt_job: must be an integer");
    refused(R"({"bdpt_job": 1})", "has no \"file\"");
    refused(R"({"bdpt_job": 1, "file": "a.json", "output": "o.exr"})", "/file: must be a scene");
    refused(R"({"bdpt_job": 1, "file": "../cube.gltf", "spp": 1, "spp": 2})", "spp");
    refused(R"({"bdpt_job": 1, "file": "../none.gltf", "output": "o.exr"})", "no such file", 3);
    refused(R"({"bdpt_job": 1, "file": "../cube.gltf", "orbit": 4})", "--output is required", 2);
    refused(std::string(100'000, '['), "a.json");
    CHECK(run({"render", studio.path("jobs/none.json")}).exit_code == 3);
}

TEST_CASE("what a job means by a part that is missing can be typed", "[job]")
{
    const Studio studio;
    const std::string part = studio.path("jobs/p.part.exr");
    REQUIRE(studio
                .render(R"({"bdpt_job": 1, "file": "../cube.gltf", "part": "p.part.exr",
                    "samples": "0:2", "size": "8x8", "integrator": "mis"})")
                .exit_code == 0);
    const Outcome missing = run({"merge", part, "-o", studio.path("m.exr"), "--spp", "4"});
    CAPTURE(missing.err);
    CHECK(missing.exit_code == 12);
    CHECK(missing.err.find("cube.gltf") != std::string::npos);
    CHECK(missing.err.find("--samples 2:4") != std::string::npos);
    CHECK(missing.err.find("a.json") == std::string::npos);
}

}  // namespace
}  // namespace bdpt::test::job_test
