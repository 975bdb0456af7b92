#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::volume_test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using nlohmann::json;

const std::string smoke = std::string(BDPT_SOURCE_DIR) + "/scenes/smoke.vdb";

Words joined(Words words, const Words& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

const std::string scene = std::string(BDPT_SOURCE_DIR) + "/scenes/room-spot.gltf";

/// A folder for images of the room in which the smoke rises.
class Room {
public:
    [[nodiscard]] std::string path(const std::string& name) const
    {
        return (folder_ / name).string();
    }
    [[nodiscard]] Words words(const std::string& command, const Words& more) const
    {
        return joined({command, scene, "--size", "16x12", "--max-depth", "3"}, more);
    }
    /// Runs what must succeed.
    [[nodiscard]] std::string checked(const Words& words) const
    {
        const Outcome outcome = run(words);
        CAPTURE(words, outcome.out, outcome.err);
        CHECK(outcome.exit_code == 0);
        return outcome.out;
    }
    [[nodiscard]] ExrFile render(const Words& more) const
    {
        static_cast<void>(
            checked(words("render", joined({"--spp", "8", "-o", path("out.exr")}, more))));
        return read_exr(folder_ / "out.exr");
    }
    [[nodiscard]] std::vector<Rgb> pixels(const Words& more) const
    {
        return render(more).image.pixels;
    }
    /// One line of failure that has all of `texts`, and no image.
    void refuse(const Words& more, int code, const Words& texts) const
    {
        const Outcome outcome =
            run(words("render", joined({"--quiet", "-o", path("no.exr")}, more)));
        CAPTURE(more, outcome.out, outcome.err);
        CHECK(outcome.exit_code == code);
        CHECK(outcome.err.find('\n') == outcome.err.size() - 1);
        for (const std::string& text : texts) {
            CAPTURE(text);
            CHECK(outcome.err.find(text) != std::string::npos);
        }
        CHECK_FALSE(fs::exists(folder_ / "no.exr"));
    }

private:
    ScratchFolder folder_;
};

/// How bright it is where the smoke is.
float green(const std::vector<Rgb>& pixels)
{
    return pixels.at(3 * 16 + 5).g + pixels.at(4 * 16 + 5).g;
}

}  // namespace

TEST_CASE("options about volumes that make no sense are refused", "[volume]")
{
    const Room room;
    room.refuse({"--volume-grid", "heat"}, 2, {"--volume-grid needs --volume"});
    room.refuse({"--volume-extinction", "2"}, 2, {"--volume-extinction needs --volume"});
    room.refuse({"--volume-albedo", "0.5"}, 2, {"--volume-albedo needs --volume"});
    room.refuse({"--volume-anisotropy", "0.5"}, 2, {"--volume-anisotropy needs --volume"});
    room.refuse({"--volume-up", "z"}, 2, {"--volume-up needs --volume"});
    const auto refuse = [&](const Words& more, const Words& texts) {
        room.refuse(joined({"--volume", smoke}, more), 2, texts);
    };
    refuse({"--volume-extinction", "-1"}, {"--volume-extinction \"-1\""});
    refuse({"--volume-extinction", "nan"}, {"--volume-extinction"});
    refuse({"--volume-extinction", "1e7"}, {"--volume-extinction"});
    refuse({"--volume-albedo", "1.5"}, {"--volume-albedo \"1.5\""});
    refuse({"--volume-albedo", "0.5,0.5"}, {"--volume-albedo \"0.5,0.5\""});
    refuse({"--volume-anisotropy", "1"}, {"--volume-anisotropy \"1\""});
    refuse({"--volume-up", "x"}, {"--volume-up"});
    refuse({"--volume-grid", ""}, {"--volume-grid"});
    refuse({"--ground", "shadow", "--background", "black"},
           {"--ground cannot be combined with --volume"});
    room.refuse({"--volume", "-"}, 2, {"--volume \"-\""});
    room.refuse({"--volume", room.path("none.vdb")}, 3, {"none.vdb: no such file"});
    room.refuse({"--volume", scene}, 5, {"room-spot.gltf: not an OpenVDB file"});
}

#ifdef BDPT_HAS_OPENVDB

TEST_CASE("smoke comes into a scene by --volume", "[volume]")
{
    const Room room;
    const auto clear = room.pixels({});
    const Words thick{"--volume", smoke, "--volume-extinction", "60"};
    const auto white = room.pixels(thick);
    const auto black = room.pixels(joined(thick, {"--volume-albedo", "0"}));
    CHECK(green(black) < 0.95f * green(clear));
    CHECK(green(white) > green(black));
    CHECK(room.pixels({"--volume", smoke, "--volume-extinction", "0"}) == clear);
    // What is said of it counts.
    CHECK(room.pixels(joined(thick, {"--volume-grid", "density", "--volume-up", "y"})) == white);
    CHECK(room.pixels(joined(thick, {"--volume-up", "z"})) != white);
    CHECK(room.pixels(joined(thick, {"--volume-anisotropy", "0.8"})) != white);
    CHECK(room.pixels({"--volume", smoke}) != white);
    // All integrators see it.
    CHECK(green(room.pixels(joined(thick, {"--volume-albedo", "0", "--integrator", "nee"}))) <
          0.95f * green(room.pixels({"--integrator", "nee"})));

    const ExrFile file =
        room.render({"--volume", smoke, "--volume-extinction", "1,2,0.5", "--volume-albedo",
                     "0.5,1,0.25", "--volume-anisotropy", "-0.5"});
    const json settings = json::parse(file.text("bdpt.settings"))["volume"];
    CHECK(settings["file"] == "smoke.vdb");
    CHECK(settings["extinction"] == json({1.0, 2.0, 0.5}));
    CHECK(settings["albedo"] == json({0.5, 1.0, 0.25}));
    CHECK(settings["anisotropy"] == -0.5);
    CHECK(settings["up"] == "y");
}

