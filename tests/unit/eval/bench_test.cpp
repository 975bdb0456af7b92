#include <bdpt/error.h>
#include <bdpt/eval/bench.h>
#include <bdpt/eval/bench_report.h>
#include <bdpt/eval/metric.h>
#include <bdpt/io/read_image.h>
#include <bdpt/io/write_image.h>
#include <bdpt/render.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>

#include "bench_scene.h"
#include "catch.hpp"
#include "scratch_folder.h"
#include "test_images.h"

namespace bdpt::eval::bench_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ScratchFolder;

struct Fixture {
    SceneDesc desc = test::lit_floor();
    Scene scene{desc};
    ScratchFolder folder;
    BenchOptions options;

    Fixture()
    {
        options.integrators = {IntegratorKind::pt, IntegratorKind::bdpt};
        options.seconds = 0.004;
        options.seeds = 2;
        options.reference_seconds = 0.02;
        options.render.transport.max_depth = 3;
        options.strategy_depth = 2;
    }

    [[nodiscard]] BenchScene subject() const
    {
        return {.name = "floor",
                .file = "floor.gltf",
                .scene = scene,
                .camera = test::floor_camera(),
                .width = 12,
                .height = 9};
    }
    [[nodiscard]] SceneResult run(const BenchControl& control = {}) const
    {
        auto result = run_scene(subject(), options, folder.path(), control);
        REQUIRE(result);
        return *result;
    }
    [[nodiscard]] std::string failure() const
    {
        try {
            static_cast<void>(run_scene(subject(), options, folder.path(), {}));
        } catch (const Error& error) {
            return std::to_string(static_cast<int>(error.code())) + " " + error.what();
        }
        return "";
    }
    [[nodiscard]] fs::path run_file(const std::string& name) const
    {
        return folder.path() / "scenes" / "floor" / name;
    }
};

bool starts(const std::string& text, const std::string& head)
{
    CAPTURE(text);
    return text.rfind(head, 0) == 0;
}

