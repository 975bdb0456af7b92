#include "scene/checks/validate.h"

#include "geometry/placed_mesh.h"
#include "scene/checks/value_checks.h"
#include "scene/scene_geometry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <sstream>
#include <variant>

namespace bdpt {
namespace {

float greatest(Vec3 v)
{
    return std::max({v.x, v.y, v.z});
}

MeshBox transformed(const MeshBox& box, const Mat4& m)
{
    return {.center = Vec3(m * Vec4(box.center, 1.0f)),
            .half = abs(Vec3(m[0])) * box.half.x + abs(Vec3(m[1])) * box.half.y +
                    abs(Vec3(m[2])) * box.half.z};
}

/// An instance, and the error of the points on it.
struct Placed {
    std::size_t instance = 0;
    MeshBox box;
    float distance = 0.0f;  ///< maximum coordinate of its points [m]
    float error = 0.0f;     ///< [m]

    [[nodiscard]] float size() const { return 2.0f * greatest(box.half); }
    /// Tests whether all of it is near one axis-aligned plane.
    [[nodiscard]] bool is_flat() const
    {
        return std::min({box.half.x, box.half.y, box.half.z}) < error;
    }
};

std::vector<Placed> place(const SharedSceneDesc& desc,
                          std::span<const std::optional<MeshBox>> boxes)
{
    std::vector<Placed> result;
    for (std::size_t i = 0; i < desc.instances.size(); ++i) {
        const InstanceDesc& instance = desc.instances[i];
        if (const auto& box = boxes[static_cast<std::size_t>(instance.mesh)]) {
            const MeshBox world = transformed(*box, instance.world_from_object);
            const float distance = greatest(abs(world.center) + world.half);
            result.push_back({i, world, distance, position_error(distance)});
        }
    }
    return result;
}

std::optional<Vec3> find_position(const LightDesc& light)
{
    return std::visit(
        [](const auto& kind) -> std::optional<Vec3> {
            if constexpr (requires { kind.position; }) {
                return kind.position;
            } else {
                return std::nullopt;
            }
        },
        light);
}

std::string known_to(const Placed& placed, const DVec3& origin)
{
    std::ostringstream text;
    text << "its points have a precision of " << placed.error << " m only, because it extends "
         << placed.distance << " m from the "
         << (origin == DVec3(0.0) ? "origin" : "centre of the scene");
    return text.str();
}

}  // namespace

std::vector<std::string> precision_warnings(const SharedSceneDesc& desc,
                                            const SceneGeometry& geometry)
{
    constexpr float min_exact = 0.1f;  // fraction of its size
    std::vector<std::string> warnings;
    const std::vector<Placed> all = place(desc, geometry.boxes);
    const Placed* coarsest = nullptr;
    const Placed* vaguest = nullptr;  // the worst of those that are small
    std::size_t vague = 0;
    for (const Placed& placed : all) {
        if (placed.error > min_exact * placed.size()) {
            ++vague;
            vaguest = vaguest == nullptr || placed.error > vaguest->error ? &placed : vaguest;
        }
        coarsest = coarsest == nullptr || placed.error > coarsest->error ? &placed : coarsest;
    }
    const auto name = [&desc](const Placed& placed) {
        return label("instance", placed.instance, desc.instances[placed.instance].name);
    };
    if (vaguest != nullptr) {
        std::ostringstream text;
        text << name(*vaguest) << ": is " << vaguest->size() << " m large, but "
             << known_to(*vaguest, desc.origin);
        if (vague > 1) {
            text << " (and " << vague - 1 << " more of this kind)";
        }
        warnings.push_back(text.str());
    }
    if (const std::vector<std::size_t>& thin = geometry.contacts.thin; !thin.empty()) {
        const auto first = std::find_if(all.begin(), all.end(), [&thin](const Placed& placed) {
            return placed.instance == thin[0];
        });
        std::ostringstream text;
        text << name(*first) << ": is too thin: opposite faces are hardly told apart, as "
             << known_to(*first, desc.origin) << "; light may pass it wrongly";
        if (thin.size() > 1) {
            text << " (and " << thin.size() - 1 << " more of this kind)";
        }
        warnings.push_back(text.str());
    }
    constexpr float max_exact = 1e12f;  // [m]; beyond it, shading overflows single precision
    if (coarsest != nullptr && coarsest->distance > max_exact) {
        std::ostringstream text;
        text << name(*coarsest) << ": extends " << coarsest->distance
             << " m from the origin: beyond " << max_exact << " m the image may be wrong";
        warnings.push_back(text.str());
    }
    if (coarsest == nullptr || !coarsest->is_flat()) {
        return warnings;
    }
    for (std::size_t i = 0; i < desc.lights.size(); ++i) {
        const auto position = find_position(desc.lights[i]);
        if (position && greatest(abs(*position - coarsest->box.center) - coarsest->box.half) <
                            coarsest->error) {
            const std::string lamp = std::visit(
                [i](const auto& light) { return light_label(light, i); }, desc.lights[i]);
            warnings.push_back(name(*coarsest) + ": " + known_to(*coarsest, desc.origin) +
                               ", but " + lamp +
                               " is nearer to it than that: its light may be lost");
            break;
        }
    }
    return warnings;
}

}  // namespace bdpt
