#include "gltf/light_camera/light_camera.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include <cmath>
#include <string>

namespace bdpt::io {
namespace {

std::optional<CameraDesc> read_perspective(const tinygltf::Camera& camera, const std::string& place,
                                           LoadContext& context)
{
    constexpr double pi = 3.141592653589793;
    const double yfov = camera.perspective.yfov;
    if (!(yfov > 0.0 && yfov < pi)) {
        context.warn(WarningKind::loss, "a camera with an impossible field of view is skipped",
                     fmt::format("{}/perspective/yfov: {}", place, yfov));
        return std::nullopt;
    }
    CameraDesc desc;
    desc.vertical_fov = static_cast<float>(yfov);
    if (camera.perspective.aspectRatio > 0.0) {
        desc.aspect_ratio = static_cast<float>(camera.perspective.aspectRatio);
    }
    return desc;
}

std::optional<CameraDesc> read_orthographic(const tinygltf::Camera& camera,
                                            const std::string& place, LoadContext& context)
{
    const double xmag = std::abs(camera.orthographic.xmag);
    const double ymag = std::abs(camera.orthographic.ymag);
    if (!is_length(xmag) || !is_length(ymag) || !is_length(2.0 * ymag) || !is_length(xmag / ymag)) {
        context.warn(WarningKind::loss,
                     "an orthographic camera with an impossible extent is skipped",
                     fmt::format("{}/orthographic: xmag {}, ymag {}", place,
                                 camera.orthographic.xmag, camera.orthographic.ymag));
        return std::nullopt;
    }
    CameraDesc desc;
    if (camera.orthographic.xmag < 0.0 || camera.orthographic.ymag < 0.0) {
        const bool both = camera.orthographic.xmag < 0.0 && camera.orthographic.ymag < 0.0;
        context.warn(both ? WarningKind::harmless : WarningKind::loss,
                     both ? "an orthographic camera of negative extent is turned upside down"
                          : "the mirror image of an orthographic camera of negative extent is "
                            "not made: the view is as of the positive one",
                     fmt::format("{}/orthographic: xmag {}, ymag {}", place,
                                 camera.orthographic.xmag, camera.orthographic.ymag));
    }
    desc.projection = Projection::orthographic;
    desc.vertical_extent = static_cast<float>(2.0 * ymag);
    desc.aspect_ratio = static_cast<float>(xmag / ymag);
    return desc;
}

}  // namespace

glm::dmat4 node_from_camera(const tinygltf::Camera& camera)
{
    const auto& extent = camera.orthographic;
    const bool turned = camera.type == "orthographic" && extent.xmag < 0.0 && extent.ymag < 0.0;
    return turned ? glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, -1, 0, 0),
                               glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1))
                  : glm::dmat4(1.0);
}

std::optional<CameraDesc> read_camera(const tinygltf::Model& model, std::size_t node,
                                      const glm::dmat4& world_from_node, LoadContext& context)
{
    const tinygltf::Node& holder = model.nodes[node];
    if (holder.camera < 0) {
        return std::nullopt;
    }
    const auto& camera = model.cameras[static_cast<std::size_t>(holder.camera)];
    const std::string place = fmt::format("/cameras/{}", holder.camera);
    std::optional<CameraDesc> desc = camera.type == "orthographic"
                                         ? read_orthographic(camera, place, context)
                                         : read_perspective(camera, place, context);
    if (!desc) {
        return std::nullopt;
    }
    if (!std::isnormal(glm::determinant(Mat3(world_from_node)))) {
        context.warn(WarningKind::loss, "a camera whose transform has no inverse is skipped",
                     fmt::format("/nodes/{}", node));
        return std::nullopt;
    }
    desc->name = camera.name.empty() ? holder.name : camera.name;
    desc->world_from_camera = Mat4(world_from_node * node_from_camera(camera));
    const Lens lens = read_lens(camera, *desc, place, context);
    desc->lens_radius = lens.radius;
    desc->focus_distance = lens.focus_distance;
    return desc;
}

}  // namespace bdpt::io
