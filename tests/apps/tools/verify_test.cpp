#include "commands/commands.h"

#include <bdpt/eval/verify.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "report/reports.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::verify_test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

/// A room that shines.
class Room {
public:
    Room() : scene_(write_cube(folder_, "room", shining_room()).string()) {}

    Outcome verify(const Words& more) const
    {
        Words words{"verify", scene_, "--size", "8x8", "--grid", "2", "--max-depth", "3"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }

private:
    ScratchFolder folder_;
    std::string scene_;
};

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("verify: a sound renderer passes", "[long]")
{
    const Room room;
    // Time for it on any machine; it ends when it is sharp enough.
    const Outcome outcome = room.verify({"--bias", "20", "--time", "1h"});
    CHECK(outcome.exit_code == 0);
    CHECK(contains(outcome.out, "PASS: all agree"));
    CHECK(contains(outcome.out, "s=2 t=2"));
    CHECK_FALSE(contains(outcome.out, "s=4 t=0"));  // a pinhole is never hit
    CHECK(contains(outcome.err, "8x8"));
}

TEST_CASE("verify: too little time is inconclusive")
{
    const Room room;
    const Outcome outcome = room.verify({"--bias", "0.001", "--time", "0.001s", "--json"});
    CHECK(outcome.exit_code == 11);
    const json report = json::parse(outcome.out);
    CHECK(report["verdict"] == "inconclusive");
    CHECK(report["batches"].get<int>() >= 8);
    CHECK(report["strategies"].size() == 3 + 4 + 5);
    CHECK(room.verify({"--bias", "0.001", "--time", "0.001s", "-q"}).out.empty());
    CHECK(contains(room.verify({"--time", "0.001s"}).out, "too few samples"));
}

TEST_CASE("verify: options choose camera, light and seed as in render")
{
    const Room room;
    const auto radiance = [&](const Words& more) {
        Words words{"--time", "0.001s", "--json", "--bias", "0.001"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = room.verify(words);
        REQUIRE(outcome.exit_code == 11);
        return json::parse(outcome.out)["radiance"].get<double>();
    };
    const double plain = radiance({});
    CHECK(radiance({"--seed", "5"}) != plain);
    CHECK(radiance({"--camera", "1", "--seed", "0"}) != plain);
    CHECK(radiance({"--from", "0,0,0.5"}) != plain);
    CHECK(radiance({"--from", "0,0,5", "--look-at", "0,0,9", "--env", "default"}) <
          0.9 * plain);  // the sky alone
}

TEST_CASE("verify: light paths are chosen by hand or by auto", "[long]")
{
    const Room room;
    const auto report = [&](const Words& more) {
        Words words{"--time", "0.001s", "--json", "--bias", "0.001"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = room.verify(words);
        REQUIRE(outcome.exit_code == 11);
        return std::pair(json::parse(outcome.out)["radiance"].get<double>(), outcome.err);
    };
    const auto [plain, nothing] = report({});
    CHECK_FALSE(contains(nothing, "auto"));
    CHECK(report({"--light-paths", "1"}).first == plain);
    CHECK(report({"--light-paths", "0.25"}).first != plain);
    CHECK(report({"--light-paths", "0.25", "--connections", "2"}).first !=
          report({"--light-paths", "0.25"}).first);
    CHECK(report({"--light-paths", "0.25", "--connections", "2", "--connection-rays", "1"}).first !=
          report({"--light-paths", "0.25", "--connections", "2"}).first);
    // The words that the note has choose the same by hand; mis is verified as always.
    const auto [chosen, told] = report({"--integrator", "auto"});
    INFO(told);
    const std::regex note(
        "auto chooses (mis|bdpt --light-paths ([0-9.]+) --connections ([0-9.]+)"
        "( --connection-rays ([0-9.]+))?)\n");
    std::smatch words;
    REQUIRE(std::regex_search(told, words, note));
    CHECK(chosen == (words[1] == "mis"
                         ? plain
                         : report({"--light-paths", words[2], "--connections", words[3],
                                   "--connection-rays", words[5].matched ? words[5].str() : "0"})
                               .first));
}

TEST_CASE("verify: vcm is judged beside the rest if it is asked for")
{
    const Room room;
    const auto integrators = [&](const Words& more) {
        // One thread: several add errors up in any order.
        Words words{"--time", "0.001s", "--json", "--bias", "0.001", "-q", "--threads", "1"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = room.verify(words);
        CAPTURE(outcome.err);
        REQUIRE(outcome.exit_code == 11);
        return json::parse(outcome.out)["integrators"];
    };
    const json without = integrators({});
    const json by_default = integrators({"--integrator", "vcm"});
    REQUIRE(by_default.size() == without.size() + 1);
    CHECK(by_default.back()["integrator"] == "vcm");
    CHECK(by_default.back()["radiance"] > 0.0);
    for (std::size_t i = 0; i < without.size(); ++i) {
        CHECK(by_default[i] == without[i]);
    }
    CHECK(integrators({"--integrator", "vcm", "--merge-radius", "0.02"}) == by_default);
    CHECK(integrators({"--integrator", "vcm", "--merge-radius", "0.03"}) != by_default);
}

TEST_CASE("verify: light samples are those of the option, and agree with the rest", "[long]")
{
    const Room room;
    const auto report = [&](const Words& more, int code) {
        Words words{"--json", "-q"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = room.verify(words);
        CAPTURE(outcome.out);
        REQUIRE(outcome.exit_code == code);
        return json::parse(outcome.out);
    };
    const Words short_run{"--time", "0.001s", "--bias", "0.001"};
    const auto radiance = [&](const char* samples) {
        Words words = short_run;
        words.insert(words.end(), {"--light-samples", samples});
        return report(words, 11)["integrators"];
    };
    const json one = radiance("1");
    const json four = radiance("4");
    CHECK(one == report(short_run, 11)["integrators"]);
    for (const json& integrator : one) {
        const std::string name = integrator["integrator"];
        const auto same = std::find_if(four.begin(), four.end(), [&](const json& other) {
            return other["integrator"] == name;
        });
        REQUIRE(same != four.end());
        CAPTURE(name);
        CHECK(((*same)["radiance"] == integrator["radiance"]) == (name == "pt" || name == "lt"));
    }
    const json passed = report({"--bias", "20", "--time", "1h", "--light-samples", "4"}, 0);
    CHECK(passed["weights"]["wrong"] == 0);
}

TEST_CASE("verify: what makes no sense is refused")
{
    const Room room;
    for (const Words& words : {Words{"--bias", "0"},
                               Words{"--bias", "101"},
                               Words{"--bias", "x"},
                               Words{"--false-alarm", "-1"},
                               Words{"--time", "soon"},
                               Words{"--max-depth", "0"},
                               Words{"--max-depth", "65"},
                               Words{"--grid", "0"},
                               Words{"--size", "5000x4"},
                               Words{"--size", "big"},
                               Words{"--seed", "-1"},
                               Words{"--fov", "200"},
                               Words{"--integrator", "pt"},
                               Words{"--light-paths", "0"},
                               Words{"--light-paths", "-1"},
                               Words{"--connections", "x"},
                               Words{"--light-samples", "0"},
                               Words{"--light-samples", "1025"},
                               Words{"--light-samples", "2.5"},
                               Words{"--merge-radius", "0.1"},
                               Words{"--merge-radius", "2", "--integrator", "vcm"}}) {
        CAPTURE(words.front(), words.back());
        const Outcome outcome = room.verify(words);
        CHECK(outcome.exit_code == 2);
        CHECK(contains(outcome.err, words.front()));
        CHECK(outcome.out.empty());
    }
    CHECK(run({"verify", "/no/such/file.gltf"}).exit_code == 3);
    CHECK(run(Words{"verify"}).exit_code == 2);
}

TEST_CASE("verify: each verdict has its exit code")
{
    CHECK(app::exit_code(eval::Verdict::pass) == 0);
    CHECK(app::exit_code(eval::Verdict::fail) == 10);
    CHECK(app::exit_code(eval::Verdict::inconclusive) == 11);
}

TEST_CASE("verify: the text says what has failed, and where")
{
    eval::VerifyReport report;
    report.verdict = eval::Verdict::fail;
    report.radiance = 1.0;
    report.false_alarm = 1e-3;
    report.tiles = {{.x0 = 0, .y0 = 0, .x1 = 8, .y1 = 4}, {.x0 = 0, .y0 = 4, .x1 = 8, .y1 = 8}};
    report.lengths = {{.edges = 1, .radiance = 1.0}};
    const eval::MeanComparison sound{.found = 1.0, .expected = 1.0};
    const eval::MeanComparison wrong{
        .found = 1.5, .expected = 1.0, .error = 0.05, .z = 10.0, .p = 1e-20, .p_adjusted = 1e-18};
    report.strategies = {{.strategy = {.s = 0, .t = 2}, .whole = sound, .tiles = {sound, wrong}}};
    report.integrators = {
        {.integrator = IntegratorKind::lt, .edges = 1, .whole = wrong, .tiles = {sound, sound}}};
    report.images.resize(5);
    report.images[2].integrator = IntegratorKind::nee;
    report.images[2].defects = {
        .invalid = 3, .saturated = 0, .first_invalid = FilmDefects::Place{4, 5, 6}};
    report.images[3].lost = 0.02;
    report.weights = {.paths = 1000, .wrong = 7, .worst = 0.25};
    const std::string text = app::verify_text(report, {});
    CHECK(contains(text, "FAIL"));
    CHECK(contains(text, "strategy s=0 t=2, tile 0,4,8,8: 1.5 nit, but 1 expected"));
    CHECK_FALSE(contains(text, "tile 0,0,8,4"));
    CHECK(contains(text, "lt against bdpt, 1 edges, whole image"));
    CHECK(contains(text,
                   "nee: 3 contributions were NaN, infinite or negative; the first at pixel "
                   "(4, 5), sample 6"));
    CHECK(contains(text, "differ by 2 %"));
    CHECK(contains(text, "7 of 1000 paths"));
}

}  // namespace bdpt::test::verify_test
