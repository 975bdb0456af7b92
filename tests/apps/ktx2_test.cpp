#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "ktx2_file.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::apps_ktx2_test {
namespace {

using Words = std::vector<std::string>;

/// A shining cube without texture coordinates, so that it has the colour of one texel: that of a
/// KTX2 image, which the file requires.
class Lantern {
public:
    Lantern()
    {
        write_text(folder_ / "light.ktx2", Ktx2File::etc1s().bytes());
        CubeFile cube;
        cube.material = R"({"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}})";
        cube.more = R"("extensionsUsed": ["KHR_texture_basisu"],
            "extensionsRequired": ["KHR_texture_basisu"],
            "images": [{"uri": "light.ktx2"}],
            "textures": [{"extensions": {"KHR_texture_basisu": {"source": 0}}}],)";
        write_cube(folder_, "cube", cube);
    }

    [[nodiscard]] std::string path(const std::string& name) const
    {
        return (folder_ / name).string();
    }
    [[nodiscard]] Outcome render(const Words& more) const
    {
        return run(joined({"render", path("cube.gltf"), "-o", path("o.exr"), "--spp", "1"}, more));
    }
    [[nodiscard]] Outcome plan(const Words& more) const
    {
        return run(joined({"plan", path("cube.gltf"), "-o", path("o.exr"), "--spp", "2", "--parts",
                           "2", "--for", "make", "-d", path("job")},
                          more));
    }
    [[nodiscard]] Outcome task(const Words& more) const
    {
        return run(
            joined({"render", "--plan", path("job/plan.json"), "--task", "0", "--quiet"}, more));
    }

private:
    static Words joined(Words words, const Words& more)
    {
        if (words[1] != "--plan") {
            words.insert(words.end(), {"--size", "8x8", "--integrator", "pt", "--env", "none"});
        }
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    ScratchFolder folder_;
};

const Words fake{"--ktx-library", BDPT_FAKE_KTX};

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// Tests for a process that decodes an image with `library`.
bool is_decoding(const std::string& library)
{
    std::error_code gone;
    for (const auto& process : std::filesystem::directory_iterator("/proc", gone)) {
        std::ifstream stream(process.path() / "cmdline", std::ios::binary);
        // The text stays empty, without an exception, where the process has just ended.
        std::ostringstream text;
        text << stream.rdbuf();
        const std::string words = text.str();
        if (contains(words, "bdpt-read-ktx") && contains(words, library + std::string(1, '\0'))) {
            return true;
        }
    }
    return false;
}

/// Waits until that is so or, if `expected` is false, no longer so. Returns whether it came true.
bool await_decoding(const std::string& library, bool expected)
{
    constexpr int patience = 2000;  // of 10 ms each
    for (int i = 0; i < patience; ++i) {
        if (is_decoding(library) == expected) {
            return true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

}  // namespace

TEST_CASE("KTX2 textures are read by the library of --ktx-library")
{
    const Lantern lantern;
    const Outcome with = lantern.render(fake);
    CAPTURE(with.err);
    REQUIRE(with.exit_code == 0);
    CHECK_FALSE(contains(with.err, "warning"));
    const Rgb middle = read_exr(lantern.path("o.exr")).image.pixels[4 * 8 + 4];
    CHECK(middle.b > 0.05f);  // the first byte of the level, 'e', as sRGB
    CHECK(middle.b < 0.2f);
    CHECK(middle.r < middle.b);
}

TEST_CASE("without libktx a file that requires it is refused, or rendered without textures")
{
    const Lantern lantern;
    const std::string none = lantern.path("none.so");
    const Outcome refused = lantern.render({"--ktx-library", none});
    CHECK(refused.exit_code == 5);
    CHECK(
        refused.err ==
        "bdpt: error: " + lantern.path("cube.gltf") +
            ": /extensionsRequired/0: the file requires \"KHR_texture_basisu\", KTX2 textures: "
            "libktx was not found: " +
            none + ": cannot open shared object file: No such file or directory. libktx 4 is " +
            "part of https://github.com/KhronosGroup/KTX-Software (--ignore-required renders it " +
            "without)\n");
    const Outcome ignored = lantern.render({"--ktx-library", none, "--ignore-required"});
    CHECK(ignored.exit_code == 0);
    CHECK(contains(ignored.err, "warning: " + lantern.path("cube.gltf") +
                                    ": /extensionsRequired/0: it requires \"KHR_texture_basisu\""));
    CHECK(contains(ignored.err, "/textures/0: the KTX2 texture is left out"));
    CHECK(read_exr(lantern.path("o.exr")).image.pixels[4 * 8 + 4].r > 0.9f);
    const Outcome empty = lantern.render({"--ktx-library", ""});
    CHECK(empty.exit_code == 2);
    CHECK(contains(empty.err, "--ktx-library \"\": expected a file or a folder"));
}

TEST_CASE("a plan does not name libktx, and its tasks are told")
{
    const Lantern lantern;
    CHECK(lantern.plan({}).exit_code == 5);
    const Outcome planned = lantern.plan(fake);
    CAPTURE(planned.err);
    REQUIRE(planned.exit_code == 0);
    CHECK_FALSE(contains(read_text(lantern.path("job/plan.json")), "ktx"));
    CHECK(lantern.task({}).exit_code == 5);
    const Outcome done = lantern.task(fake);
    CAPTURE(done.err);
    CHECK(done.exit_code == 0);
}

TEST_CASE("a signal ends a command at once while it loads, and the process that decodes for it")
{
    const Lantern lantern;
    const std::string sleeping = lantern.path("libktx-sleep.so");
    std::filesystem::create_symlink(BDPT_FAKE_KTX, sleeping);
    Subprocess process(Launch{.arguments = {"render", lantern.path("cube.gltf"), "--ktx-library",
                                            sleeping, "-o", lantern.path("o.exr")}});
    REQUIRE(await_decoding(sleeping, true));
    process.send(SIGTERM);
    CHECK(process.finish().exit_code == 128 + SIGTERM);
    CHECK(await_decoding(sleeping, false));

    // There a signal is the usual end, although this scene is never loaded.
    Subprocess view(Launch{.arguments = {"view", lantern.path("cube.gltf"), "--ktx-library",
                                         sleeping, "--listen", "127.0.0.1:0"}});
    REQUIRE(await_decoding(sleeping, true));
    view.send(SIGTERM);
    CHECK(view.finish().exit_code == 0);
    CHECK(await_decoding(sleeping, false));
}

}  // namespace bdpt::test::apps_ktx2_test
