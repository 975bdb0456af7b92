#include <bdpt/error.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "options/groups/transport_arguments.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::strategies_test {
namespace {

using Words = std::vector<std::string>;

/// A room that shines.
class Room {
public:
    Room() : scene_(write_cube(folder_, "room", shining_room()).string()) {}

    Outcome render(const Words& more, const std::string& size = "16x8") const
    {
        Words words{"render", scene_, "-o", path("out.exr"), "--spp", "4", "--size", size};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    std::string path(const char* name) const { return (folder_ / name).string(); }
    const ScratchFolder& folder() const { return folder_; }
    const std::string& scene() const { return scene_; }

private:
    ScratchFolder folder_;
    std::string scene_;
};

std::set<std::string> channels(const ExrFile& file)
{
    std::set<std::string> names;
    for (auto i = file.header.channels().begin(); i != file.header.channels().end(); ++i) {
        names.insert(i.name());
    }
    return names;
}

double mean(const std::vector<float>& values)
{
    double sum = 0.0;
    for (const float value : values) {
        sum += static_cast<double>(value);
    }
    return sum / static_cast<double>(values.size());
}

TEST_CASE("option --strategies writes layers that add up to the image, and a sheet")
{
    const Room room;
    const std::string file = room.path("all.EXR");
    const std::string integrator = GENERATE(as<std::string>{}, "bdpt", "lt");
    const Outcome outcome = room.render({"--strategies", file, "--max-depth", "2", "--integrator",
                                         integrator, "--exposure", "-2", "--json"},
                                        "48x24");  // few points on lights are joined to the lens
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(room.folder().names() ==
          std::set<std::string>{"all.EXR", "all.png", "out.exr", "room.bin", "room.gltf"});

    const ExrFile layers = read_exr(file);
    const ExrFile exr = read_exr(room.path("out.exr"));
    CHECK(layers.image.pixels == exr.image.pixels);
    CHECK(layers.text("bdpt.settings") == exr.text("bdpt.settings"));
    std::set<std::string> expected{"R", "G", "B"};
    std::vector<double> sum(layers.image.pixels.size());
    const Words strategies = integrator == "lt"
                                 ? Words{"s01t01", "s02t01"}
                                 : Words{"s00t02", "s01t01", "s00t03", "s01t02", "s02t01"};
    for (const std::string& strategy : strategies) {
        for (const char* channel : {".R", ".G", ".B"}) {
            expected.insert(strategy + channel);
            expected.insert(strategy + ".unweighted" + channel);
        }
        const std::vector<float> weighted = read_exr_channel(file, (strategy + ".G").c_str());
        const std::vector<float> alone =
            read_exr_channel(file, (strategy + ".unweighted.G").c_str());
        std::transform(weighted.begin(), weighted.end(), sum.begin(), sum.begin(),
                       [](float a, double b) { return static_cast<double>(a) + b; });
        CHECK(mean(alone) >= mean(weighted));
        CHECK(mean(alone) > 0.1);
    }
    CHECK(channels(layers) == expected);
    double worst = 0.0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double whole = static_cast<double>(exr.image.pixels[i].g);
        worst = std::max(worst, std::abs(sum[i] - whole) / (whole + 1e-3));
    }
    CHECK(worst < 1e-5);

    PngFile sheet = read_png(room.path("all.png"));
    CHECK(sheet.text["bdpt.exposure"] == "-2");
    CHECK(sheet.width > 2 * 48);
    CHECK(sheet.height > 4 * 24);
    CHECK(std::count(sheet.rgb.begin(), sheet.rgb.end(), std::uint8_t{235}) > 100);

