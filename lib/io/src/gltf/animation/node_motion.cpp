#include "gltf/animation/node_transforms.h"

#include "gltf/animation/steps.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace bdpt::io {

namespace {

/// Nodes that an animation may move.
struct Movable {
    std::set<std::size_t> nodes;     ///< including all below them
    std::set<std::size_t> weighted;  ///< nodes whose weights change
};

Movable find_movable(const tinygltf::Model& model, std::span<const AnimatedProperty> properties)
{
    Movable movable;
    std::vector<std::size_t> pending;
    for (const AnimatedProperty& property : properties) {
        if (property.member == &tinygltf::Node::weights) {
            movable.weighted.insert(property.node);
        } else {
            pending.push_back(property.node);
        }
    }
    while (!pending.empty()) {
        const std::size_t node = pending.back();
        pending.pop_back();
        if (movable.nodes.insert(node).second) {
            for (const int child : model.nodes[node].children) {
                pending.push_back(static_cast<std::size_t>(child));
            }
        }
    }
    return movable;
}

/// Values at equally spaced times, by node.
struct Samples {
    std::map<std::size_t, std::vector<glm::dmat4>> world;
    std::map<std::size_t, std::vector<std::vector<double>>> weights;
};

Samples take_samples(tinygltf::Model& model, std::span<const AnimatedProperty> properties,
                     const Movable& movable, double open, double close, std::size_t steps,
                     LoadContext& context)
{
    Samples samples;
    const Silence silence(context.warnings);  // The pose at the opening has given all warnings.
    for (std::size_t i = 0; i <= steps; ++i) {
        const double u = static_cast<double>(i) / static_cast<double>(steps);
        pose(model, properties, (1.0 - u) * open + u * close);
        NodeTransforms transforms(model, DVec3(0.0), context);
        for (const std::size_t node : movable.nodes) {
            samples.world[node].push_back(transforms.world(node));
        }
        for (const std::size_t node : movable.weighted) {
            samples.weights[node].push_back(model.nodes[node].weights);
        }
    }
    pose(model, properties, open);
    return samples;
}

/// Tests whether linear interpolation between every second sample is close to the others.
bool weights_are_close(const std::vector<std::vector<double>>& weights)
{
    for (std::size_t target = 0; target < weights.front().size(); ++target) {
        const auto [least, greatest] = std::minmax_element(
            weights.begin(), weights.end(),
            [target](const auto& a, const auto& b) { return a[target] < b[target]; });
        const double tolerance = way_tolerance * ((*greatest)[target] - (*least)[target]) + 1e-9;
        for (std::size_t i = 1; i < weights.size(); i += 2) {
            const double line = 0.5 * (weights[i - 1][target] + weights[i + 1][target]);
            if (!(std::abs(line - weights[i][target]) <= tolerance)) {
                return false;
            }
        }
    }
    return true;
}

bool samples_are_close(const Samples& samples)
{
    return std::all_of(samples.world.begin(), samples.world.end(),
                       [](const auto& node) {
                           return are_close(std::span<const glm::dmat4>(node.second), 2);
                       }) &&
           std::all_of(samples.weights.begin(), samples.weights.end(),
                       [](const auto& node) { return weights_are_close(node.second); });
}

/// Returns every second value of the nodes that move at all.
template <typename T>
std::map<std::size_t, std::vector<T>> every_second(
    const std::map<std::size_t, std::vector<T>>& samples)
{
    std::map<std::size_t, std::vector<T>> result;
    for (const auto& [node, values] : samples) {
        if (std::all_of(values.begin(), values.end(),
                        [&first = values.front()](const T& value) { return value == first; })) {
            continue;
        }
        for (std::size_t i = 0; i < values.size(); i += 2) {
            result[node].push_back(values[i]);
        }
    }
    return result;
}

}  // namespace

NodeMotion::NodeMotion(tinygltf::Model& model, std::span<const AnimatedProperty> properties,
                       double open, double close, LoadContext& context)
{
    constexpr std::size_t max_steps = 64;
    pose(model, properties, open);
    const Movable movable = find_movable(model, properties);
    if (!(open < close) || (movable.nodes.empty() && movable.weighted.empty())) {
        return;
    }
    std::size_t weights = 0;
    for (const std::size_t node : movable.weighted) {
        weights += model.nodes[node].weights.size();
    }
    for (std::size_t steps = 1; steps <= max_steps; steps *= 2) {
        // Twice as many samples, to check the interpolation halfway between two steps.
        context.budget.spend("/animations", 2 * steps + 1,
                             movable.nodes.size() * sizeof(glm::dmat4) + weights * sizeof(double));
        const Samples samples =
            take_samples(model, properties, movable, open, close, 2 * steps, context);
        if (steps == max_steps || samples_are_close(samples)) {
            world_ = every_second(samples.world);
            weights_ = every_second(samples.weights);
            steps_ = world_.empty() && weights_.empty() ? 0 : steps;
            return;
        }
    }
}

void NodeMotion::set_origin(const DVec3& origin)
{
    for (auto& [node, worlds] : world_) {
        for (glm::dmat4& world : worlds) {
            world[3] -= glm::dvec4(origin, 0.0);
        }
    }
}

std::span<const glm::dmat4> NodeMotion::world(std::size_t node) const
{
    const auto found = world_.find(node);
    return found == world_.end() ? std::span<const glm::dmat4>() : found->second;
}

std::span<const std::vector<double>> NodeMotion::weights(std::size_t node) const
{
    const auto found = weights_.find(node);
    return found == weights_.end() ? std::span<const std::vector<double>>() : found->second;
}

}  // namespace bdpt::io
