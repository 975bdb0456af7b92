#include "gltf/compression/compression.h"

#include "gltf/checks/checks.h"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace bdpt::io {

namespace {

constexpr const char* draco_extension = "KHR_draco_mesh_compression";
constexpr std::uint64_t triangle_list = 4;
constexpr std::uint64_t triangle_strip = 5;
constexpr std::uint64_t component_unsigned_int = 5125;

/// Puts decoded primitives into a document.
class DracoReplacer {
public:
    DracoReplacer(Json& document, std::vector<Bytes>& buffers, LoadContext& context)
        : document_(document), buffers_(buffers), size_(context)
    {}

    /// Replaces the compressed data of primitive `primitive` of mesh `mesh`.
    void replace(std::size_t mesh, std::size_t primitive)
    {
        Json plain = get(mesh, primitive);
        Json& target = document_["meshes"][mesh]["primitives"][primitive];
        target["indices"] = plain["indices"];
        target["mode"] = triangle_list;
        target["attributes"].update(plain["attributes"]);
        target["extensions"].erase(draco_extension);
    }

private:
    /// One attribute that is in the Draco data.
    struct Wanted {
        std::string semantic;
        Json accessor;
        DracoAttribute attribute;
    };

    [[nodiscard]] Json get(std::size_t mesh, std::size_t primitive)
    {
        const JsonPlace root(document_);
        const JsonPlace meshes = root.member("meshes");
        const JsonPlace mesh_place = meshes.element(mesh);
        const JsonPlace primitives = mesh_place.member("primitives");
        const JsonPlace source = primitives.element(primitive);
        const JsonPlace extensions = source.member("extensions");
        const JsonPlace packed = extensions.member(draco_extension);
        const std::vector<Wanted> wanted = find_wanted(source, packed);
        // Primitives may share data, but the decoded attributes depend on their accessors.
        std::string key = std::to_string(packed.member("bufferView").as_unsigned());
        for (const Wanted& one : wanted) {
            key += fmt::format(" {} {} {}", one.semantic, one.attribute.id, one.accessor.dump());
        }
        const auto [found, is_new] = known_.try_emplace(key);
        if (is_new) {
            found->second = decode(packed, wanted);
        }
        return found->second;
    }

    [[nodiscard]] std::vector<Wanted> find_wanted(const JsonPlace& source,
                                                  const JsonPlace& packed) const
    {
        std::vector<Wanted> wanted;
        const JsonPlace ids = packed.member("attributes");
        const JsonPlace attributes = source.member("attributes");
        for (const auto& item : ids.value().items()) {
            if (!attributes.has(item.key())) {
                continue;  // The attribute is not used.
            }
            const JsonPlace place = ids.member(item.key());
            const std::uint64_t id = place.as_unsigned();
            if (id > UINT32_MAX) {
                place.fail(fmt::format("{} is not an attribute id", id));
            }
            Json accessor =
                document_["accessors"][attributes.member(item.key()).value().get<std::size_t>()];
            const DracoAttribute attribute{
                static_cast<std::uint32_t>(id), accessor["componentType"].get<std::uint64_t>(),
                static_cast<std::size_t>(
                    component_count(accessor["type"].get_ref<const std::string&>()))};
            wanted.push_back({item.key(), std::move(accessor), attribute});
        }
        return wanted;
    }

