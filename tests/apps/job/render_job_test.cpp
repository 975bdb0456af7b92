#include <bdpt/error.h>
#include <bdpt/job.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::render_job_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Returns the texts of the option `name`.
std::vector<std::string> texts(const RenderJob& job, const std::string& name)
{
    for (const JobSetting& setting : job.settings()) {
        if (setting.name == name) {
            return setting.texts;
        }
    }
    return {};
}

/// Returns the message of the error that `set()` throws.
std::string message(const std::string& name, const JobValue& value)
{
    RenderJob job("cube.glb");
    const RenderJob before = job;
    try {
        job.set(name, value);
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(job == before);
        return error.what();
    }
    return "";
}

TEST_CASE("a job has values of all kinds", "[job]")
{
    RenderJob job(fs::path("cube.glb"));
    job.set("spp", 3).set("spp", 64).set("output", {"a.exr", "b.png"}).set("denoise", true);
    job.set("size", {640, 480}).set("look_at", std::vector<JobValue>{0, 0.5, -1}).set("fov", 40.5f);
    job.set("seed", std::numeric_limits<std::uint64_t>::max()).set("clamp", HUGE_VAL);
    job.set("env", fs::path("sky.hdr")).set("camera", std::string("a \"b\""));
    job.set("exposure", -1.5).set("tone_map", "PBR-neutral").set("half", false);
    using Texts = std::vector<std::string>;
    CHECK(texts(job, "file") == Texts{"cube.glb"});
    CHECK(texts(job, "spp") == Texts{"64"});
    CHECK(texts(job, "output") == Texts{"a.exr", "b.png"});
    CHECK(texts(job, "denoise") == Texts{"true"});
    CHECK(texts(job, "size") == Texts{"640x480"});
    CHECK(texts(job, "look_at") == Texts{"0,0.5,-1"});
    CHECK(texts(job, "fov") == Texts{"40.5"});
    CHECK(texts(job, "seed") == Texts{"18446744073709551615"});
    CHECK(texts(job, "clamp") == Texts{"inf"});
    CHECK(texts(job, "env") == Texts{"sky.hdr"});
    CHECK(texts(job, "camera") == Texts{"a \"b\""});
    CHECK(texts(job, "exposure") == Texts{"-1.5"});
    CHECK(texts(job, "tone_map") == Texts{"pbr-neutral"});
    CHECK(texts(job, "half") == Texts{"false"});
    const std::size_t count = job.settings().size();
    CHECK(texts(job.set("half", nullptr).set("size", nullptr), "half").empty());
    CHECK(job.settings().size() == count - 2);
}

TEST_CASE("wrong names and values are told as the command tells them", "[job]")
{
    CHECK(message("sppp", 3) == R"(/"sppp": is not an option of a job (did you mean "spp"?))");
    CHECK(message("spp", 0) == "/spp: must be a whole number from 1 to 2147483648, but is 0");
    CHECK(message("spp", 1.5).starts_with("/spp: must be a whole number"));
    CHECK(message("spp", "64").starts_with("/spp: must be a whole number"));
    CHECK(message("spp", std::nan("")).starts_with("/spp: must be "));
    CHECK(message("sp", nullptr).find("is not an option of a job") != std::string::npos);
    CHECK(message("file", nullptr).starts_with("/file: must be "));
    CHECK(message("spp", {64}).starts_with("/spp: must be a text, a number"));
    CHECK(message("half", 7).starts_with("/half: must be "));
    CHECK(message("integrator", "ptt") ==
          R"(/integrator: must be pt, nee, mis, lt, bdpt, vcm or auto, but is "ptt")");
    CHECK(message("output", {"a.exr", {1, 2}}).starts_with("/output/1: must be a text"));
    CHECK(message("plan", "plan.json") == R"(/"plan": is not an option of a job)");
    CHECK(message("quiet", true) == R"(/"quiet": is not an option of a job)");
    CHECK(message("a\"b\n", 1).find("is not an option of a job") != std::string::npos);
    CHECK(message("file", "other.json").starts_with("/file: must be a scene, .gltf or .glb"));
    CHECK_THROWS_AS(RenderJob("other.json"), Error);
}

TEST_CASE("a job is written as a job file, and read from one", "[job]")
{
    const ScratchFolder folder;
    RenderJob job("sub/cube.glb");
    job.set("output", {"sub/out/a.exr", "b.png"}).set("spp", 8).set("half", true);
    job.set("size", {4, 3}).set("env", fs::path("/sky.hdr"));
    const json written = json::parse(job.to_json("sub"));
    CHECK(written == json{{"bdpt_job", 1},
                          {"file", "cube.glb"},
                          {"output", {"out/a.exr", "../b.png"}},
                          {"spp", 8},
                          {"half", true},
                          {"size", "4x3"},
                          {"env", "/sky.hdr"}});
    CHECK(RenderJob::from_json(job.to_json()) == RenderJob(job));
    CHECK(RenderJob::from_json(written.dump(), "sub").to_json() == job.to_json());
    write_text(folder / "a.json", job.to_json());
    const RenderJob again = RenderJob::from_file(folder / "a.json");
    CHECK(texts(again, "file") == std::vector<std::string>{folder / "sub/cube.glb"});
    CHECK(texts(again, "env") == std::vector<std::string>{"/sky.hdr"});

    const auto refused = [](const auto& read, ErrorCode code, const std::string& text) {
        try {
            static_cast<void>(read());
            FAIL("accepted");
        } catch (const Error& error) {
            CHECK(error.code() == code);
            CHECK(std::string(error.what()).find(text) != std::string::npos);
        }
    };
    refused([] { return RenderJob::from_json("{}"); }, ErrorCode::invalid_input, "is not a job");
    refused([] { return RenderJob::from_json(R"({"bdpt_job": 1, "spp": 3})"); },
            ErrorCode::invalid_input, "has no \"file\"");
    refused([] { return RenderJob::from_json(R"({"bdpt_job": 1, "file": "a.glb", "spp": 0})"); },
            ErrorCode::invalid_input, "/spp: must be a whole number");
    refused([&] { return RenderJob::from_file(folder / "no.json"); }, ErrorCode::not_found,
            "no.json");
}

TEST_CASE("a program decides what no file may decide", "[job]")
{
    RenderJob job("cube.glb");
    job.set("restart", true).set("denoiser_library", "lib").set("ktx_library", "lib");
    job.set("allow_folder", {"a", "b"});
    CHECK(job.settings().size() == 5);
    for (const char* name : {"restart", "denoiser_library", "ktx_library", "allow_folder"}) {
        CHECK(job.to_json().find(name) == std::string::npos);
        const json text{{"bdpt_job", 1}, {"file", "a.glb"}, {name, "x"}};
        CHECK_THROWS_AS(RenderJob::from_json(text.dump()), Error);
    }
}

}  // namespace
}  // namespace bdpt::test::render_job_test
