#pragma once

#include "file/load_context.h"
#include "gltf/document/accessor.h"
#include "gltf/geometry/mesh.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

/// Reads attributes of one primitive and reports its errors.
class PrimitiveReader {
public:
    /// The model must outlive the reader.
    PrimitiveReader(const tinygltf::Model& model, PrimitiveId id);

    [[nodiscard]] const tinygltf::Primitive& source() const { return *source_; }
    [[nodiscard]] const tinygltf::Model& model() const { return *model_; }
    [[nodiscard]] PrimitiveId id() const { return id_; }

    /// Throws `Error` (invalid_input) that names the member `where` of the primitive, and the mesh.
    [[noreturn]] void fail(std::string_view where, const std::string& what) const;

    /// Returns the attribute's accessor, if any.
    [[nodiscard]] std::optional<int> attribute(const std::string& semantic) const
    {
        return find(source_->attributes, semantic);
    }

    /// Returns one value per vertex; empty if there is no such attribute.
    template <typename V>
    [[nodiscard]] std::vector<V> read(const std::string& semantic, std::size_t vertices,
                                      LoadContext& context,
                                      Integers integers = Integers::as_declared) const
    {
        return read_from<V>(source_->attributes, "attributes", semantic, vertices, context,
                            integers);
    }

    /// Reads an attribute likewise from the morph target `target`, which must exist.
    template <typename V>
    [[nodiscard]] std::vector<V> read_target(std::size_t target, const std::string& semantic,
                                             std::size_t vertices, LoadContext& context) const
    {
        return read_from<V>(source_->targets[target], fmt::format("targets/{}", target), semantic,
                            vertices, context, Integers::as_declared);
    }

private:
    using Attributes = std::map<std::string, int>;

    [[nodiscard]] static std::optional<int> find(const Attributes& attributes,
                                                 const std::string& semantic);

    template <typename V>
    [[nodiscard]] std::vector<V> read_from(const Attributes& attributes, const std::string& where,
                                           const std::string& semantic, std::size_t vertices,
                                           LoadContext& context, Integers integers) const
    {
        const std::optional<int> accessor = find(attributes, semantic);
        if (!accessor) {
            return {};
        }
        std::vector<V> values = read_vectors<V>(*model_, *accessor, integers);
        if (values.size() < vertices) {
            fail(where + "/" + semantic, fmt::format("{} values, but the number of vertices is {}",
                                                     values.size(), vertices));
        }
        if (values.size() > vertices) {
            context.warn("more values than vertices; the rest is ignored",
                         fmt::format("{}/{}/{}", id_.pointer(), where, semantic));
            values.resize(vertices);
        }
        return values;
    }

    const tinygltf::Model* model_;
    const tinygltf::Primitive* source_;
    PrimitiveId id_;
    std::string name_;  // name of the mesh
};

}  // namespace bdpt::io
