#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::lens_test {
namespace {

using Words = std::vector<std::string>;

/// A shining cube of 1 nit whose front, at z = 1, is 4 m before camera 0.
class LensFolder {
public:
    explicit LensFolder(const std::string& cameras = plain_cameras)
        : scene_(
              write_cube(
                  folder_, "cube",
                  {.material = emissive_material, .cameras = two_cameras, .camera_kinds = cameras})
                  .string())
    {}

    Outcome render(const Words& more) const
    {
        Words words{"render",      scene_,  "-o",      (folder_ / "out.exr").string(),
                    "--spp",       "16",    "--size",  "64x32",
                    "--max-depth", "1",     "--quiet", "--integrator",
                    "pt",          "--env", "none"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    ExrFile rendered(const Words& more) const
    {
        const Outcome outcome = render(more);
        CAPTURE(more, outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return read_exr(folder_ / "out.exr");
    }

private:
    ScratchFolder folder_;
    std::string scene_;
};

nlohmann::json settings_of(const ExrFile& file)
{
    return nlohmann::json::parse(file.text("bdpt.settings"));
}

/// Pixels that show neither just the cube nor just the dark around it.
std::ptrdiff_t blurred(const ExrFile& file)
{
    return std::count_if(file.image.pixels.begin(), file.image.pixels.end(),
                         [](const Rgb& pixel) { return pixel.g > 0.01f && pixel.g < 0.99f; });
}

TEST_CASE("option --lens-radius blurs what is out of focus")
{
    const LensFolder cube;
    const ExrFile sharp = cube.rendered({});
    CHECK_FALSE(settings_of(sharp).contains("lens_radius"));
    const ExrFile focused = cube.rendered({"--lens-radius", "0.25", "--focus-distance", "4"});
    const ExrFile wrong = cube.rendered({"--lens-radius", "0.25", "--focus-distance", "2"});
    CHECK(blurred(wrong) > 2 * blurred(focused));
    CHECK(blurred(focused) < 2 * blurred(sharp) + 32);
    CHECK(settings_of(wrong)["lens_radius"] == 0.25);
    CHECK(settings_of(wrong)["focus_distance"] == 2.0);
    CHECK(cube.rendered({"--lens-radius", "0"}).image.pixels == sharp.image.pixels);
}

TEST_CASE("a lens focuses on what is in the middle of the view")
{
    const LensFolder cube;
    CHECK(settings_of(cube.rendered({"--lens-radius", "0.1"}))["focus_distance"].get<double>() ==
          Approx(4.0).epsilon(1e-4));
    CHECK(settings_of(cube.rendered({"--lens-radius", "0.1", "--from", "0,0,3"}))["focus_distance"]
              .get<double>() == Approx(2.0).epsilon(1e-4));
    const Outcome away = cube.render({"--lens-radius", "0.1", "--look-at", "0,0,9"});
    CHECK(away.exit_code == 2);
    CHECK(away.err.find("give --focus-distance") != std::string::npos);
}

TEST_CASE("option --f-stop is the focal length over the diameter of the lens")
{
    const LensFolder cube;
    // 90 degrees: a focal length of 12 mm
    const auto settings = settings_of(cube.rendered({"--fov", "90", "--f-stop", "2"}));
    CHECK(settings["lens_radius"].get<double>() == Approx(0.003));
}

TEST_CASE("cameras of the file may be orthographic or have a lens")
{
    const LensFolder cube(special_cameras);
    const ExrFile parallel = cube.rendered({});
    const auto settings = settings_of(parallel);
    CHECK(settings["projection"] == "orthographic");
    CHECK(settings["vertical_extent"] == 3.0);
    CHECK_FALSE(settings.contains("vertical_fov_degrees"));
    // The cube covers 2 m of 6 m x 3 m.
    const auto lit = std::count_if(parallel.image.pixels.begin(), parallel.image.pixels.end(),
                                   [](const Rgb& pixel) { return pixel.g > 0.5f; });
    CHECK(static_cast<double>(lit) / (64.0 * 32.0) == Approx(4.0 / 18.0).epsilon(0.1));
    for (const char* option : {"--lens-radius", "--f-stop", "--focus-distance", "--fov"}) {
        const Outcome outcome = cube.render({option, "1"});
        CAPTURE(option, outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find("orthographic") != std::string::npos);
    }

    const auto with_lens = settings_of(cube.rendered({"--camera", "1"}));
    CHECK(with_lens["lens_radius"] == 0.5);
    CHECK(with_lens["focus_distance"] == 4.0);
    // The focus of the file's lens stays when the lens changes.
    const auto other = settings_of(cube.rendered({"--camera", "1", "--lens-radius", "0.25"}));
    CHECK(other["lens_radius"] == 0.25);
    CHECK(other["focus_distance"] == 4.0);
    CHECK_FALSE(settings_of(cube.rendered({"--camera", "1", "--lens-radius", "0"}))
                    .contains("lens_radius"));
}

}  // namespace
}  // namespace bdpt::test::lens_test
