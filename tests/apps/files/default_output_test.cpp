#include <filesystem>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::default_output_test {
namespace {

/// A working directory, and a scene in another folder.
struct Desk {
    Desk() { std::filesystem::create_directory(folder / "desk"); }

    [[nodiscard]] Outcome render(std::vector<std::string> more = {}) const
    {
        std::vector<std::string> words{"render", scene, "--size", "8", "--spp", "1"};
        words.insert(words.end(), more.begin(), more.end());
        return run(Launch{.arguments = words, .folder = folder / "desk"});
    }

    ScratchFolder folder;
    std::string scene = write_cube(folder, "cube", {}).string();
    std::filesystem::path image = folder / "desk" / "cube.png";
};

TEST_CASE("an image without a name is that of the scene, here", "[default output]")
{
    const Desk desk;
    const Outcome first = desk.render();
    CAPTURE(first.err);
    REQUIRE(first.exit_code == 0);
    CHECK(first.err.find("wrote cube.png: ") != std::string::npos);
    CHECK(read_png(desk.image).width == 8);
    // An image that bdpt has written is replaced.
    const Outcome again = desk.render({"--size", "4"});
    CAPTURE(again.err);
    REQUIRE(again.exit_code == 0);
    CHECK(read_png(desk.image).width == 4);
}

TEST_CASE("a file of somebody else is not replaced by an image without a name", "[default output]")
{
    const Desk desk;
    const auto is_kept = [&](const std::string& contents) {
        write_text(desk.image, contents);
        const Outcome outcome = desk.render();
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 6);
        CHECK(outcome.err ==
              "bdpt: error: cube.png: exists and was not written by bdpt: -o cube.png "
              "replaces it, -o with another name keeps it\n");
        CHECK(read_text(desk.image) == contents);
    };
    REQUIRE(desk.render().exit_code == 0);
    std::string ours = read_text(desk.image);
    const std::size_t name = ours.find("bdpt ");
    REQUIRE(name != std::string::npos);
    is_kept(ours.substr(0, name));
    is_kept(ours.replace(name, 4, "gimp"));
    is_kept("");
    is_kept("bdpt was here");
    is_kept(std::string("\x89PNG\r\n\x1a\n\xff\xff\xff\xffIHDR\0\0\0\0", 20));
    CHECK(desk.render({"-o", "cube.png"}).exit_code == 0);
    CHECK(read_png(desk.image).width == 8);
}

TEST_CASE("a link or a folder is not replaced by an image without a name", "[default output]")
{
    const Desk desk;
    std::filesystem::create_symlink("elsewhere", desk.image);
    CHECK(desk.render().exit_code == 6);
    CHECK(std::filesystem::is_symlink(desk.image));
    std::filesystem::remove(desk.image);
    std::filesystem::create_directory(desk.image);
    CHECK(desk.render().exit_code == 6);
}

TEST_CASE("a command line without a command shows the commands", "[usage]")
{
    const Outcome outcome = run(std::vector<std::string>{});
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == run({"--help"}).out);
    CHECK(outcome.err.find("  render ") != std::string::npos);
}

}  // namespace
}  // namespace bdpt::test::default_output_test