TEST_CASE("files of volumes that cannot be read end a command in one line", "[volume]")
{
    const Room room;
    room.refuse({"--volume", smoke, "--volume-grid", "heat"}, 4,
                {"smoke.vdb: no grid \"heat\"; it has density (float)"});
    const std::string cut = room.path("cut.vdb");
    write_text(cut, read_text(smoke).substr(0, 20'000));
    room.refuse({"--volume", cut}, 4, {cut + ": "});
    room.refuse({"--volume", smoke, "--max-memory", "400000"}, 4,
                {"smoke.vdb: grid \"density\" needs ", "of 400 kB are left (--max-memory)"});
    // Together with the scene it is too much.
    room.refuse({"--volume", smoke, "--max-memory", "820000"}, 4,
                {"of 820 kB are left (--max-memory)"});
    const Words over{"--volume", smoke, "-o", smoke};
    CHECK(run(room.words("render", over)).exit_code == 2);
}

TEST_CASE("parts with and without a volume, or with another one, are not one render", "[volume]")
{
    const Room room;
    const std::string part = room.path("a.part.exr");
    const Words thin{"--volume", smoke, "--part", part, "--spp", "2"};
    static_cast<void>(room.checked(room.words("render", thin)));
    const auto refuse = [&](const Words& more) {
        room.refuse(joined({"--part", part, "--spp", "4"}, more), 4,
                    {part + ": is a part of another render: scene: volumes"});
    };
    refuse({});
    refuse({"--volume", smoke, "--volume-extinction", "2"});
    refuse({"--volume", smoke, "--volume-up", "z"});
    static_cast<void>(room.checked(room.words(
        "render", {"--volume", smoke, "--part", part, "--spp", "4", "-o", room.path("a.exr")})));
}

TEST_CASE("a plan names the file of its volume", "[volume][plan]")
{
    const Room room;
    const Words what{"--volume", smoke, "--volume-extinction", "10", "--spp", "4"};
    const Words sequence = GENERATE(Words{}, Words{"--orbit", "2", "--frames", "1:1"});
    const std::string out = room.path(sequence.empty() ? "out.exr" : "out.#.exr");
    static_cast<void>(room.checked(room.words(
        "plan", joined(joined(what, sequence),
                       {"--parts", "2", "--for", "make", "-d", room.path("job"), "-o", out}))));
    const std::string plan = room.path("job/plan.json");
    const json there = json::parse(read_text(plan));
    CHECK(there["volume"] == fs::weakly_canonical(smoke).string());
    for (const json& word : there["render"]) {
        CHECK_FALSE(word.get<std::string>().starts_with("--volume="));
    }
    for (const char* task : {"0", "1"}) {
        static_cast<void>(room.checked({"render", "--plan", plan, "--task", task}));
    }
    static_cast<void>(room.checked({"merge", "--plan", plan}));
    const std::string whole = room.path(sequence.empty() ? "whole.exr" : "whole.#.exr");
    static_cast<void>(
        room.checked(room.words("render", joined(joined(what, sequence), {"-o", whole}))));
    const char* number = sequence.empty() ? "" : ".1";
    CHECK(read_exr(room.path(std::string("out") + number + ".exr")).image.pixels ==
          read_exr(room.path(std::string("whole") + number + ".exr")).image.pixels);
}

TEST_CASE("verify and inspect take a volume", "[volume]")
{
    const Room room;
    const Words thick{"--volume", smoke, "--volume-extinction", "25"};
    const auto seen = [&](const Words& more) {
        return room.checked(joined(
            room.words("inspect", {"--integrator", "mis", "--pixel", "5,4", "--sample", "0"}),
            more));
    };
    CHECK(seen({}).find("medium") == std::string::npos);
    CHECK(seen(thick).find("medium") != std::string::npos);
    const Words brief{"--bias", "50", "--max-depth", "2", "--time", "5s"};
    const Outcome verified = run(joined(joined({"verify", scene, "--size", "4x4"}, brief),
                                        {"--volume", smoke, "--volume-grid", "heat"}));
    CHECK(verified.exit_code == 4);
    CHECK(verified.err.find("no grid \"heat\"") != std::string::npos);
}

#else

TEST_CASE("without OpenVDB a volume is refused by name", "[volume]")
{
    const Room room;
    room.refuse({"--volume", smoke}, 5,
                {smoke + ": OpenVDB files are read by a separate program"});
}

#endif

}  // namespace bdpt::test::volume_test