    const std::string last =
        outcome.out.substr(outcome.out.rfind('\n', outcome.out.size() - 2) + 1);
    const auto done = nlohmann::json::parse(last);
    CHECK(done["outputs"] ==
          nlohmann::json::array({room.path("out.exr"), file, room.path("all.png")}));
}

TEST_CASE("the image is the same with and without images of strategies")
{
    const Room room;
    const Words words{"--max-depth", "6", "--integrator", "bdpt"};
    REQUIRE(room.render(words).exit_code == 0);
    const Image without = read_exr(room.path("out.exr")).image;
    CHECK(room.folder().names() == std::set<std::string>{"out.exr", "room.bin", "room.gltf"});
    Words more = words;
    more.insert(more.end(), {"--strategies", room.path("all.exr")});
    REQUIRE(room.render(more).exit_code == 0);
    CHECK(read_exr(room.path("out.exr")).image.pixels == without.pixels);
    // Five edges if nobody says otherwise.
    const std::set<std::string> five = channels(read_exr(room.path("all.exr")));
    CHECK(five.contains("s05t01.B"));
    CHECK(five.contains("s00t06.unweighted.B"));
    CHECK(five.size() == 3 + 6 * (2 + 3 + 4 + 5 + 6));
    more.insert(more.end(), {"--strategy-depth", "6", "--half"});
    REQUIRE(room.render(more).exit_code == 0);
    const ExrFile six = read_exr(room.path("all.exr"));
    CHECK(channels(six).contains("s06t01.R"));
    CHECK(six.header.channels().findChannel("s06t01.R")->type == Imf::FLOAT);
}

TEST_CASE("images of strategies of a crop are placed in the whole image")
{
    const Room room;
    const Outcome outcome = room.render({"--strategies", room.path("all.exr"), "--strategy-depth",
                                         "1", "--crop", "3,2,9,7", "--disable", "s1t1"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const ExrFile file = read_exr(room.path("all.exr"));
    CHECK(file.header.dataWindow() == Imath::Box2i({3, 2}, {8, 6}));
    CHECK(channels(file).size() == 3 + 6);
    CHECK(read_exr_channel(room.path("all.exr"), "s00t02.R") == std::vector<float>(30, 1.0f));
}

TEST_CASE("wrong words for images of strategies are refused before anything is rendered")
{
    const Room room;
    write_text(room.folder() / "taken.png", "older");
    const auto before = room.folder().names();
    const auto rejects = [&](const Words& more, int code, const std::string& text,
                             const std::string& size = "16x8") {
        const Outcome outcome = room.render(more, size);
        CAPTURE(more, outcome.err);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.err.find(text) != std::string::npos);
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') <= 2);
        CHECK(room.folder().names() == before);
        CHECK(read_text(room.folder() / "taken.png") == "older");
    };
    const std::string file = room.path("all.exr");
    for (const char* integrator : {"pt", "mis", "nee"}) {
        rejects({"--strategies", file, "--integrator", integrator}, 2,
                std::string("--strategies needs --integrator bdpt or lt, not ") + integrator);
    }
    rejects({"--strategies", "all.png"}, 2, "--strategies \"all.png\": expected a file name");
    rejects({"--strategies", ""}, 2, "--strategies \"\"");
    rejects({"--strategy-depth", "3"}, 2, "--strategy-depth needs --strategies or --part");
    rejects({"--strategies", file, "--strategy-depth", "0"}, 2, "--strategy-depth");
    rejects({"--strategies", file, "--strategy-depth", "101"}, 2, "--strategy-depth");
    rejects({"--strategies", file, "--strategy-depth", "2", "--only", "indirect"}, 2,
            "no enabled strategy samples paths of up to 2 edges (--strategy-depth)");
    rejects({"--strategies", room.path("none/all.exr")}, 6, "none/all.exr");
    rejects({"--strategies", room.path("out.exr")}, 2, "it is an input or another output");
    rejects({"--strategies", room.path("taken.exr"), "-o", room.path("taken.png")}, 2,
            "taken.png beside it is an input or another output");
    rejects({"--strategies", file, "--stats", room.path("all.png")}, 2,
            "the same file is an input or another output");
    rejects({"--strategies", file, "--strategy-depth", "8"}, 2,
            "images of paths of up to 8 edges take 30.4 GB, more than the limit of 4.0 GB; "
            "--strategy-depth 2 takes less",
            "2400x2400");
    rejects({"--strategies", file}, 2,
            "images of paths of up to 5 edges take 60.0 GB, more than the limit of 4.0 GB; a "
            "smaller --size or --crop takes less",
            "5000x5000");
}

/// `words` of `bdpt render` for a part of a room, without numbers of samples.
Words part_words(const Room& room, const Words& more)
{
    Words words{"render", room.scene(), "--size", "16x8",         "--max-depth",
                "3",      "--env",      "none",   "--integrator", "bdpt"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

void check_success(const Outcome& outcome)
{
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 0);
}

void check_same_strategies(const std::string& file, const std::string& expected)
{
    const std::set<std::string> names = channels(read_exr(expected));
    CHECK(channels(read_exr(file)) == names);
    CHECK(names.contains("s01t02.unweighted.G"));
    for (const std::string& name : names) {
        CAPTURE(name);
        CHECK(read_exr_channel(file, name.c_str()) == read_exr_channel(expected, name.c_str()));
    }
    const auto sheet = [](std::string path) { return path.replace(path.size() - 3, 3, "png"); };
    CHECK(read_png(sheet(file)).rgb == read_png(sheet(expected)).rgb);
}

TEST_CASE("merge writes the images of strategies that parts have")
{
    const Room room;
    const std::string whole = room.path("whole.exr");
    check_success(run(part_words(room, {"--spp", "4", "--strategies", whole, "-o",
                                        room.path("image.exr"), "--strategy-depth", "2"})));
    // Kept in the part alone, and written for the part, too: the parts are of one render.
    const std::string a = room.path("a.part.exr");
    const std::string b = room.path("b.part.exr");
    check_success(run(part_words(
        room, {"--spp", "4", "--samples", "0:3", "--part", a, "--strategy-depth", "2"})));
    CHECK(room.folder().names().size() == 6);
    check_success(
        run(part_words(room, {"--spp", "4", "--samples", "3:4", "--part", b, "--strategy-depth",
                              "2", "--strategies", room.path("own.exr")})));
    const std::string merged = room.path("merged.exr");
    check_success(run({"merge", b, a, "-o", room.path("m.exr"), "--strategies", merged}));
    check_same_strategies(merged, whole);
    CHECK(read_exr(merged).image.pixels == read_exr(room.path("image.exr")).image.pixels);
    CHECK(read_exr(merged).integer("bdpt.spp") == 4);

    // The command for what is missing makes such a part.
    const Outcome missing = run({"merge", b, "-o", room.path("x.exr")});
    CHECK(missing.exit_code == 12);
    CHECK(missing.err.find(" --strategy-depth=2 --samples 0:3 --part ") != std::string::npos);
    CHECK(missing.err.find("own.exr") == std::string::npos);
}

TEST_CASE("merge refuses to write images of strategies that are not there, or not to be written")
{
    const Room room;
    const std::string part = room.path("a.part.exr");
    check_success(run(part_words(room, {"--spp", "1", "--part", part})));
    const auto refused = [&](const std::string& file, int code, const std::string& text) {
        const Outcome outcome =
            run({"merge", part, "-o", room.path("m.exr"), "--strategies", file});
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.err.find(text) != std::string::npos);
        CHECK_FALSE(room.folder().names().contains("m.exr"));
    };
    refused(room.path("all.exr"), 4, "a.part.exr has no strategy images");
    refused(room.path("all.png"), 2, "expected a file name that ends in .exr");
    refused(part, 2, "it is an input or another output");
    refused(room.path("none/all.exr"), 6, "none/all.exr");
    const Outcome outcome = run(part_words(room, {"--spp", "1", "--part", room.path("b.part.exr"),
                                                  "--strategy-depth", "2", "--integrator", "mis"}));
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.find("--strategy-depth needs --integrator bdpt or lt") != std::string::npos);
}

TEST_CASE("images of strategies are planned, for frames too")
{
    const Room room;
    const bool many = GENERATE(false, true);
    const auto name = [&](const char* one, const char* pattern) {
        return room.path(many ? pattern : one);
    };
    const Words turn = many ? Words{"--orbit", "2", "--strategy-depth", "2"} : Words{};
    Words plan = part_words(
        room, {"--spp", "2", "--parts", "2", "--for", "make", "-d", room.path("job"), "-o",
               name("p.exr", "p.#.exr"), "--strategies", name("ps.exr", "ps.#.exr")});
    plan.front() = "plan";
    plan.insert(plan.end(), turn.begin(), turn.end());
    check_success(run(plan));
    const std::string file = room.path("job/plan.json");
    for (const char* task : {"0", "1"}) {
        check_success(run({"render", "--plan", file, "--task", task}));
    }
    check_success(run({"merge", "--plan", file}));
    Words whole = part_words(room, {"--spp", "2", "-o", name("w.exr", "w.#.exr"), "--strategies",
                                    name("ws.exr", "ws.#.exr")});
    whole.insert(whole.end(), turn.begin(), turn.end());
    check_success(run(whole));
    check_same_strategies(name("ps.exr", "ps.2.exr"), name("ws.exr", "ws.2.exr"));
}

TEST_CASE("what cannot be written leaves nothing of the images of strategies")
{
    const Room room;
    // The layers do not fit on this disk, the image does.
    const Outcome outcome = run(
        Launch{.arguments = {"render", room.scene(), "-o", room.path("out.exr"), "--spp", "2",
                             "--size", "16x8", "--strategies", room.path("all.exr"), "--seed", "3"},
               .file_size = 6000});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 6);
    CHECK(outcome.err.find("all.exr") != std::string::npos);
    CHECK(room.folder().names() == std::set<std::string>{"out.exr", "room.bin", "room.gltf"});
}

}  // namespace
}  // namespace bdpt::test::strategies_test