TEST_CASE("a benchmark keeps runs, images and the reference, in turn")
{
    const Fixture bench;
    const SceneResult result = bench.run();
    CHECK(result.complete);
    REQUIRE(result.runs.size() == 4);
    CHECK(result.runs[0].integrator == IntegratorKind::pt);
    CHECK(result.runs[1].integrator == IntegratorKind::bdpt);
    CHECK(result.runs[2].integrator == IntegratorKind::pt);
    CHECK(result.runs[0].seed == 0);
    CHECK(result.runs[1].seed == 0);
    CHECK(result.runs[2].seed == 1);
    CHECK(result.reference_noise > 0.0);
    CHECK(fs::exists(result.reference_file));
    for (const char* name : {"pt-0", "pt-1", "bdpt-0", "bdpt-1"}) {
        CHECK(fs::exists(bench.run_file(std::string(name) + ".json")));
        CHECK(fs::exists(bench.run_file(std::string(name) + ".exr")));
    }
    const BenchGoals& goals = result.goals[1];
    CHECK(goals.equal_samples == [&] {
        std::int64_t power = 1;
        while (2 * power <= std::min(goals.equal_time, result.goals[0].equal_time)) {
            power *= 2;
        }
        return power;
    }());

    SECTION("an image is, to the bit, a render of just those samples")
    {
        RenderOptions options = bench.options.render;
        options.integrator = IntegratorKind::bdpt;
        options.film.width = 12;
        options.film.height = 9;
        options.sampling.seed = 1;
        options.sampling.samples = {0, goals.equal_time};
        options.sampling.planned_samples = 0;
        const Image whole = render(bench.scene, test::floor_camera(), options).film.develop();
        const Image kept =
            io::read_image(image_file(bench.folder.path(), "floor", IntegratorKind::bdpt, 1)).image;
        CHECK(kept.pixels == whole.pixels);
        // And its error is the one that was written down.
        const Image reference = io::read_image(result.reference_file).image;
        const auto point =
            std::find_if(result.runs[3].checkpoints.begin(), result.runs[3].checkpoints.end(),
                         [&](const Checkpoint& one) { return one.samples == goals.equal_time; });
        REQUIRE(point != result.runs[3].checkpoints.end());
        const auto error = [&](Metric metric) {
            return Approx(evaluate(metric, whole, reference,
                                   {.epsilon = 0.01, .epsilon_unit = EpsilonUnit::reference_mean}));
        };
        CHECK(point->relmse == error(Metric::relmse));
        CHECK(point->relmse_scales == error(Metric::relmse_scales));
    }
    SECTION("what people see is FLIP of all seeds at equal time")
    {
        const Image reference = io::read_image(result.reference_file).image;
        std::vector<double> flips;
        for (const std::uint64_t seed : {0U, 1U}) {
            const fs::path file =
                image_file(bench.folder.path(), "floor", IntegratorKind::bdpt, seed);
            flips.push_back(evaluate(Metric::flip, io::read_image(file).image, reference));
        }
        REQUIRE(result.visible.size() == 2);
        CHECK(result.visible[1].integrator == IntegratorKind::bdpt);
        CHECK(result.visible[1].flip.median == Approx(0.5 * (flips[0] + flips[1])));
        CHECK(result.visible[1].flip.greatest == Approx(std::max(flips[0], flips[1])));
        CHECK_FALSE(result.visible[1].denoised_flip);  // tests have no denoiser
        const auto summaries = summarize(result, bench.options.seconds);
        CHECK(summaries[1].flip->median == result.visible[1].flip.median);
    }
    SECTION("checkpoints rise in samples and time, and rays are those of all samples")
    {
        for (const BenchRun& run : result.runs) {
            for (std::size_t i = 1; i < run.checkpoints.size(); ++i) {
                CHECK(run.checkpoints[i].samples > run.checkpoints[i - 1].samples);
                CHECK(run.checkpoints[i].cpu_seconds > run.checkpoints[i - 1].cpu_seconds);
            }
            const auto samples = static_cast<std::uint64_t>(run.checkpoints.back().samples);
            CHECK(run.stats.paths.camera == 12 * 9 * samples);
            CHECK(run.stats.rays.camera >= run.stats.paths.camera);
        }
    }
    SECTION("strategies together have the light of the image")
    {
        const json strategies = json::parse(test::read_text(bench.run_file("strategies.json")));
        CHECK(strategies["depth"] == 2);
        double energy = 0.0;
        for (const json& one : strategies["strategies"]) {
            energy += one["weighted"]["energy"].get<double>();
            CHECK(one["weighted"]["variance"].get<double>() >= 0.0);
        }
        // There is next to no light after the second edge: the floor sees the lamp only.
        CHECK(energy == Approx(result.light_scale).epsilon(0.2));
    }
}

TEST_CASE("a benchmark goes on where it ended")
{
    Fixture bench;
    const SceneResult first = bench.run();
    const fs::path file = bench.run_file("pt-1.json");

    SECTION("runs that are there are not made again")
    {
        json kept = json::parse(test::read_text(file));
        kept["checkpoints"][0]["mape"] = 12345.0;
        test::write_text(file, kept.dump());
        const auto reference = fs::last_write_time(first.reference_file);
        const SceneResult second = bench.run();
        CHECK(second.runs[2].checkpoints[0].mape == 12345.0);
        CHECK(second.runs[0].checkpoints[0].cpu_seconds ==
              first.runs[0].checkpoints[0].cpu_seconds);
        CHECK(fs::last_write_time(first.reference_file) == reference);
    }
    SECTION("runs that are missing are")
    {
        fs::remove(file);
        const SceneResult second = bench.run();
        CHECK(fs::exists(file));
        CHECK(second.runs[2].checkpoints.back().relmse ==
              Approx(first.runs[2].checkpoints.back().relmse).epsilon(1e-9));
    }
    SECTION("more seeds and integrators may be asked for")
    {
        bench.options.seeds = 3;
        bench.options.integrators.push_back(IntegratorKind::lt);
        const SceneResult second = bench.run();
        CHECK(second.runs.size() == 9);
        CHECK(second.runs[0].checkpoints[0].cpu_seconds ==
              first.runs[0].checkpoints[0].cpu_seconds);
        CHECK(second.goals[2].equal_samples == first.goals[0].equal_samples);
    }
    SECTION("other options need another folder")
    {
        bench.options.render.transport.max_depth = 4;
        const std::string message = bench.failure();
        CHECK(starts(message, "2 "));
        CHECK(message.find("plan.json: holds runs with max_depth 3, not 4") != std::string::npos);
    }
    SECTION("so does another scene of the same name")
    {
        bench.desc.materials[0].base_color.r = 0.25f;
        bench.scene = Scene(bench.desc);
        CHECK(bench.failure().find("holds runs with scene") != std::string::npos);
    }
    SECTION("and another time")
    {
        bench.options.seconds = 0.005;
        CHECK(bench.failure().find("holds runs with cpu_seconds") != std::string::npos);
    }
}

