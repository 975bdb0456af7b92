// Adaptive sampling as users see it.

#include <bdpt/io/gltf.h>
#include <bdpt/io/part_file.h>
#include <bdpt/renderer.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "../scene_files.h"
#include "../subprocess.h"
#include "catch.hpp"
#include "image_files.h"
#include "scratch_folder.h"

namespace bdpt::test::rates_test {
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

/// What of the render is the same in all tests.
Words scene_words(const ScratchFolder& folder, const std::string& integrator = "bdpt")
{
    write_cube(folder, "cube", {});
    return {path(folder, "cube.gltf"),
            "--size",
            "24x16",
            "--max-depth",
            "4",
            "--integrator",
            integrator};
}

void succeed(const Words& words)
{
    const Outcome outcome = run(words);
    CAPTURE(words, outcome.out, outcome.err);
    CHECK(outcome.exit_code == 0);
}

void render(const ScratchFolder& folder, const Words& more)
{
    succeed(joined(joined({"render"}, scene_words(folder)), more));
}

/// One line with all of `texts`, and no image.
void check_refused(const ScratchFolder& folder, const Words& more, int code, const Words& texts)
{
    const Outcome outcome =
        run(joined(joined({"render"}, scene_words(folder)),
                   joined({"-o", path(folder, "refused.exr"), "--quiet"}, more)));
    CAPTURE(more, outcome.out, outcome.err);
    CHECK(outcome.exit_code == code);
    for (const std::string& text : texts) {
        CHECK(outcome.err.find(text) != std::string::npos);
    }
    CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
    CHECK_FALSE(fs::exists(folder / "refused.exr"));
}

std::vector<Rgb> pixels(const ScratchFolder& folder, const std::string& name)
{
    return read_exr(folder / name).image.pixels;
}

std::string bytes_of(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("the library renders the command's default image to the bit", "[command]")
{
    const ScratchFolder folder;
    const std::string file = std::string(BDPT_SOURCE_DIR) + "/scenes/alpha.gltf";
    const auto by_command = [&](const Words& more) {
        succeed(
            joined({"render", file, "--size", "128x128", "-o", path(folder, "image.exr")}, more));
        return pixels(folder, "image.exr");
    };
    const std::vector<Rgb> expected = by_command({"--spp", "16"});
    io::LoadedScene loaded = io::load_gltf(file);
    const Scene scene(std::move(loaded.scene));
    const CameraDesc& camera = loaded.cameras.at(0);
    RenderOptions options{.film = {.width = 128, .height = 128},
                          .sampling = {.samples = {.begin = 0, .end = 16}, .planned_samples = 16}};
    REQUIRE(chosen_options(scene, camera, options).sampling.rates);
    CHECK(bdpt::render(scene, camera, options).image().pixels == expected);
    CHECK(by_command({"--spp", "16", "--save-rates", path(folder, "rates.exr")}) == expected);
    CHECK(io::read_rates(folder / "rates.exr") ==
          *chosen_options(scene, camera, options).sampling.rates);
    CHECK(by_command({"--spp", "16", "--rates", path(folder, "rates.exr")}) == expected);
    Renderer renderer(scene, camera, options);
    renderer.render(11);  // which takes two whole groups of 8
    CHECK(renderer.samples() == 16);
    CHECK(renderer.image().pixels == expected);
    // What the command does without rates, the library does with the choice alone.
    CHECK(bdpt::render(scene, camera, choose_integrator(scene, camera, options).options)
              .image()
              .pixels == by_command({"--spp", "16", "--adaptive=false"}));
    options.sampling.samples = {.begin = 0, .end = 15};
    options.sampling.planned_samples = 15;
    CHECK(bdpt::render(scene, camera, options).image().pixels == by_command({"--spp", "15"}));
}

TEST_CASE("adaptive renders, their saved rates and their parts make the same pixels", "[command]")
{
    const ScratchFolder folder;
    const std::string rates = path(folder, "rates.exr");
    render(folder, {"--spp", "16", "--adaptive", "-o", path(folder, "whole.exr"), "--save-rates",
                    rates, "--stats", path(folder, "stats.json")});
    const std::vector<Rgb> whole = pixels(folder, "whole.exr");

    const json stats = json::parse(std::ifstream(folder / "stats.json"));
    CHECK(stats["settings"]["rates"]["pilot_samples"] == 8);
    CHECK(stats["settings"]["rates"]["mean"] <= 1.0);
    CHECK(stats["settings"]["rates"]["mean"] > 0.99);
    CHECK(stats["settings"]["rates"]["greatest"] > stats["settings"]["rates"]["least"]);

    render(folder, {"--spp", "16", "--rates", rates, "-o", path(folder, "again.exr"),
                    "--save-rates", path(folder, "rates.png"), "--seed", "0"});
    CHECK(pixels(folder, "again.exr") == whole);
    CHECK(bytes_of(folder / "rates.png").substr(1, 3) == "PNG");
    render(folder, {"--spp", "16", "-o", path(folder, "uniform.exr")});
    CHECK(pixels(folder, "uniform.exr") != whole);

    // A part that goes on, and one that another machine makes.
    render(folder, {"--spp", "16", "--samples", "0:8", "--adaptive", "--part",
                    path(folder, "a.part.exr"), "--aov", "samples"});
    render(folder, {"--spp", "16", "--samples", "8:16", "--rates", rates, "--part",
                    path(folder, "b.part.exr"), "--aov", "samples"});
    succeed({"merge", path(folder, "a.part.exr"), path(folder, "b.part.exr"), "-o",
             path(folder, "merged.exr")});
    CHECK(pixels(folder, "merged.exr") == whole);
    const std::vector<Rgb> each = pixels(folder, "rates.exr");
    const std::vector<float> counts = read_exr_channel(folder / "merged.exr", "sampleCount.Y");
    REQUIRE(counts.size() == each.size());
    for (std::size_t i = 0; i < each.size(); ++i) {
        CHECK(counts[i] == 16.0f * each[i].r);
    }
    render(folder, {"--spp", "16", "--adaptive", "--part", path(folder, "a.part.exr"), "--aov",
                    "samples", "-o", path(folder, "went_on.exr")});
    CHECK(pixels(folder, "went_on.exr") == whole);
}

TEST_CASE("tasks of an adaptive plan take the rates of the plan", "[command]")
{
    const ScratchFolder folder;
    const std::string file = path(folder, "job/plan.json");
    const auto plan = [&](const Words& more) {
        return run(joined(joined({"plan"}, scene_words(folder)),
                          joined({"--spp", "24", "--for", "make", "-d", path(folder, "job"), "-o",
                                  path(folder, "out.exr")},
                                 more)));
    };
    CHECK(plan({"--adaptive", "--parts", "4"}).exit_code == 2);
    const Outcome outcome = plan({"--adaptive", "--parts", "3"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(fs::exists(folder / "job/rates.exr"));
    for (const char* task : {"2", "0", "1"}) {
        succeed({"render", "--plan", file, "--task", task});
    }
    succeed({"merge", "--plan", file});
    render(folder, {"--spp", "24", "--adaptive", "-o", path(folder, "alone.exr")});
    CHECK(pixels(folder, "out.exr") == pixels(folder, "alone.exr"));
    // The same plan again is no other plan.
    CHECK(plan({"--adaptive", "--parts", "3"}).exit_code == 0);

    // Rates that changed on one machine.
    render(folder, {"--spp", "8", "--env", "none", "--adaptive", "--seed", "3", "-o",
                    path(folder, "other.exr"), "--save-rates", path(folder, "job/rates.exr")});
    const std::string rates = bytes_of(folder / "job/rates.exr");
    const Outcome changed = run({"render", "--plan", file, "--task", "1", "--restart"});
    CAPTURE(changed.err);
    CHECK(changed.exit_code == 4);
    CHECK(changed.err.find("option: rates") != std::string::npos);
}

TEST_CASE("auto gives noisy pixels more samples where that helps", "[command][long]")
{
    const ScratchFolder folder;
    const Words words{BDPT_SOURCE_DIR "/scenes/alpha.gltf", "--size", "128x128", "--max-depth",
                      "4"};
    const auto image = [&](const std::string& name, const Words& more) {
        succeed(joined(joined({"render"}, words), joined({"-o", path(folder, name), "--quiet",
                                                          "--stats", path(folder, "stats.json")},
                                                         more)));
        return pixels(folder, name);
    };
    const auto rates = [&] {
        return json::parse(std::ifstream(folder / "stats.json"))["settings"].value("rates", json());
    };
    const std::vector<Rgb> whole = image("whole.exr", {"--spp", "16"});
    REQUIRE(rates().is_object());
    CHECK(rates()["least"] == 0.5);
    CHECK(rates()["greatest"] == 2.0);
    CHECK(rates()["pilot_samples"] == 0);
    CHECK((image("threads.exr", {"--spp", "16", "--threads", "1"}) == whole));

    for (const Words& equal : {Words{"--spp", "16", "--adaptive=false"}, Words{"--spp", "12"},
                               Words{"--samples", "4:20"}, Words{"--spp", "16", "--time", "1h"},
                               Words{"--spp", "16", "--integrator", "mis"}}) {
        CAPTURE(equal);
        CHECK((image("equal.exr", equal) != whole));
        CHECK(rates().is_null());
    }

    // Parts have them too, if they can.
    image("a.exr", {"--spp", "16", "--samples", "0:8", "--part", path(folder, "a.part.exr")});
    image("b.exr", {"--spp", "16", "--samples", "8:16", "--part", path(folder, "b.part.exr")});
    succeed({"merge", path(folder, "a.part.exr"), path(folder, "b.part.exr"), "-o",
             path(folder, "merged.exr")});
    CHECK((pixels(folder, "merged.exr") == whole));
    image("c.exr", {"--spp", "16", "--samples", "8:15", "--part", path(folder, "c.part.exr")});
    const Outcome mixed = run({"merge", path(folder, "a.part.exr"), path(folder, "c.part.exr"),
                               "-o", path(folder, "mixed.exr")});
    CAPTURE(mixed.err);
    CHECK(mixed.exit_code == 4);
    CHECK(mixed.err.find("rates") != std::string::npos);

    // A part that goes on has rates or not as it began, whatever --time says. From 20 samples on,
    // the pilot has its full size here, and makes the same choice for more.
    image("d.exr", {"--spp", "24", "--part", path(folder, "d.part.exr")});
    CHECK((image("d.exr", {"--spp", "32", "--time", "1h", "--part", path(folder, "d.part.exr")}) ==
           image("longer.exr", {"--spp", "32"})));
    image("e.exr", {"--spp", "24", "--time", "1h", "--part", path(folder, "e.part.exr")});
    CHECK((image("e.exr", {"--spp", "32", "--part", path(folder, "e.part.exr")}) ==
           image("equal.exr", {"--spp", "32", "--adaptive=false"})));

    // And tasks of plans, of one image and of several.
    const auto by_plan = [&](const Words& more, int tasks) {
        const std::string plan = path(folder, "job/plan.json");
        succeed(joined(joined({"plan"}, words),
                       joined({"--spp", "16", "--for", "make", "-d", path(folder, "job"),
                               "--restart", "--parts", std::to_string(tasks)},
                              more)));
        for (int task = 0; task < tasks; ++task) {
            succeed({"render", "--plan", plan, "--task", std::to_string(task)});
        }
        succeed({"merge", "--plan", plan});
    };
    by_plan({"-o", path(folder, "planned.exr")}, 2);
    CHECK(fs::exists(folder / "job/rates.exr"));
    CHECK((pixels(folder, "planned.exr") == whole));
    const std::vector<Rgb> equal = image("equal.exr", {"--spp", "16", "--adaptive=false"});
    by_plan({"-o", path(folder, "planned.exr")}, 3);
    CHECK((pixels(folder, "planned.exr") == equal));
    for (const int tasks : {4, 6}) {
        CAPTURE(tasks);
        by_plan({"--orbit", "2", "-o", path(folder, "planned.#.exr")}, tasks);
        CHECK_FALSE(fs::exists(folder / "job/rates.exr"));
        Words turn = joined(joined({"render"}, words),
                            {"--spp", "16", "--orbit", "2", "-o", path(folder, "turn.#.exr")});
        if (tasks > 4) {
            turn.emplace_back("--adaptive=false");
        }
        succeed(turn);
        for (const char* number : {"1", "2"}) {
            const std::string end = std::string(".") + number + ".exr";
            CHECK((pixels(folder, "planned" + end) == pixels(folder, "turn" + end)));
        }
    }
}

TEST_CASE("what does not go with rates is refused", "[command]")
{
    const ScratchFolder folder;
    const std::string rates = path(folder, "rates.exr");
    check_refused(folder, {"--adaptive", "--spp", "20"}, 2, {"--spp", "\"20\"", "multiples of 8"});
    check_refused(folder, {"--adaptive", "--samples", "4:16"}, 2,
                  {"--samples", "\"4:16\"", "multiples of 8"});
    check_refused(folder, {"--adaptive", "--integrator", "lt"}, 2, {"integrator lt"});
    check_refused(folder, {"--adaptive", "--integrator", "vcm"}, 2, {"integrator vcm"});
    check_refused(folder, {"--adaptive", "--rates", rates}, 2, {"--rates", "--adaptive"});
    check_refused(folder, {"--save-rates", rates}, 2,
                  {"--save-rates", "equally many", "--adaptive"});
    check_refused(folder, {"--adaptive=false", "--save-rates", rates}, 2,
                  {"--save-rates", "equally many"});
    check_refused(folder, {"--adaptive", "--save-rates", path(folder, "rates.jpg")}, 2,
                  {"rates.jpg", ".exr or .png"});
    check_refused(folder, {"--adaptive", "--save-rates", path(folder, "refused.exr")}, 2,
                  {"refused.exr"});
    check_refused(folder, {"--rates", rates}, 3, {"rates.exr"});

    render(folder, {"--size", "12x8", "--spp", "8", "--adaptive", "-o", path(folder, "small.exr"),
                    "--save-rates", rates});
    check_refused(folder, {"--rates", rates}, 4, {"rates.exr", "12x8", "24x16"});
    const std::string bytes = bytes_of(rates);
    std::ofstream(rates, std::ios::binary) << bytes.substr(0, bytes.size() - 30);
    check_refused(folder, {"--rates", rates}, 4, {"rates.exr"});
    std::ofstream(rates, std::ios::binary) << "no image";
    check_refused(folder, {"--rates", rates}, 5, {"rates.exr"});
    // An image, but not one of rates.
    check_refused(folder, {"--rates", path(folder, "small.exr")}, 4, {"small.exr", "pixel ("});
}

}  // namespace bdpt::test::rates_test
