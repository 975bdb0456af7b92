#include <signal.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "catch.hpp"
#include "fake_viewer.h"
#include "image_files.h"
#include "options/value_types.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::viewer_test {
namespace {

using job::NetworkAddress;
using job::parse_address;
using Words = std::vector<std::string>;

Words words(const ScratchFolder& folder, const std::string& address, const Words& more)
{
    Words all{"render",       write_cube(folder, "cube", {.cameras = two_cameras}).string(),
              "--integrator", "pt",
              "-o",           (folder / "out.exr").string(),
              "--display",    address};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

TEST_CASE("an address is a host and perhaps a port", "[display]")
{
    CHECK(parse_address("localhost") == NetworkAddress{"localhost", "14158"});
    CHECK(parse_address("10.0.0.7:99") == NetworkAddress{"10.0.0.7", "99"});
    CHECK(parse_address(":99") == NetworkAddress{"localhost", "99"});
    CHECK(parse_address("[::1]") == NetworkAddress{"::1", "14158"});
    CHECK(parse_address("[::1]:99") == NetworkAddress{"::1", "99"});
    for (const char* word : {"", "a:", "a:0", "a:65536", "a:b", "a:1:2", "a b", "[::1]x:9", "[::1",
                             "http://a", "a:-1"}) {
        CAPTURE(word);
        CHECK_FALSE(parse_address(word));
    }
    const ScratchFolder folder;
    const Outcome outcome = run(words(folder, "a:b", {}));
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.find("--display \"a:b\"") != std::string::npos);
}

TEST_CASE("a viewer shows what the file has in the end", "[display]")
{
    const ScratchFolder folder;
    FakeViewer viewer(ViewerHabit::reads);
    const bool cropped = GENERATE(false, true);
    Words more{"--size", "40x30", "--spp", "8"};
    if (cropped) {
        more.insert(more.end(), {"--crop", "8,4,24,20"});
    }
    const Outcome outcome = run(words(folder, viewer.address(), more));
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    viewer.wait_for_connections(1);
    viewer.wait_until_alone();
    CHECK(viewer.errors() == 0);
    const Image shown = viewer.image("out.exr");
    REQUIRE(shown.width == 40);
    REQUIRE(shown.height == 30);
    const Image written = read_exr(folder / "out.exr").image;
    const int x0 = cropped ? 8 : 0;
    const int y0 = cropped ? 4 : 0;
    CHECK(written.width == (cropped ? 16 : 40));
    for (int y = 0; y < written.height; ++y) {
        for (int x = 0; x < written.width; ++x) {
            REQUIRE(shown.at(x0 + x, y0 + y) == written.at(x, y));
        }
    }
    if (cropped) {
        CHECK(shown.at(7, 4) == Rgb(-1.0f));  // nothing was sent beside the crop
    }
}

TEST_CASE("a viewer that hangs changes nothing", "[display][long]")
{
    const ScratchFolder folder;
    // More than the buffers of sockets hold.
    const Words more{"--size", "1200x900", "--spp", "2"};
    {
        FakeViewer viewer(ViewerHabit::hangs);
        const Outcome outcome = run(words(folder, viewer.address(), more));
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 0);
    }
    const auto pixels = read_exr(folder / "out.exr").image.pixels;
    Words alone = words(folder, "", more);
    alone.erase(alone.begin() + 6, alone.begin() + 8);
    CHECK(run(alone).exit_code == 0);
    CHECK(read_exr(folder / "out.exr").image.pixels == pixels);
}

TEST_CASE("a viewer that dies and comes back goes on showing the render", "[display]")
{
    const ScratchFolder folder;
    FakeViewer viewer(ViewerHabit::dies_once);
    Subprocess command(Launch{
        .arguments = words(folder, viewer.address(), {"--size", "40x30", "--time", "600s"})});
    viewer.wait_for_connections(2);
    command.send(SIGINT);
    const Outcome outcome = command.finish();
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 130);
    CHECK(outcome.err.find("warning: --display " + viewer.address()) != std::string::npos);
    viewer.wait_until_alone();
    CHECK(viewer.errors() == 0);
    CHECK(viewer.image("out.exr").pixels == read_exr(folder / "out.exr").image.pixels);
}

TEST_CASE("a viewer that is not there is a warning, once", "[display]")
{
    const ScratchFolder folder;
    std::optional<FakeViewer> viewer(ViewerHabit::reads);
    const std::string address = viewer->address();
    viewer.reset();
    const Outcome outcome = run(words(folder, address, {"--size", "8x6", "--spp", "4"}));
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 0);
    const std::size_t first = outcome.err.find("--display " + address);
    CHECK(first != std::string::npos);
    CHECK(outcome.err.find("--display", first + 1) == std::string::npos);
    CHECK(read_exr(folder / "out.exr").integer("bdpt.spp") == 4);
}

}  // namespace
}  // namespace bdpt::test::viewer_test