TEST_CASE("what is broken in the folder is told, and nothing is made in its place")
{
    const Fixture bench;
    const SceneResult result = bench.run();
    const auto [file, text] =
        GENERATE(table<std::string, std::string>({{"pt-0.json", "{"},
                                                  {"pt-0.json", "{}"},
                                                  {"pt-0.json", R"({"integrator": "xyz"})"},
                                                  {"plan.json", "[1]"},
                                                  {"reference", "{}"},
                                                  {"reference", "\xff"},
                                                  {"reference image", "no image"}}));
    fs::path broken = bench.run_file(file);
    if (file.starts_with("reference")) {
        broken = result.reference_file;
        broken.replace_extension(file == "reference" ? ".json" : ".exr");
    }
    test::write_text(broken, text);
    const std::string message = bench.failure();
    CAPTURE(message);
    // What is no image at all is a file of an unknown kind.
    CHECK(starts(message, (file == "reference image" ? "5 " : "4 ") + broken.string() + ": "));
    CHECK(message.find('\n') == std::string::npos);
    CHECK(test::read_text(broken) == text);
}

TEST_CASE("a run under another name is found out")
{
    const Fixture bench;
    static_cast<void>(bench.run());
    fs::copy_file(bench.run_file("bdpt-0.json"), bench.run_file("bdpt-1.json"),
                  fs::copy_options::overwrite_existing);
    CHECK(starts(bench.failure(), "4 " + bench.run_file("bdpt-1.json").string()));
}

TEST_CASE("a given reference counts, and has to fit")
{
    Fixture bench;
    const fs::path file = bench.folder / "given.exr";
    bench.options.reference = file;
    CHECK(starts(bench.failure(), "3 "));

    io::write_exr(file, test::flat(12, 9, Rgb(0.5f)), {});
    const SceneResult result = bench.run();
    CHECK(result.reference_noise == 0.0);
    CHECK(result.light_scale == Approx(0.5));
    CHECK(result.reference_file == file);

    io::write_exr(file, test::flat(9, 12, Rgb(0.5f)), {});
    CHECK(bench.failure().find("has 9 x 12 pixels, but the scene is rendered with 12 x 9") !=
          std::string::npos);
    io::write_exr(file, test::flat(12, 9, Rgb(0.6f)), {});
    CHECK(bench.failure().find("holds runs with reference") != std::string::npos);
}

TEST_CASE("the variance layer of a given reference is its noise")
{
    Fixture bench;
    bench.options.reference = bench.folder.path();
    Layer variance{.name = "variance", .channels = "RGB", .width = 12, .height = 9, .values = {}};
    variance.values.assign(3 * 12 * 9, 0.02f);
    io::write_exr(bench.folder / "floor.exr", test::flat(12, 9, Rgb(2.0f)),
                  std::vector<Layer>{variance}, {});
    CHECK(bench.run().reference_noise == Approx(0.02 / (4.0 + 0.04)));
}

