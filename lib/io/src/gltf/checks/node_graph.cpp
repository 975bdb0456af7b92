#include "gltf/checks/node_graph.h"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

namespace bdpt::io {

namespace {

constexpr std::size_t no_parent = static_cast<std::size_t>(-1);

std::vector<std::size_t> find_parents(const JsonPlace& nodes)
{
    std::vector<std::size_t> parents(nodes.size(), no_parent);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const JsonPlace node = nodes.element(i);
        if (!node.has("children")) {
            continue;
        }
        const JsonPlace children = node.member("children");
        for (std::size_t k = 0; k < children.size(); ++k) {
            const JsonPlace place = children.element(k);
            const auto child = static_cast<std::size_t>(place.as_unsigned());
            if (parents[child] != no_parent) {
                place.fail(
                    fmt::format("node {} is a child of node {} already", child, parents[child]));
            }
            parents[child] = i;
        }
    }
    return parents;
}

}  // namespace

void check_node_graph(const JsonPlace& root, const ReadLimits& limits)
{
    if (!root.has("nodes")) {
        return;
    }
    const JsonPlace nodes = root.member("nodes");
    if (nodes.size() > limits.nodes) {
        nodes.fail(fmt::format("{} nodes, but the limit is {}", nodes.size(), limits.nodes));
    }
    const std::vector<std::size_t> parents = find_parents(nodes);

    // With at most one parent each, nodes that cannot be reached from a root are in a cycle or
    // below one.
    std::vector<std::size_t> level;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        if (parents[i] == no_parent) {
            level.push_back(i);
        }
    }
    std::vector<bool> reached(parents.size(), false);
    std::vector<std::size_t> next;
    for (std::size_t depth = 1; !level.empty(); ++depth) {
        if (depth > limits.node_depth) {
            nodes.element(level.front())
                .fail(fmt::format("nested deeper than {} nodes", limits.node_depth));
        }
        next.clear();
        for (const std::size_t i : level) {
            reached[i] = true;
            const JsonPlace node = nodes.element(i);
            if (!node.has("children")) {
                continue;
            }
            for (const Json& child : node.member("children").value()) {
                next.push_back(child.get<std::size_t>());
            }
        }
        level.swap(next);
    }
    for (std::size_t i = 0; i < reached.size(); ++i) {
        if (!reached[i]) {
            nodes.element(i).fail("a cycle: the node is its own ancestor, or below one that is");
        }
    }
}

}  // namespace bdpt::io
