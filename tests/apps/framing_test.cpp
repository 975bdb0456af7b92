#include <OpenEXR/ImfMatrixAttribute.h>

#include <bdpt/io/write_image.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scene_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::framing_test {
namespace {

using Words = std::vector<std::string>;

/// Renders a cube of 2 m, in a file with two cameras.
class CubeFolder {
public:
    [[nodiscard]] Outcome render(const Words& more) const
    {
        Words words{"render",      scene_, "--size", "40x20",   "--spp",        "2",
                    "--max-depth", "1",    "--env",  "default", "--integrator", "pt"};
        words.insert(words.end(), more.begin(), more.end());
        if (std::find(more.begin(), more.end(), "-o") == more.end()) {
            words.insert(words.end(), {"-o", path("out.exr")});
        }
        return run(words);
    }
    [[nodiscard]] ExrFile rendered(const Words& more, const std::string& name = "out.exr") const
    {
        const Outcome outcome = render(more);
        CAPTURE(more, outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return read_exr(path(name));
    }
    void check_refused(const Words& more, const std::string& message) const
    {
        const Outcome outcome = render(more);
        CAPTURE(more, outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find(message) != std::string::npos);
    }
    [[nodiscard]] std::string path(const std::string& name) const
    {
        return (folder_ / name).string();
    }

private:
    ScratchFolder folder_;
    std::string scene_ =
        write_cube(folder_, "cube", {.material = emissive_material, .cameras = two_cameras})
            .string();
};

Imath::M44f world_to_camera(const ExrFile& file)
{
    return file.header.typedAttribute<Imf::M44fAttribute>("worldToCamera").value();
}

/// The position of the camera.
Imath::V3f eye(const ExrFile& file)
{
    Imath::V3f result;
    world_to_camera(file).inverse().multVecMatrix(Imath::V3f(0.0f), result);
    return result;
}

bool is_near(Imath::V3f a, Imath::V3f b)
{
    return (a - b).length() < 2e-3f;
}

TEST_CASE("a side to view from frames the scene, whatever cameras it has", "[framing]")
{
    const CubeFolder folder;
    // The front of the cube, 2 m high, fills 80 % of the height: tan(20 deg) (d - 1) 0.8 = 1.
    const float distance = 1.0f + 1.0f / (0.8f * 0.36397023f);
    CHECK(is_near(eye(folder.rendered({"--view", "front"})), {0.0f, 0.0f, distance}));
    CHECK(is_near(eye(folder.rendered({"--view", "back"})), {0.0f, 0.0f, -distance}));
    CHECK(is_near(eye(folder.rendered({"--view", "right"})), {distance, 0.0f, 0.0f}));
    CHECK(is_near(eye(folder.rendered({"--view", "Left"})), {-distance, 0.0f, 0.0f}));
    CHECK(is_near(eye(folder.rendered({"--view", "top"})), {0.0f, distance, 0.0f}));
    CHECK(is_near(eye(folder.rendered({"--view", "bottom"})), {0.0f, -distance, 0.0f}));
    CHECK(is_near(eye(folder.rendered({"--view", "90,0", "--camera", "auto"})),
                  {distance, 0.0f, 0.0f}));
    // Without a margin, and with a lens of 50 mm: tan(fov / 2) = 12 / 50.
    const float near = 1.0f + 1.0f / 0.24f;
    CHECK(
        is_near(eye(folder.rendered({"--view", "front", "--margin", "0%", "--focal-length", "50"})),
                {0.0f, 0.0f, near}));
    CHECK(world_to_camera(folder.rendered({"--margin", "10"})) ==
          world_to_camera(folder.rendered({"--view", "three-quarter"})));
}

TEST_CASE("an orthographic view has no perspective", "[framing]")
{
    const CubeFolder folder;
    // Its edges are 2 m high, which is 80 % of 20 pixels, near and far ones alike.
    const auto lit_in_column = [](const ExrFile& file, int column) {
        int lit = 0;
        for (int row = 0; row < file.image.height; ++row) {
            const auto pixel = static_cast<std::size_t>(row * file.image.width + column);
            lit += file.image.pixels.at(pixel).g > 0.5f ? 1 : 0;
        }
        return lit;
    };
    const Words askew{"--view", "45,0", "--env", "none", "--filter", "box"};
    Words parallel = askew;
    parallel.emplace_back("--ortho");
    const ExrFile file = folder.rendered(parallel);
    CHECK(lit_in_column(file, 20) == 16);
    CHECK(lit_in_column(file, 10) == 16);
    CHECK(lit_in_column(file, 7) == 0);
    const ExrFile perspective = folder.rendered(askew);
    CHECK(lit_in_column(perspective, 20) >= 15);  // of its corners, half is in the column
    CHECK(lit_in_column(perspective, 13) < 16);
}

TEST_CASE("a turntable turns the camera, or the object in a light that stands still", "[framing]")
{
    const CubeFolder folder;
    const std::string sky = folder.path("sky.exr");
    Image image{.width = 4, .height = 2, .pixels = std::vector<Rgb>(8, Rgb(0.1f))};
    image.pixels[1] = Rgb(4.0f);  // to one side
    io::write_exr(sky, image, {});
    const auto view = [&](const Words& more, const std::string& name) {
        Words words{"--env", sky, "--max-depth", "3", "--spp", "16", "--same-noise"};
        words.insert(words.end(), more.begin(), more.end());
        return folder.rendered(words, name);
    };
    const auto turned = [&](const std::string& what) {
        return view({"--view", "front", "--orbit", "4", "--frames", "2", "--turn", what, "-o",
                     folder.path("t.#.exr")},
                    "t.2.exr");
    };
    const ExrFile camera = turned("camera");
    const ExrFile object = turned("object");
    CHECK(world_to_camera(camera) == world_to_camera(object));
    CHECK(camera.image.pixels != object.image.pixels);
    const ExrFile expected = view({"--view", "front", "--orbit", "4", "--frames", "2",
                                   "--env-rotation", "90", "-o", folder.path("e.#.exr")},
                                  "e.2.exr");
    CHECK(object.image.pixels == expected.image.pixels);
    // All of it is in the image: the corners of the cube come nearer than its front.
    const ExrFile first =
        view({"--view", "front", "--orbit", "4", "--frames", "1", "-o", folder.path("f.#.exr")},
             "f.1.exr");
    CHECK(eye(first).z > 1.0f + 1.0f / (0.8f * 0.36397023f) + 0.1f);
}

TEST_CASE("a note says that a camera of the file shows little of the scene")
{
    const ScratchFolder folder;
    // From 60 m the cube of 2 m fills 2 m x 2 m of 101 m x 51 m, or none from behind.
    const auto notes = [&](const std::string& translation, const Words& more) {
        const std::string scene =
            write_cube(
                folder, "far",
                {.cameras = R"({"name": "far", "camera": 0, "translation": )" + translation + "},",
                 .camera_nodes = 1})
                .string();
        Words words{"render", scene,          "--size", "40x20", "--spp",
                    "1",      "--integrator", "pt",     "-o",    (folder / "out.exr").string(),
                    "--env",  "default"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(words);
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 0);
        return outcome.err;
    };
    const auto told = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    const std::string hint = "of the image (--camera auto frames it)";
    const std::string far = notes("[0, 0, 60]", {});
    CHECK(told(far, "far.gltf: camera far: the scene fills 0."));
    CHECK(told(far, hint));
    CHECK(told(notes("[0, 0, -60]", {}), "the scene fills 0 % of the image"));
    CHECK_FALSE(told(notes("[0, 0, 5]", {}), hint));
    CHECK_FALSE(told(notes("[0, 0, 60]", {"--camera", "0"}), hint));
    CHECK_FALSE(told(notes("[0, 0, 60]", {"--camera", "auto"}), hint));
    CHECK_FALSE(told(notes("[0, 0, 60]", {"--fov", "3"}), hint));
}

TEST_CASE("options of framing that contradict others are refused", "[framing]")
{
    const CubeFolder folder;
    folder.check_refused({"--view", "front", "--from", "1,2,3"},
                         "--view cannot be combined with --from");
    folder.check_refused({"--margin", "5", "--look-at", "0,0,0"},
                         "--margin cannot be combined with --look-at");
    folder.check_refused({"--ortho", "--fov", "30"}, "--ortho cannot be combined with --fov");
    folder.check_refused({"--fov", "30", "--focal-length", "50"},
                         "--focal-length cannot be combined with --fov");
    folder.check_refused({"--view", "front", "--camera", "side"},
                         "--view frames the whole scene and cannot be combined with --camera "
                         "\"side\"");
    folder.check_refused({"--view", "frnt"}, "--view \"frnt\": expected front, right");
    folder.check_refused({"--view", "0,91"}, "--view \"0,91\"");
    folder.check_refused({"--margin", "50"}, "expected percent from 0 to 45");
    folder.check_refused({"--focal-length", "0"}, "expected millimetres from 1 to 10000");
    folder.check_refused({"--turn", "object"}, "--turn needs --orbit");
}

}  // namespace
}  // namespace bdpt::test::framing_test