TEST_CASE("a benchmark that is stopped keeps what is finished")
{
    Fixture bench;
    std::stop_source stop;
    BenchControl control;
    control.stop = stop.get_token();
    control.on_progress = [&](const BenchProgress& progress) {
        if (progress.activity == "pt, seed 1") {
            stop.request_stop();
        }
    };
    bench.options.samples = 64;  // more than a pass, so that there is something to stop
    const SceneResult result = bench.run(control);
    CHECK_FALSE(result.complete);
    REQUIRE(result.runs.size() == 2);
    CHECK(fs::exists(bench.run_file("bdpt-0.json")));
    CHECK_FALSE(fs::exists(bench.run_file("pt-1.json")));
    CHECK(bench.run().complete);

    SECTION("and before there is a reference, nothing")
    {
        const Fixture other;
        CHECK_FALSE(run_scene(other.subject(), other.options, other.folder.path(), control));
        CHECK(fs::is_empty(other.folder.path() / "references"));
    }
}

TEST_CASE("progress ends with nothing left")
{
    const Fixture bench;
    BenchProgress last{.worked = -1.0, .left = 1.0, .activity = ""};
    BenchControl control;
    control.on_progress = [&](const BenchProgress& progress) {
        CHECK(progress.worked >= last.worked);
        last = progress;
    };
    static_cast<void>(bench.run(control));
    CHECK(last.left < 1e-6);
    CHECK(last.worked == Approx(planned_seconds(bench.options)));
}

TEST_CASE("JSON, CSV and page have all runs and what is needed to repeat them")
{
    const Fixture bench;
    BenchRecord record{.options = bench.options,
                       .machine = machine_facts(),
                       .started = "2024-01-01T00:00:00Z",
                       .command = "bdpt bench </script>",
                       .scenes = {bench.run()}};
    const json data = json::parse(bench_json(record));
    CHECK(data["options"]["cpu_seconds"] == 0.004);
    CHECK(data["machine"]["libraries"].get<std::string>().find("Embree ") != std::string::npos);
    const json& scene = data["scenes"][0];
    CHECK(scene["runs"].size() == 4);
    CHECK(scene["integrators"][1]["integrator"] == "bdpt");
    CHECK(scene["integrators"][1]["equal_time"]["relmse"]["median"].get<double>() > 0.0);
    CHECK(scene["integrators"][1]["equal_time"]["relmse_scales"]["median"].get<double>() > 0.0);
    CHECK(scene["integrators"][0]["speed_up"]["factor"] == 1.0);
    CHECK(scene["integrators"][1]["flip"]["median"].get<double>() > 0.0);
    CHECK(scene["integrators"][1]["flip_denoised"].is_null());

    const std::string csv = bench_csv(record);
    std::size_t points = 0;
    for (const BenchRun& run : record.scenes[0].runs) {
        points += run.checkpoints.size();
    }
    CHECK(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) == points + 1);
    const std::string head = csv.substr(0, csv.find('\n'));
    const std::string line = csv.substr(head.size() + 1, csv.find('\n', head.size() + 1));
    const auto fields = [](const std::string& text) {
        bool quoted = false;
        return std::count_if(text.begin(), text.end(), [&](char c) {
            quoted = quoted != (c == '"');
            return c == ',' && !quoted;
        });
    };
    CHECK(fields(head) >= 20);
    CHECK(fields(line.substr(0, line.find('\n'))) == fields(head));
    CHECK(starts(line, R"("floor","floor.gltf",)"));

    const std::string page = bench_page(record, bench.folder.path());
    CHECK(starts(page, "<!doctype html>"));
    CHECK(page.find("{{") == std::string::npos);
    const std::string open = R"(id="bench-data">)";
    const std::size_t begin = page.find(open) + open.size();
    const json embedded = json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    CHECK(embedded["command"] == "bdpt bench </script>");
    const json& images = embedded["scenes"][0]["pictures"];
    CHECK(images["images"].size() == 3);
    CHECK(images["variance"].size() == 2);
    CHECK(embedded["scenes"][0]["strategies"]["strategies"].size() >= 4);
    for (const char* outside : {"http://", "https://", "src=", "@import"}) {
        const std::size_t found = page.find(outside);
        CAPTURE(outside);
        CHECK(
            (found == std::string::npos || page.substr(found, 26) == "http://www.w3.org/2000/svg"));
    }
}

}  // namespace
}  // namespace bdpt::eval::bench_test
