#pragma once

#include <bdpt/scene_desc.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "attributes.h"
#include "options/value_types.h"

namespace bdpt::python {

using DMat4 = glm::dmat4;

/// A mesh with its material and placement. The geometry may be that of a scene, which it keeps.
struct ArrayMesh {
    std::shared_ptr<const MeshDesc> desc;
    std::shared_ptr<ArrayMaterial> material;
    std::vector<Mat4> transforms;
};

/// A camera, in a world of its own origin.
struct PythonCamera {
    CameraDesc desc{};
    DVec3 origin{0.0};                ///< as `SceneDesc::origin`
    std::optional<job::Size> size{};  ///< of its image, if it was stated

    /// Returns the camera in the world with another origin.
    [[nodiscard]] CameraDesc in_world(const DVec3& other) const;
};

/// Throws `ValueError` for an image without pixels.
void check_size(const std::pair<int, int>& size);

/// Contiguous doubles of NumPy.
using DoubleInput = nanobind::ndarray<const double, nanobind::c_contig, nanobind::device::cpu>;

/// Converts `value`, an argument called `name`, like NumPy. Throws `CallError` if these are no
/// numbers.
[[nodiscard]] DoubleInput to_doubles(nanobind::handle value, const std::string& name);

/// Returns the matrices (4, 4) or (n, 4, 4). Throws `ValueError` for other shapes, and for values
/// that are not finite.
[[nodiscard]] std::vector<DMat4> to_matrices(nanobind::handle value, const std::string& name);

/// Returns a 4 x 4 matrix of NumPy, row-major.
[[nodiscard]] nanobind::object to_numpy(const DMat4& matrix);

/// Returns a matrix of the world in the coordinates of the file.
[[nodiscard]] DMat4 in_file(const Mat4& matrix, const DVec3& origin);

}  // namespace bdpt::python