namespace bdpt::job::strategies_test {
namespace {

TEST_CASE("images of strategies are made of as long paths as memory is allowed for")
{
    RenderOptions options;
    options.integrator = IntegratorKind::bdpt;
    options.film.width = 100;
    options.film.height = 10;
    const CameraDesc camera;
    StrategyFiles files{.layers = "a.exr", .depth = {}};
    constexpr std::uint64_t of_one = 1000 * 120;  // strategy
    CHECK(strategy_depth(files, options, camera).edges == 5);
    CHECK_FALSE(strategy_depth(files, options, camera).warning);
    options.bidirectional.strategy_memory = 20 * of_one;
    CHECK_FALSE(strategy_depth(files, options, camera).warning);
    --options.bidirectional.strategy_memory;
    CHECK(strategy_depth(files, options, camera).edges == 4);
    options.bidirectional.strategy_memory = 14 * of_one - 1;
    const StrategyDepth less = strategy_depth(files, options, camera);
    CHECK(less.edges == 3);
    CHECK(less.warning.value_or("").find("--strategy-depth") != std::string::npos);
    options.bidirectional.strategy_memory = 2 * of_one;
    CHECK(strategy_depth(files, options, camera).edges == 1);
    --options.bidirectional.strategy_memory;
    CHECK_THROWS_AS(strategy_depth(files, options, camera), Error);

    // What the user chose is done or refused, but for paths that there are not.
    options.bidirectional.strategy_memory = 14 * of_one;
    files.depth = 4;
    CHECK(strategy_depth(files, options, camera).edges == 4);
    files.depth = 5;
    CHECK_THROWS_AS(strategy_depth(files, options, camera), Error);
    options.transport.max_depth = 3;
    files.depth = 100;
    CHECK(strategy_depth(files, options, camera).edges == 3);
    CHECK_FALSE(strategy_depth(files, options, camera).warning);
}

}  // namespace
}  // namespace bdpt::job::strategies_test
