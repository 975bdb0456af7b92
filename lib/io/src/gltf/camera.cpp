#include "gltf/camera.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include <cmath>
#include <string>

namespace bdpt::io {

std::optional<CameraDesc> read_camera(const tinygltf::Model& model, std::size_t node,
                                      const glm::dmat4& world_from_node, Warnings& warnings)
{
    const tinygltf::Node& holder = model.nodes[node];
    if (holder.camera < 0) {
        return std::nullopt;
    }
    const auto& camera = model.cameras[static_cast<std::size_t>(holder.camera)];
    const std::string place = fmt::format("/cameras/{}", holder.camera);
    if (camera.type != "perspective") {
        warnings.add("only perspective cameras can be rendered; skipped",
                     place + ": " + camera.type);
        return std::nullopt;
    }
    constexpr double pi = 3.141592653589793;
    const double yfov = camera.perspective.yfov;
    if (!(yfov > 0.0 && yfov < pi)) {
        warnings.add("a camera with an impossible field of view is skipped",
                     fmt::format("{}/perspective/yfov: {}", place, yfov));
        return std::nullopt;
    }
    if (!std::isnormal(glm::determinant(Mat3(world_from_node)))) {
        warnings.add("a camera whose transform has no inverse is skipped",
                     fmt::format("/nodes/{}", node));
        return std::nullopt;
    }
    CameraDesc desc;
    desc.name = camera.name.empty() ? holder.name : camera.name;
    desc.world_from_camera = Mat4(world_from_node);
    desc.vertical_fov = static_cast<float>(yfov);
    if (camera.perspective.aspectRatio > 0.0) {
        desc.aspect_ratio = static_cast<float>(camera.perspective.aspectRatio);
    }
    return desc;
}

}  // namespace bdpt::io
