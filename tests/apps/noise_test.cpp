#include <bdpt/noise.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "options/value_types.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::noise_test {
namespace {

using Words = std::vector<std::string>;

Outcome render(const ScratchFolder& folder, const Words& more)
{
    Words words{"render",       write_cube(folder, "cube", {.cameras = two_cameras}).string(),
                "--size",       "64x48",
                "--integrator", "mis",
                "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
}

/// The last event.
nlohmann::json done(const Outcome& outcome)
{
    CAPTURE(outcome.out, outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const std::size_t line = outcome.out.rfind('\n', outcome.out.size() - 2) + 1;
    return nlohmann::json::parse(outcome.out.substr(line));
}

TEST_CASE("a noise is a percentage or a fraction", "[noise]")
{
    CHECK(job::parse_share("2%") == 0.02);
    CHECK(job::parse_share("0.02") == 0.02);
    CHECK(job::parse_share("100%") == 1.0);
    CHECK(job::parse_share("2") == 0.02);
    CHECK(job::parse_share("1") == 0.01);
    CHECK(job::parse_share("1%") == 0.01);
    for (const char* word : {"", "%", "0", "0%", "-1%", "101%", "101", "2 %", "nan", "x%"}) {
        CAPTURE(word);
        CHECK_FALSE(job::parse_share(word));
    }
}

TEST_CASE("option --noise ends a render at a level of noise", "[noise]")
{
    const ScratchFolder folder;
    const std::string out = (folder / "out.exr").string();
    const std::string stats_file = (folder / "stats.json").string();
    const auto event = done(render(folder, {"--noise", "3%", "-o", out, "--stats", stats_file}));
    const auto samples = event["samples"].get<std::int64_t>();
    CHECK(event["noise"].get<double>() <= 0.03);
    CHECK(is_noise_look(samples));
    CHECK(samples < 65536);
    const auto stats = nlohmann::json::parse(read_text(stats_file));
    CHECK(stats["noise"] == event["noise"]);
    CHECK(stats["settings"]["noise_goal"] == 0.03);
    // The same, with other threads and from a part, in two runs.
    const std::string part = (folder / "p.part.exr").string();
    const std::string whole = std::to_string(samples);
    done(render(folder, {"--noise", "3%", "--spp", "19", "--part", part}));
    const std::string again = (folder / "again.exr").string();
    CHECK(done(render(folder, {"--noise", "3%", "--part", part, "-o", again, "--threads",
                               "1"}))["samples"] == samples);
    CHECK(read_exr(again).image.pixels == read_exr(out).image.pixels);
    // It has what was asked for, and nothing is rendered.
    const auto time = std::filesystem::last_write_time(part);
    done(render(folder, {"--noise", "3%", "--part", part}));
    CHECK(std::filesystem::last_write_time(part) == time);
    // What comes first counts.
    CHECK(done(render(folder, {"--noise", "3%", "--spp", "5", "-o", again}))["samples"] == 5);
    CHECK(done(render(folder, {"--noise", "3%", "--spp", "100000", "-o", again}))["samples"] ==
          samples);
}

TEST_CASE("a noise that cannot be told from one sample is called so", "[noise]")
{
    const ScratchFolder folder;
    const Outcome outcome =
        run({"render", write_cube(folder, "cube", {.cameras = two_cameras}).string(), "--size",
             "16x16", "--integrator", "mis", "--spp", "1", "--noise", "3%", "-o",
             (folder / "out.png").string()});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.find("the noise is not known after 1 sample per pixel") != std::string::npos);
    CHECK(outcome.err.find("are needed") == std::string::npos);
}

TEST_CASE("merge tells which samples are missing for a level of noise", "[noise]")
{
    const ScratchFolder folder;
    const std::string part = (folder / "p.part.exr").string();
    const std::string out = (folder / "out.exr").string();
    done(render(folder, {"--spp", "16", "--part", part}));
    const auto event = done(run({"merge", part, "-o", out, "--noise", "0.1%", "--json"}));
    const double noise = event["noise"].get<double>();
    CHECK(noise > 0.001);
    const std::int64_t needed = samples_for_noise(noise, 16, 0.001);
    CHECK(event["missing_for_noise"] == "16:" + std::to_string(needed));
    const Outcome told = run({"merge", part, "-o", out, "--noise", "0.1%"});
    CHECK(told.err.find("--samples 16:" + std::to_string(needed) + " --part") != std::string::npos);
    const auto enough = done(run({"merge", part, "-o", out, "--noise", "100%", "--json"}));
    CHECK(enough["missing_for_noise"] == "");
    CHECK(enough["noise"] == noise);
}

TEST_CASE("words about noise that make no sense are refused", "[noise]")
{
    const ScratchFolder folder;
    const std::string out = (folder / "out.exr").string();
    const auto refused = [&](const Words& words, const std::string& text) {
        const Outcome outcome = render(folder, words);
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find(text) != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(out));
    };
    refused({"-o", out, "--noise", "200"}, "--noise \"200\"");
    refused({"-o", out, "--noise", "-2%"}, "--noise \"-2%\"");
    refused({"-o", out, "--noise", "2%", "--samples", "0:64"},
            "--noise cannot be combined with --samples");
}

}  // namespace
}  // namespace bdpt::test::noise_test
