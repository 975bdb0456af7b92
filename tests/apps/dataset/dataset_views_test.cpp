#include "dataset/dataset.h"

#include <bdpt/error.h>
#include <bdpt/tools/intrinsics.h>

#include "catch.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "options/output_files.h"

namespace bdpt::dataset_views_test {
namespace {

using namespace job;

constexpr Size size{320, 240};
const Vec3 low(-1.0f, 2.0f, 3.0f);
const Vec3 high(2.0f, 3.0f, 7.0f);

std::vector<CameraDesc> cameras(const ViewDraw& draw, std::uint64_t seed = 1,
                                const std::string& model = "chair", const Size& image = size)
{
    CameraDesc camera;
    camera.vertical_fov = 0.7f;
    return drawn_cameras(draw, camera, low, high, image, seed, model);
}

Vec3 direction_of(const CameraDesc& camera)
{
    return Vec3(camera.world_from_camera[2]);
}

/// Returns where the camera shows a point [pixels].
Vec2 projected(const CameraDesc& camera, Vec3 point, const Size& image)
{
    const Vec3 local(glm::inverse(camera.world_from_camera) * Vec4(point, 1.0f));
    const Intrinsics values = intrinsics(camera, image.width, image.height);
    return {static_cast<float>(values.cx) - static_cast<float>(values.fx) * local.x / local.z,
            static_cast<float>(values.cy) + static_cast<float>(values.fy) * local.y / local.z};
}

/// Returns the message with which a file of poses is refused.
std::string refusal(const std::string& text, const std::optional<Size>& asked = {})
{
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.file("poses.json");
    std::ofstream(file) << text;
    try {
        static_cast<void>(read_poses(file, asked, DVec3(0.0)));
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::invalid_input);
        const std::string message = error.what();
        CHECK(message.starts_with(file.string()));
        return message.substr(file.string().size());
    }
    return "accepted";
}

}  // namespace

TEST_CASE("drawn views show the whole model from all sides", "[dataset]")
{
    for (const Size& image : {Size{320, 240}, Size{100, 300}}) {
        const std::vector<CameraDesc> drawn = cameras({.count = 50}, 1, "chair", image);
        REQUIRE(drawn.size() == 50);
        Vec3 sum(0.0f);
        for (const CameraDesc& camera : drawn) {
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3 point((corner & 1) != 0 ? low.x : high.x,
                                 (corner & 2) != 0 ? low.y : high.y,
                                 (corner & 4) != 0 ? low.z : high.z);
                const Vec2 raster = projected(camera, point, image);
                CHECK(raster.x >= 0.0f);
                CHECK(raster.y >= 0.0f);
                CHECK(raster.x <= static_cast<float>(image.width));
                CHECK(raster.y <= static_cast<float>(image.height));
            }
            CHECK(std::abs(camera.world_from_camera[0].y) < 1e-6f);  // the horizon is level
            sum += direction_of(camera);
        }
        CHECK(glm::length(sum) < 1.0f);  // spread evenly: 50 random ones would give about 7
    }
}

TEST_CASE("a view depends on seed, model and its number alone", "[dataset]")
{
    const ViewDraw draw{.count = 8,
                        .range = ViewRange{.azimuth = {-1.0, 1.0}, .elevation = {0.0, 0.5}},
                        .distance = {1.0, 2.0},
                        .vertical_fov = NumberRange{0.5, 1.0}};
    const std::vector<CameraDesc> drawn = cameras(draw);
    ViewDraw more = draw;
    more.count = 20;
    const std::vector<CameraDesc> longer = cameras(more);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        CHECK(drawn[i].world_from_camera == longer[i].world_from_camera);
        CHECK(drawn[i].vertical_fov == longer[i].vertical_fov);
    }
    CHECK(drawn.front().world_from_camera != cameras(draw, 2).front().world_from_camera);
    CHECK(drawn.front().world_from_camera != cameras(draw, 1, "table").front().world_from_camera);
}

TEST_CASE("views are drawn from their ranges", "[dataset]")
{
    const ViewDraw draw{.count = 1000,
                        .range = ViewRange{.azimuth = {-1.0, 2.0}, .elevation = {0.1, 1.2}},
                        .vertical_fov = NumberRange{0.5, 1.0}};
    double heights = 0.0;
    for (const CameraDesc& camera : cameras(draw)) {
        const Vec3 d = direction_of(camera);
        const double azimuth = std::atan2(d.x, d.z);
        CHECK(azimuth >= -1.0001);
        CHECK(azimuth <= 2.0001);
        CHECK(d.y >= std::sin(0.0999f));
        CHECK(d.y <= std::sin(1.2001f));
        CHECK(camera.vertical_fov >= 0.5f);
        CHECK(camera.vertical_fov <= 1.0f);
        heights += d.y / 1000.0;
    }
    CHECK(heights == Approx(0.5 * (std::sin(0.1) + std::sin(1.2))).margin(0.03));  // by area
}

