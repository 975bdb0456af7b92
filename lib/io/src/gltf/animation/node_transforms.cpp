#include "gltf/animation/node_transforms.h"

#include "gltf/animation/transform.h"

#include <bdpt/error.h>
#include <bdpt/types.h>

#include <fmt/format.h>

namespace bdpt::io {

namespace {

constexpr std::size_t no_node = static_cast<std::size_t>(-1);

void check_finite(const glm::dmat4& world, std::size_t node)
{
    if (!is_finite(Mat4(world))) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("/nodes/{}: the transform to world space is not finite", node));
    }
}

}  // namespace

NodeTransforms::NodeTransforms(const tinygltf::Model& model, const DVec3& origin,
                               LoadContext& context)
    : model_(model),
      origin_(origin),
      context_(context),
      parents_(model.nodes.size(), no_node),
      world_(model.nodes.size())
{
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        for (const int child : model.nodes[i].children) {
            parents_[static_cast<std::size_t>(child)] = i;
        }
    }
}

const glm::dmat4& NodeTransforms::world(std::size_t node)
{
    std::vector<std::size_t> unknown;  // from the node upwards
    for (std::size_t i = node; i != no_node && !world_[i]; i = parents_[i]) {
        unknown.push_back(i);
    }
    for (; !unknown.empty(); unknown.pop_back()) {
        const std::size_t i = unknown.back();
        const std::size_t parent = parents_[i];
        const glm::dmat4 local = local_transform(model_, i, context_);
        glm::dmat4 world = parent == no_node ? local : *world_[parent] * local;
        if (parent == no_node) {
            world[3] -= glm::dvec4(origin_, 0.0);
        }
        check_finite(world, i);
        world_[i] = world;
    }
    return *world_[node];
}

}  // namespace bdpt::io
