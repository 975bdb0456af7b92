#include "scene/checks/validate.h"

#include "geometry/motion.h"
#include "geometry/placed_mesh.h"
#include "scene/checks/value_checks.h"

#include <bdpt/motion.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace bdpt {
namespace {

template <typename T>
bool is_finite(const T& value)
{
    if constexpr (requires {
                      value.length();
                      value[0][0];
                  }) {
        for (int i = 0; i < T::length(); ++i) {
            if (!is_finite(value[i])) {
                return false;
            }
        }
        return true;
    } else {
        for (int i = 0; i < T::length(); ++i) {
            if (!std::isfinite(value[i])) {
                return false;
            }
        }
        return true;
    }
}

void check_steps(const std::string& item, std::size_t steps)
{
    if (steps > max_time_steps) {
        fail(item, ": motion of ", steps, " steps, but ", max_time_steps, " is the most");
    }
}

std::string step_label(const std::string& item, std::size_t step)
{
    return item + ": motion, step " + std::to_string(step);
}

template <typename T>
void check_values(const std::string& item, const char* what, const std::vector<T>& values,
                  std::size_t wanted)
{
    if (values.size() != wanted) {
        fail(item, ": ", values.size(), " ", what, ", but the mesh has ", wanted);
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!is_finite(values[i])) {
            fail(item, ": ", what, " ", i, " is not finite");
        }
    }
}

void check_moving(const MeshDesc& mesh, const std::string& item)
{
    check_steps(item, mesh.motion.size());
    for (std::size_t i = 0; i < mesh.motion.size(); ++i) {
        const MeshPose& pose = mesh.motion[i];
        const std::string step = step_label(item, i);
        check_values(step, "positions", pose.positions, mesh.positions.size());
        check_values(step, "normals", pose.normals, mesh.normals.size());
        check_values(step, "tangents", pose.tangents, mesh.tangents.size());
    }
}

/// Checks an instance; `extent` is that of the mesh in all of its poses.
void check_moving(const InstanceDesc& instance, const std::string& item, const MeshDesc& mesh,
                  Vec3 extent, float reach)
{
    const std::span<const Mat4> motion = instance.motion;
    check_steps(item, motion.size());
    if (!motion.empty() && !mesh.motion.empty() && motion.size() != mesh.motion.size()) {
        fail(item, ": motion of ", motion.size(), " steps, but its mesh has ", mesh.motion.size());
    }
    const auto check_extent = [&](const Mat4& transform) {
        const float placed = placed_extent(extent, transform);
        if (!(placed <= reach)) {
            fail(item, ": reaches ", placed, limit_text(reach));
        }
    };
    check_extent(instance.world_from_object);
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const std::string step = step_label(item, i);
        if (!is_finite(motion[i])) {
            fail(step, ": transform is not finite");
        }
        if (!can_move(at_step(instance.world_from_object, motion, i), motion[i])) {
            fail(step, ": an interpolated transform before it has no inverse; use more steps");
        }
        check_extent(motion[i]);
    }
}

void check_positions(const std::string& item, const std::vector<Vec3>& motion, float reach)
{
    check_steps(item, motion.size());
    for (std::size_t i = 0; i < motion.size(); ++i) {
        const Vec3 size = abs(motion[i]);
        const float extent = std::max({size.x, size.y, size.z});
        if (!is_finite(motion[i])) {
            fail(step_label(item, i), ": position is not finite");
        }
        if (extent > reach) {
            fail(step_label(item, i), ": is ", extent, limit_text(reach));
        }
    }
}

void check_directions(const std::string& item, Vec3 first, std::span<const Vec3> turn)
{
    check_steps(item, turn.size());
    for (std::size_t i = 0; i < turn.size(); ++i) {
        if (!is_finite(turn[i]) || !(dot(turn[i], turn[i]) > 0.0f)) {
            fail(step_label(item, i), ": direction is zero or not finite");
        }
        if (!can_turn(at_step(first, turn, i), turn[i])) {
            fail(step_label(item, i), ": direction turns by 90 degrees or more; use more steps");
        }
    }
}

template <typename Light>
void check_moving(const Light& light, std::size_t index, float reach)
{
    if constexpr (requires { light.motion; }) {
        check_positions(light_label(light, index), light.motion, reach);
    }
    if constexpr (requires { light.later_directions; }) {
        check_directions(light_label(light, index), light.direction, light.later_directions);
    }
}

void check_places(const SharedSceneDesc& desc, float reach)
{
    std::vector<Vec3> extents;
    extents.reserve(desc.meshes.size());
    for (std::size_t i = 0; i < desc.meshes.size(); ++i) {
        const MeshDesc& mesh = desc.meshes[i];
        check_moving(mesh, label("mesh", i, mesh.name));
        extents.push_back(compute_extent(mesh));
    }
    for (std::size_t i = 0; i < desc.instances.size(); ++i) {
        const InstanceDesc& instance = desc.instances[i];
        const auto mesh = static_cast<std::size_t>(instance.mesh);
        if (!instance.motion.empty() || !desc.meshes[mesh].motion.empty()) {
            check_moving(instance, label("instance", i, instance.name), desc.meshes[mesh],
                         extents[mesh], reach);
        }
    }
}

}  // namespace

void check_motion(const SharedSceneDesc& desc, float reach, bool places_are_valid)
{
    if (!places_are_valid) {
        check_places(desc, reach);
    }
    for (std::size_t i = 0; i < desc.lights.size(); ++i) {
        std::visit([&](const auto& light) { check_moving(light, i, reach); }, desc.lights[i]);
    }
}

}  // namespace bdpt