TEST_CASE("models draw different environments", "[dataset]")
{
    const std::vector<std::filesystem::path> files{"a.exr", "b.exr", "c.exr"};
    std::set<std::filesystem::path> drawn;
    for (int i = 0; i < 40; ++i) {
        drawn.insert(drawn_environment(files, 1, "model " + std::to_string(i)));
    }
    CHECK(drawn.size() == 3);
}

TEST_CASE("poses are read back as they were written", "[dataset]")
{
    const DVec3 origin(5e5, -2e6, 100.0);
    std::vector<PoseRecord> records;
    for (const CameraDesc& camera : cameras({.count = 3})) {
        PoseRecord& record = records.emplace_back();
        record.file = std::to_string(records.size()) + ".png";
        record.view = {camera, size};
    }
    SECTION("the same for all") {}
    SECTION("intrinsics of real cameras")
    {
        records[1].view.camera.shift = {0.1f, -0.2f};
        records[2].view.camera.pixel_aspect = 1.25f;
    }
    SECTION("parallel rays")
    {
        records[1].view.camera.projection = Projection::orthographic;
        records[1].view.camera.vertical_extent = 3.0f;
    }
    const TemporaryFolder folder;
    write_text(folder.file("poses.json"), poses_text(records, origin));
    const std::vector<PosedCamera> read = read_poses(folder.file("poses.json"), {}, origin);
    REQUIRE(read.size() == records.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
        const CameraDesc& a = records[i].view.camera;
        const CameraDesc& b = read[i].camera;
        for (int column = 0; column < 4; ++column) {
            CHECK(glm::length(a.world_from_camera[column] - b.world_from_camera[column]) < 1e-6f);
        }
        CHECK(b.projection == a.projection);
        if (a.projection == Projection::perspective) {
            CHECK(b.vertical_fov == Approx(a.vertical_fov).epsilon(1e-5));
            CHECK(b.pixel_aspect == Approx(a.pixel_aspect).epsilon(1e-5));
            CHECK(glm::distance(b.shift, a.shift) < 1e-6f);
        } else {
            CHECK(b.vertical_extent == a.vertical_extent);
        }
        CHECK(read[i].size.width == size.width);
        CHECK(read[i].size.height == size.height);
    }
    const std::vector<PosedCamera> half =
        read_poses(folder.file("poses.json"), Size{160, 120}, origin);
    CHECK(half[1].size.width == 160);
    CHECK(half[1].camera.vertical_fov == read[1].camera.vertical_fov);
}

TEST_CASE("poses of NeRF's Blender scenes are read", "[dataset]")
{
    const TemporaryFolder folder;
    write_text(folder.file("transforms_train.json"), R"({"camera_angle_x": 0.8, "frames": [
        {"file_path": "./train/r_0", "rotation": 0.01, "transform_matrix":
         [[1, 0, 0, 0.5], [0, 0, -1, -4], [0, 1, 0, 2], [0, 0, 0, 1]]}]})");
    const std::vector<PosedCamera> read =
        read_poses(folder.file("transforms_train.json"), Size{800, 800}, DVec3(0.0));
    REQUIRE(read.size() == 1);
    CHECK(read[0].camera.vertical_fov == Approx(0.8f).epsilon(1e-5));
    CHECK(Vec3(read[0].camera.world_from_camera[3]) == Vec3(0.5f, -4.0f, 2.0f));
    CHECK(Vec3(read[0].camera.world_from_camera[2]) == Vec3(0.0f, -1.0f, 0.0f));
}

TEST_CASE("poses that are none are refused by place and reason", "[dataset]")
{
    const auto with_matrix = [](const std::string& matrix) {
        return R"({"camera_angle_x": 0.8, "w": 320, "h": 240, "frames": [{"transform_matrix": )" +
               matrix + "}]}";
    };
    CHECK(refusal(with_matrix("[[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]")) ==
          ": /frames/0/transform_matrix: is no rigid motion: its axes are not orthogonal and of "
          "length 1");
    CHECK(refusal(with_matrix("[[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]")) ==
          ": /frames/0/transform_matrix: is no rigid motion: it mirrors");
    CHECK(refusal(with_matrix("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]")) ==
          ": /frames/0/transform_matrix: is no rigid motion: its last row is not 0, 0, 0, 1");
    const std::string unit = "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]";
    CHECK(refusal(with_matrix(unit), Size{100, 100}) ==
          ": /frames/0: its image has 320x240 pixels; --size 100x100 has another shape");
    CHECK(refusal(R"({"frames": []})") == ": /frames: is empty");
    CHECK(refusal(R"({"frames": [{"transform_matrix": )" + unit + "}]}")
              .find("has no fl_x and no camera_angle_x") != std::string::npos);
}

}  // namespace bdpt::dataset_views_test
