#include "gltf/document/document.h"

#include "gltf/checks/checks.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace bdpt::io {

namespace {

[[noreturn]] void fail(int accessor, const std::string& what)
{
    throw Error(ErrorCode::invalid_input, fmt::format("/accessors/{}{}", accessor, what));
}

template <typename T>
T load(const unsigned char* bytes)
{
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

const unsigned char* view_data(const tinygltf::Model& model, int view)
{
    const tinygltf::BufferView& found = model.bufferViews[static_cast<std::size_t>(view)];
    return model.buffers[static_cast<std::size_t>(found.buffer)].data.data() + found.byteOffset;
}

std::size_t element_size(const tinygltf::Accessor& accessor)
{
    const int components =
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    return static_cast<std::size_t>(components) *
           component_size(static_cast<std::uint64_t>(accessor.componentType));
}

/// Calls visit(index, bytes) for each stored element: first the dense ones, then the sparse ones
/// that replace some of them. Elements that are not stored are zero.
template <typename Visit>
void for_each_element(const tinygltf::Model& model, int accessor_index, const Visit& visit)
{
    const auto& accessor = model.accessors[static_cast<std::size_t>(accessor_index)];
    const std::size_t size = element_size(accessor);
    if (accessor.bufferView >= 0) {
        const std::size_t given =
            model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
        const std::size_t stride = given != 0 ? given : size;
        const unsigned char* bytes = view_data(model, accessor.bufferView) + accessor.byteOffset;
        for (std::size_t i = 0; i < accessor.count; ++i) {
            visit(i, bytes + i * stride);
        }
    }
    if (!accessor.sparse.isSparse) {
        return;
    }
    const auto& sparse = accessor.sparse;
    const std::size_t index_size =
        component_size(static_cast<std::uint64_t>(sparse.indices.componentType));
    const unsigned char* index_bytes = view_data(model, sparse.indices.bufferView) +
                                       static_cast<std::size_t>(sparse.indices.byteOffset);
    const unsigned char* value_bytes = view_data(model, sparse.values.bufferView) +
                                       static_cast<std::size_t>(sparse.values.byteOffset);
    std::size_t next_allowed = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
        const unsigned char* bytes = index_bytes + i * index_size;
        const std::size_t index = index_size == 1   ? load<std::uint8_t>(bytes)
                                  : index_size == 2 ? load<std::uint16_t>(bytes)
                                                    : load<std::uint32_t>(bytes);
        if (index >= accessor.count) {
            fail(accessor_index, fmt::format("/sparse/indices: element {} is {}, but the number of "
                                             "elements is {}",
                                             i, index, accessor.count));
        }
        if (index < next_allowed) {
            fail(
                accessor_index,
                fmt::format("/sparse/indices: element {} is {}, but they must increase", i, index));
        }
        next_allowed = index + 1;
        visit(index, value_bytes + i * size);
    }
}

template <typename T>
float to_float(const unsigned char* bytes, bool normalized)
{
    const T value = load<T>(bytes);
    if constexpr (std::is_floating_point_v<T>) {
        return value;
    } else {
        if (!normalized) {
            return static_cast<float>(value);
        }
        // In double, as 32-bit integers do not fit in a float.
        const double fraction =
            static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max());
        return static_cast<float>(std::max(fraction, -1.0));
    }
}

/// Reads `components` numbers of each element to where element(i) points.
template <typename T, typename Element>
void read_components(const tinygltf::Model& model, int accessor, bool normalized,
                     std::size_t components, const Element& element)
{
    for_each_element(model, accessor, [&](std::size_t i, const unsigned char* bytes) {
        float* const values = element(i);
        for (std::size_t c = 0; c < components; ++c) {
            values[c] = to_float<T>(bytes + c * sizeof(T), normalized);
        }
    });
}

template <typename Element>
void read_floats(const tinygltf::Model& model, int accessor, Integers integers,
                 std::size_t components, const Element& element)
{
    const auto& described = model.accessors[static_cast<std::size_t>(accessor)];
    const bool normalized = integers == Integers::normalized ||
                            (integers == Integers::as_declared && described.normalized);
    const auto read = [&]<typename T>(T) {
        read_components<T>(model, accessor, normalized, components, element);
    };
    switch (described.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return read(std::int8_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read(std::uint8_t{});
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return read(std::int16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read(std::uint16_t{});
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return read(std::uint32_t{});
        default:
            return read(float{});
    }
}

const char* name_of_type(int type)
{
    switch (type) {
        case TINYGLTF_TYPE_SCALAR:
            return "SCALAR";
        case TINYGLTF_TYPE_VEC2:
            return "VEC2";
        case TINYGLTF_TYPE_VEC3:
            return "VEC3";
        case TINYGLTF_TYPE_VEC4:
            return "VEC4";
        default:
            return "MAT4";
    }
}

void check_type(const tinygltf::Model& model, int accessor, int type)
{
    if (model.accessors[static_cast<std::size_t>(accessor)].type != type) {
        fail(accessor, fmt::format("/type: must be {}", name_of_type(type)));
    }
}

}  // namespace

template <typename V>
std::vector<V> read_vectors(const tinygltf::Model& model, int accessor, Integers integers)
{
    // In tinygltf the type of a vector is the number of its components.
    check_type(model, accessor, V::length());
    std::vector<V> values(model.accessors[static_cast<std::size_t>(accessor)].count, V(0.0f));
    read_floats(model, accessor, integers, static_cast<std::size_t>(V::length()),
                [&values](std::size_t i) { return &values[i][0]; });
    return values;
}

template std::vector<Vec2> read_vectors<Vec2>(const tinygltf::Model&, int, Integers);
template std::vector<Vec3> read_vectors<Vec3>(const tinygltf::Model&, int, Integers);
template std::vector<Vec4> read_vectors<Vec4>(const tinygltf::Model&, int, Integers);

std::vector<float> read_numbers(const tinygltf::Model& model, int accessor, int type,
                                Integers integers)
{
    check_type(model, accessor, type);
    const auto components = static_cast<std::size_t>(
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    std::vector<float> values(
        model.accessors[static_cast<std::size_t>(accessor)].count * components, 0.0f);
    read_floats(model, accessor, integers, components,
                [&](std::size_t i) { return values.data() + i * components; });
    return values;
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor)
{
    const auto& described = model.accessors[static_cast<std::size_t>(accessor)];
    check_type(model, accessor, TINYGLTF_TYPE_SCALAR);
    std::vector<std::uint32_t> indices(described.count, 0);
    const auto read = [&](auto type) {
        for_each_element(model, accessor, [&indices](std::size_t i, const unsigned char* bytes) {
            indices[i] = load<decltype(type)>(bytes);
        });
    };
    switch (described.componentType) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            read(std::uint8_t{});
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            read(std::uint16_t{});
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            read(std::uint32_t{});
            break;
        default:
            fail(accessor, fmt::format("/componentType: {}, but indices are 5121, 5123 or 5125",
                                       described.componentType));
    }
    return indices;
}

}  // namespace bdpt::io
