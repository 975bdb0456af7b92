#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "file/read_file.h"
#include "gltf/checks/checks.h"

namespace bdpt::io {

namespace {

constexpr std::uint64_t unsigned_byte = 5121;
constexpr std::uint64_t unsigned_short = 5123;
constexpr std::uint64_t unsigned_int = 5125;
// More bytes than any machine has; sums and products of numbers below it fit in 64 bits after the
// checks in product().
constexpr std::uint64_t max_bytes = std::uint64_t{1} << 56;

/// Returns count * size; fails if that is more than any machine has.
std::uint64_t product(const JsonPlace& place, std::uint64_t count, std::uint64_t size)
{
    if (size != 0 && count > max_bytes / size) {
        place.fail(fmt::format(
            "{} elements need {}", count,
            human_bytes(static_cast<long double>(count) * static_cast<long double>(size))));
    }
    return count * size;
}

/// A run of elements within a view.
struct Span {
    std::uint64_t offset = 0;
    std::uint64_t stride = 0;
    std::uint64_t count = 0;
    std::uint64_t element_size = 0;
};

/// Checks that a run lies within a view. `place` is the subject of the message, `view` the index of
/// the bufferView.
void check_span(const JsonPlace& place, const JsonPlace& views, std::uint64_t view,
                const Span& span)
{
    const JsonPlace viewed = views.element(static_cast<std::size_t>(view));
    const std::uint64_t length = viewed.member("byteLength").as_unsigned();
    const std::uint64_t size = product(place, span.count - 1, span.stride) + span.element_size;
    if (span.offset > length || size > length - span.offset) {
        place.fail(fmt::format("{} elements need {} at byte {}, but bufferView {} has {} bytes",
                               span.count, human_bytes(static_cast<long double>(size)), span.offset,
                               view, length));
    }
}

void check_views(const JsonPlace& views, const JsonPlace& buffers, LoadContext& context)
{
    for (std::size_t i = 0; i < views.size(); ++i) {
        const JsonPlace view = views.element(i);
        const std::uint64_t buffer = view.member("buffer").as_unsigned();
        const JsonPlace viewed = buffers.element(static_cast<std::size_t>(buffer));
        const std::uint64_t available = viewed.member("byteLength").as_unsigned();
        const std::uint64_t offset = view.unsigned_or("byteOffset", 0);
        const std::uint64_t length = view.member("byteLength").as_unsigned();
        if (offset > available || length > available - offset) {
            view.fail(fmt::format("{} bytes at byte {}, but buffer {} has {} bytes", length, offset,
                                  buffer, available));
        }
        const std::uint64_t stride = view.unsigned_or("byteStride", 0);
        if (stride > 252 || stride % 4 != 0) {
            view.member("byteStride")
                .fail(fmt::format("{}, but must be a multiple of 4 up to 252", stride));
        }
        if (view.has("byteStride") && stride == 0) {
            context.warn("a stride of 0 is treated as none", view.member("byteStride").pointer());
        }
    }
}

void check_sparse(const JsonPlace& accessor, const JsonPlace& views, std::uint64_t element_size)
{
    const JsonPlace sparse = accessor.member("sparse");
    const std::uint64_t count = sparse.member("count").as_unsigned();
    const std::uint64_t of = accessor.member("count").as_unsigned();
    if (count == 0 || count > of) {
        sparse.member("count").fail(fmt::format("{}, but the accessor has {} elements", count, of));
    }
    // tinygltf holds these as `int`.
    constexpr std::uint64_t most = (std::uint64_t{1} << 31) - 1;
    const JsonPlace indices = sparse.member("indices");
    const std::uint64_t type = indices.member("componentType").as_unsigned();
    if (type != unsigned_byte && type != unsigned_short && type != unsigned_int) {
        indices.member("componentType").fail(fmt::format("{} is not a type for indices", type));
    }
    const std::uint64_t index_size = component_size(type);
    check_span(indices, views, indices.member("bufferView").as_unsigned(),
               {indices.unsigned_or("byteOffset", 0), index_size, count, index_size});
    const JsonPlace values = sparse.member("values");
    if (count > most || indices.unsigned_or("byteOffset", 0) > most ||
        values.unsigned_or("byteOffset", 0) > most) {
        sparse.fail(fmt::format("a count or offset above {}", most));
    }
    check_span(values, views, values.member("bufferView").as_unsigned(),
               {values.unsigned_or("byteOffset", 0), element_size, count, element_size});
}

void check_accessor(const JsonPlace& accessor, const JsonPlace& views, LoadContext& context)
{
    const std::uint64_t component_type = accessor.member("componentType").as_unsigned();
    const std::uint64_t component = component_size(component_type);
    if (component == 0) {
        accessor.member("componentType")
            .fail(fmt::format("{} is not a component type", component_type));
    }
    const JsonPlace type = accessor.member("type");
    const std::uint64_t components = component_count(type.value().get_ref<const std::string&>());
    if (components == 0) {
        type.fail(brief(type.value()) + " is not an accessor type");
    }
    const std::uint64_t element_size = component * components;
    const JsonPlace count_place = accessor.member("count");
    const std::uint64_t count = count_place.as_unsigned();
    if (count == 0) {
        count_place.fail("0, but must be at least 1");
    }
    const std::uint64_t bytes = product(count_place, count, element_size);
    if (bytes > context.limits.buffer_bytes) {
        count_place.fail(
            fmt::format("{} elements need {}, but the limit is {}", count,
                        human_bytes(static_cast<long double>(bytes)),
                        human_bytes(static_cast<long double>(context.limits.buffer_bytes))));
    }
    if (accessor.has("bufferView")) {
        const std::uint64_t view = accessor.member("bufferView").as_unsigned();
        const std::uint64_t given =
            views.element(static_cast<std::size_t>(view)).unsigned_or("byteStride", 0);
        if (given != 0 && given < element_size) {
            accessor.fail(fmt::format("elements of {} bytes overlap: bufferView {} has stride {}",
                                      element_size, view, given));
        }
        const std::uint64_t offset = accessor.unsigned_or("byteOffset", 0);
        check_span(accessor, views, view,
                   {offset, given != 0 ? given : element_size, count, element_size});
        if (offset % component != 0) {
            context.warn("accessor is not aligned", accessor.pointer());
        }
    }
    if (accessor.has("sparse")) {
        check_sparse(accessor, views, element_size);
    }
}

}  // namespace

std::uint64_t component_count(std::string_view type)
{
    struct Type {
        std::string_view name;
        std::uint64_t components;
    };
    constexpr Type types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                              {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    for (const Type& known : types) {
        if (known.name == type) {
            return known.components;
        }
    }
    return 0;
}

std::uint64_t component_size(std::uint64_t component_type)
{
    switch (component_type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return 0;
    }
}

void check_layout(const JsonPlace& root, LoadContext& context)
{
    const Json none = Json::array();
    const JsonPlace nothing(none);
    const auto section = [&](std::string_view name) {
        return root.has(name) ? root.member(name) : nothing;
    };
    const JsonPlace buffers = section("buffers");
    const JsonPlace views = section("bufferViews");
    const JsonPlace accessors = section("accessors");

    std::uint64_t total = 0;
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const JsonPlace buffer = buffers.element(i);
        const JsonPlace length = buffer.member("byteLength");
        const std::uint64_t bytes = length.as_unsigned();
        if (bytes > context.limits.buffer_bytes || total + bytes > context.limits.buffer_bytes) {
            length.fail(fmt::format("{} bytes, but the limit for all buffers is {}", bytes,
                                    context.limits.buffer_bytes));
        }
        total += bytes;
    }
    check_views(views, buffers, context);
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        check_accessor(accessors.element(i), views, context);
    }
}

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
