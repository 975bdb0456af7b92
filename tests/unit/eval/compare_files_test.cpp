#include <bdpt/error.h>
#include <bdpt/eval/comparison.h>
#include <bdpt/io/write_image.h>

#include <filesystem>
#include <string>
#include <vector>

#include "catch.hpp"
#include "scratch_folder.h"
#include "test_images.h"

namespace bdpt::eval::compare_files_test {
namespace {

namespace fs = std::filesystem;
using test::flat;
using test::ScratchFolder;

ComparisonOptions quick()
{
    return {.metrics = {Metric::mse}, .scale = {}, .map_metric = Metric::mse};
}

std::string failure(const std::vector<fs::path>& files, const fs::path& reference)
{
    try {
        static_cast<void>(compare_files(files, reference, std::nullopt, quick()));
    } catch (const Error& error) {
        return std::to_string(static_cast<int>(error.code())) + " " + error.what();
    }
    return "";
}

io::ExrOptions placed(int x, int y, int width, int height)
{
    io::ExrOptions options;
    options.placement = io::ExrPlacement{x, y, width, height};
    return options;
}

TEST_CASE("a crop is compared within itself, at its place")
{
    const ScratchFolder folder;
    Image whole = flat(8, 6, Rgb(1.0f));
    whole.pixels[8 * 3 + 5] = Rgb(3.0f);
    io::write_exr(folder / "whole.exr", whole, {});
    io::write_exr(folder / "crop.exr", flat(3, 2, Rgb(1.0f)), placed(4, 2, 8, 6));
    io::write_exr(folder / "other.exr", flat(3, 2, Rgb(1.0f)), placed(3, 2, 8, 6));

    const std::vector<fs::path> crop{folder / "crop.exr"};
    const FileComparison found = compare_files(crop, folder / "whole.exr", std::nullopt, quick());
    CHECK(found.report.region == PixelRect{4, 2, 7, 4});
    CHECK(found.report.metrics[0].mean == Approx(4.0 / 6));  // one of six pixels is 2 off
    CHECK(found.report.worst_tiles[0].tile == PixelRect{4, 2, 7, 4});
    REQUIRE(found.warnings.size() == 1);
    CHECK(found.warnings[0].find("crop.exr: compared within 4,2,7,4 only") != std::string::npos);

    const std::vector<fs::path> different{folder / "crop.exr", folder / "other.exr"};
    CHECK(failure(different, folder / "whole.exr") ==
          "4 " + (folder / "other.exr").string() +
              ": has data within 3,2,6,4, but 4,2,7,4 is compared");
    io::write_exr(folder / "corner.exr", flat(1, 1, Rgb(1.0f)), placed(0, 0, 8, 6));
    CHECK(failure({folder / "corner.exr"}, folder / "crop.exr").find("no pixels in common") !=
          std::string::npos);
}

TEST_CASE("images of different size are refused")
{
    const ScratchFolder folder;
    io::write_exr(folder / "a.exr", flat(3, 2, Rgb(1.0f)), {});
    io::write_exr(folder / "b.exr", flat(2, 3, Rgb(1.0f)), {});
    const std::string text = failure({folder / "a.exr"}, folder / "b.exr");
    CHECK(text == "4 " + (folder / "a.exr").string() + ": has 3 x 2 pixels, but the reference " +
                      (folder / "b.exr").string() + " has 2 x 3");
    const std::vector<fs::path> second{folder / "b.exr", folder / "a.exr"};
    CHECK(failure(second, folder / "b.exr") == text);
}

TEST_CASE("the seeds of a folder are its images, by name, without the reference")
{
    const ScratchFolder folder;
    fs::create_directory(folder / "seeds");
    fs::create_directory(folder / "seeds/folder.exr");
    for (const char* name :
         {"b.exr", "a.EXR", "c.hdr", "reference.exr", ".hidden.exr", "note.txt", "x.exr.tmp-17"}) {
        test::write_text(folder / (std::string("seeds/") + name), "");
    }
    const fs::path seeds = folder / "seeds";
    const std::vector<fs::path> expected{seeds / "a.EXR", seeds / "b.exr", seeds / "c.hdr"};
    CHECK(seed_files(seeds, seeds / "reference.exr") == expected);
    // The same file by another name.
    CHECK(seed_files(seeds, folder / "seeds/../seeds/./reference.exr") == expected);
    // An image is itself, also when it is the reference or is not there.
    CHECK(seed_files(folder / "no.exr", folder / "no.exr") ==
          std::vector<fs::path>{folder / "no.exr"});
    fs::create_directory(folder / "empty");
    CHECK_THROWS_AS(seed_files(folder / "empty", seeds / "reference.exr"), Error);
}

}  // namespace
}  // namespace bdpt::eval::compare_files_test
