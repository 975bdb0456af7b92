#include "gltf/animation/node_transforms.h"

#include "gltf/document/document.h"

#include <bdpt/error.h>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <string>

namespace bdpt::io {

namespace {

constexpr const char* instancing_extension = "EXT_mesh_gpu_instancing";

std::string pointer(std::size_t node)
{
    return fmt::format("/nodes/{}/extensions/{}/attributes", node, instancing_extension);
}

template <typename V>
std::vector<V> read(const tinygltf::Model& model, const tinygltf::Value& attributes,
                    const char* semantic, Integers integers)
{
    return attributes.Has(semantic)
               ? read_vectors<V>(model, attributes.Get(semantic).GetNumberAsInt(), integers)
               : std::vector<V>{};
}

/// Returns the number of values that all attributes have.
std::size_t count_values(const tinygltf::Model& model, const tinygltf::Value& attributes,
                         const std::string& place)
{
    std::size_t count = 0;
    std::string first;
    for (const std::string& semantic : attributes.Keys()) {
        const auto accessor = static_cast<std::size_t>(attributes.Get(semantic).GetNumberAsInt());
        const std::size_t values = model.accessors[accessor].count;
        if (first.empty()) {
            first = semantic;
            count = values;
        } else if (values != count) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("{}/{}: {} values, but {} has {}", place, semantic, values,
                                    first, count));
        }
    }
    return count;
}

}  // namespace

std::vector<glm::dmat4> instance_transforms(const tinygltf::Model& model, std::size_t node,
                                            std::size_t most, LoadContext& context)
{
    const tinygltf::ExtensionMap& extensions = model.nodes[node].extensions;
    const auto found = extensions.find(instancing_extension);
    if (found == extensions.end() || found->second.Get("attributes").Keys().empty()) {
        return {glm::dmat4(1.0)};
    }
    const tinygltf::Value& attributes = found->second.Get("attributes");
    const std::string place = pointer(node);
    const std::size_t count = count_values(model, attributes, place);
    if (count > most) {
        throw Error(
            ErrorCode::invalid_input,
            fmt::format("{}: {} instances, but the limits allow {} more", place, count, most));
    }
    context.budget.spend(place, count, sizeof(glm::dmat4) + 2 * sizeof(Vec3) + sizeof(Vec4));
    const auto translations = read<Vec3>(model, attributes, "TRANSLATION", Integers::as_declared);
    const auto rotations = read<Vec4>(model, attributes, "ROTATION", Integers::normalized);
    const auto scales = read<Vec3>(model, attributes, "SCALE", Integers::as_declared);
    std::vector<glm::dmat4> transforms(count, glm::dmat4(1.0));
    for (std::size_t i = 0; i < count; ++i) {
        glm::dmat4& transform = transforms[i];
        if (!translations.empty()) {
            transform = glm::translate(transform, glm::dvec3(translations[i]));
        }
        if (!rotations.empty()) {
            const glm::dvec4 xyzw(rotations[i]);
            const glm::dquat q(xyzw.w, xyzw.x, xyzw.y, xyzw.z);
            const double length = glm::length(q);
            // A zero quaternion is ignored, as in a node.
            transform = length == 0.0 ? transform : transform * glm::mat4_cast(q / length);
        }
        if (!scales.empty()) {
            transform = glm::scale(transform, glm::dvec3(scales[i]));
        }
    }
    return transforms;
}

}  // namespace bdpt::io