    /// Returns an object with "attributes" and "indices", as in a primitive.
    [[nodiscard]] Json decode(const JsonPlace& packed, const std::vector<Wanted>& wanted)
    {
        const Json& view =
            document_["bufferViews"][packed.member("bufferView").value().get<std::size_t>()];
        const ByteView buffer = buffers_[view["buffer"].get<std::size_t>()];
        const ByteView data =
            buffer.subspan(view.value("byteOffset", std::size_t{0}),
                           view["byteLength"].get<std::size_t>());  // checked by check_layout
        std::vector<DracoAttribute> attributes;
        std::uint64_t point_bytes = 3 * sizeof(std::uint32_t);
        for (const Wanted& one : wanted) {
            attributes.push_back(one.attribute);
            point_bytes += one.attribute.components * component_size(one.attribute.component_type);
        }
        DracoMesh mesh;
        try {
            const DracoSize size = draco_size(data);
            size_.add(packed, size.faces, 3 * sizeof(std::uint32_t), data.size());
            const std::uint64_t left = size_.left();
            size_.add(packed, size.vertices, point_bytes, data.size());
            mesh = decode_draco_mesh(data, attributes, left);
            if (mesh.points > size.vertices) {
                size_.add(packed, mesh.points - size.vertices, point_bytes, data.size());
            }
        } catch (const Error& error) {
            const std::string what = error.what();
            // Errors about limits already name their place.
            if (what.starts_with("/")) {
                throw;
            }
            packed.fail(what, error.code());
        }
        if (mesh.points == 0 || mesh.indices.empty()) {
            packed.fail("the Draco data holds no triangles");
        }
        Json plain{{"attributes", Json::object()}};
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            plain["attributes"][wanted[i].semantic] =
                add_accessor(std::move(mesh.attributes[i]), wanted[i].accessor, mesh.points);
        }
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(mesh.indices.data());
        plain["indices"] = add_accessor(
            Bytes(bytes, bytes + mesh.indices.size() * sizeof(std::uint32_t)),
            {{"componentType", component_unsigned_int}, {"type", "SCALAR"}}, mesh.indices.size());
        return plain;
    }

    /// Adds an accessor like `model` and returns its index.
    [[nodiscard]] std::size_t add_accessor(Bytes bytes, const Json& model, std::size_t count)
    {
        Json& views = document_["bufferViews"];
        Json& accessors = document_["accessors"];
        document_["buffers"].push_back({{"byteLength", bytes.size()}});
        views.push_back({{"buffer", buffers_.size()}, {"byteLength", bytes.size()}});
        buffers_.push_back(std::move(bytes));
        accessors.push_back({{"bufferView", views.size() - 1},
                             {"componentType", model["componentType"]},
                             {"count", count},
                             {"type", model["type"]},
                             {"normalized", model.value("normalized", false)}});
        return accessors.size() - 1;
    }

    Json& document_;
    std::vector<Bytes>& buffers_;
    DecodedSize size_;
    std::map<std::string, Json> known_;
};

/// Checks, in builds without Draco, that the primitive also has uncompressed data.
void check_plain(const JsonPlace& root, const JsonPlace& primitive)
{
    const JsonPlace attributes = primitive.member("attributes");
    if (!attributes.has("POSITION")) {
        return;
    }
    const JsonPlace accessors = root.member("accessors");
    const JsonPlace accessor =
        accessors.element(static_cast<std::size_t>(attributes.member("POSITION").as_unsigned()));
    if (!accessor.has("bufferView") && !accessor.has("sparse")) {
        primitive.fail("there is no uncompressed data, and this build of bdpt has no Draco",
                       ErrorCode::unsupported);
    }
}

}  // namespace

void decode_draco_primitives(Json& document, std::vector<Bytes>& buffers, LoadContext& context)
{
    DracoReplacer replacer(document, buffers, context);
    const std::size_t mesh_count = document.contains("meshes") ? document["meshes"].size() : 0;
    for (std::size_t m = 0; m < mesh_count; ++m) {
        for (std::size_t p = 0; p < document["meshes"][m]["primitives"].size(); ++p) {
            const JsonPlace root(document);
            const JsonPlace meshes = root.member("meshes");
            const JsonPlace mesh = meshes.element(m);
            const JsonPlace primitives = mesh.member("primitives");
            const JsonPlace primitive = primitives.element(p);
            if (!primitive.has("extensions") ||
                !primitive.value()["extensions"].contains(draco_extension)) {
                continue;
            }
            const std::uint64_t mode = primitive.unsigned_or("mode", triangle_list);
            if (mode != triangle_list && mode != triangle_strip) {
                primitive.member("mode").fail(
                    fmt::format("{}, but Draco holds triangles (4 or 5)", mode));
            }
            if (!has_draco()) {
                check_plain(root, primitive);
                continue;
            }
            replacer.replace(m, p);
        }
    }
}

}  // namespace bdpt::io
