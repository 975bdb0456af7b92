#include "gltf/light_camera/light_camera.h"

#include "gltf/animation/node_transforms.h"
#include "gltf/animation/steps.h"

#include <bdpt/motion.h>

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace bdpt::io {

namespace {

/// Returns all but the first value, in single precision.
template <typename V, typename T>
std::vector<V> later(const std::vector<T>& values)
{
    std::vector<V> result;
    for (std::size_t i = 1; i < values.size(); ++i) {
        result.emplace_back(values[i]);
    }
    return result;
}

std::vector<Vec3> position_motion(std::span<const glm::dmat4> worlds)
{
    std::vector<glm::dvec3> positions;
    positions.reserve(worlds.size());
    for (const glm::dmat4& world : worlds) {
        positions.emplace_back(world[3]);
    }
    return later<Vec3>(thinned(std::span<const glm::dvec3>(positions)));
}

std::vector<Vec3> direction_turn(std::span<const glm::dmat4> worlds, Vec3 first, std::size_t node,
                                 LoadContext& context)
{
    std::vector<glm::dvec3> directions;
    directions.reserve(worlds.size());
    for (const glm::dmat4& world : worlds) {
        directions.emplace_back(transform_direction(world, {0.0, 0.0, -1.0}));
    }
    std::vector<Vec3> turn = later<Vec3>(thinned(std::span<const glm::dvec3>(directions)));
    for (const Vec3& direction : turn) {
        if (!can_turn(first, direction)) {
            context.warn(WarningKind::loss, "a light whose direction jumps keeps its direction",
                         fmt::format("/nodes/{}", node));
            return {};
        }
        first = direction;
    }
    return turn;
}

}  // namespace

std::vector<Mat4> camera_motion(std::span<const glm::dmat4> worlds, std::size_t node,
                                LoadContext& context)
{
    const std::vector<glm::dmat4> few = thinned(worlds);
    std::vector<Mat4> motion = later<Mat4>(few);
    if (!motion.empty() && !can_move(Mat4(few.front()), motion)) {
        context.warn(WarningKind::loss, "a camera whose direction jumps stands still",
                     fmt::format("/nodes/{}", node));
        return {};
    }
    return motion;
}

void move_light(LightDesc& light, std::span<const glm::dmat4> worlds, std::size_t node,
                LoadContext& context)
{
    if (worlds.empty()) {
        return;
    }
    if (auto* point = std::get_if<PointLightDesc>(&light)) {
        point->motion = position_motion(worlds);
    } else if (auto* spot = std::get_if<SpotLightDesc>(&light)) {
        spot->motion = position_motion(worlds);
        spot->later_directions = direction_turn(worlds, spot->direction, node, context);
    } else if (auto* sun = std::get_if<DirectionalLightDesc>(&light)) {
        sun->later_directions = direction_turn(worlds, sun->direction, node, context);
    } else if (auto* luminaire = std::get_if<ProfileLightDesc>(&light)) {
        luminaire->motion = position_motion(worlds);
        const auto turned = [first = glm::dmat3(worlds.front())](const glm::dmat4& world) {
            return glm::dmat3(world) != first;
        };
        if (std::any_of(worlds.begin(), worlds.end(), turned)) {
            context.warn(WarningKind::loss, "a light profile that turns keeps its orientation",
                         fmt::format("/nodes/{}", node));
        }
    }
}

}  // namespace bdpt::io
