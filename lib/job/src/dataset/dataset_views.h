#pragma once

#include <bdpt/scene_desc.h>
#include <bdpt/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dataset/dataset_arguments.h"
#include "options/value_types.h"

namespace bdpt::job {

/// Random numbers of a model: they depend on the seed, the model's name and the number of the view
/// alone, not on other models, machines or the order of views.
class ModelDraw {
public:
    ModelDraw(std::uint64_t seed, std::string_view model, std::uint64_t view);
    /// Returns the next number, in [0, 1).
    [[nodiscard]] double next();
    [[nodiscard]] double next(const NumberRange& interval);

private:
    std::uint64_t key_;
    std::uint64_t count_ = 0;
};

/// Returns the environment that a model draws. `environments` is not empty.
[[nodiscard]] const std::filesystem::path& drawn_environment(
    std::span<const std::filesystem::path> environments, std::uint64_t seed,
    std::string_view model);

/// Returns the cameras of a model with these bounds, by `draw`, in images of `size`. `camera` has
/// the default field of view. On the whole sphere they form a spherical Fibonacci lattice [Gonzalez
/// 2010, "Measurement of areas on a sphere using Fibonacci and latitude-longitude lattices"] in a
/// random rotation.
[[nodiscard]] std::vector<CameraDesc> drawn_cameras(const ViewDraw& draw, const CameraDesc& camera,
                                                    Vec3 min, Vec3 max, const Size& size,
                                                    std::uint64_t seed, std::string_view model);

/// A camera and its image.
struct PosedCamera {
    CameraDesc camera;
    Size size;
};

/// A view in a file of poses.
struct PoseRecord {
    std::string file;  ///< of the image, relative to that of the poses
    std::optional<std::string> depth{};
    std::optional<std::string> mask{};
    std::optional<double> time{};  ///< in the animation [s]
    PosedCamera view;              ///< in the world
};

/// Returns the text of a file of poses, as nerfstudio reads it: OpenGL's axes from camera to world
/// ("transform_matrix") in the coordinates of the model's file, and OpenCV's from world to camera
/// ("opencv"). `origin` is that of the world.
[[nodiscard]] std::string poses_text(std::span<const PoseRecord> records, const DVec3& origin);

/// Reads cameras from a file of poses. Without a size in the file, images have `size`; with both,
/// the cameras are scaled to `size`. Throws `Error`: not_found, invalid_input for a matrix that is
/// no rigid motion and for a size of another shape.
[[nodiscard]] std::vector<PosedCamera> read_poses(const std::filesystem::path& file,
                                                  const std::optional<Size>& size,
                                                  const DVec3& origin);

}  // namespace bdpt::job
