#include "gltf/document/document.h"

#include "file/read_file.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bdpt::io {

namespace {

constexpr int no_index = -1;

struct AccessorType {
    std::string_view name;
    int type = 0;  // of tinygltf
};

constexpr std::array accessor_types{
    AccessorType{"SCALAR", TINYGLTF_TYPE_SCALAR}, AccessorType{"VEC2", TINYGLTF_TYPE_VEC2},
    AccessorType{"VEC3", TINYGLTF_TYPE_VEC3},     AccessorType{"VEC4", TINYGLTF_TYPE_VEC4},
    AccessorType{"MAT2", TINYGLTF_TYPE_MAT2},     AccessorType{"MAT3", TINYGLTF_TYPE_MAT3},
    AccessorType{"MAT4", TINYGLTF_TYPE_MAT4}};

/// Copies checked JSON to structs of tinygltf: all members that the loader reads.
struct Reader {
    /// Copies members of an object, given as names and targets; targets of absent members keep
    /// their defaults.
    template <typename T, typename... Others>
    static void members(const Json& object, std::string_view name, T& target, Others&&... others)
    {
        if (const auto found = object.find(name); found != object.end()) {
            read(*found, target);
        }
        if constexpr (sizeof...(others) > 0) {
            members(object, std::forward<Others>(others)...);
        }
    }

    /// Reads an index or a code; none if it is above the limit of `int`.
    static void read(const Json& json, int& value)
    {
        const auto number = json.get<std::uint64_t>();
        value = number <= std::numeric_limits<int>::max() ? static_cast<int>(number) : no_index;
    }
    static void read(const Json& json, std::size_t& value) { json.get_to(value); }
    static void read(const Json& json, double& value) { json.get_to(value); }
    static void read(const Json& json, bool& value) { json.get_to(value); }
    /// Reads a text. Not all are checked; others than strings are ignored.
    static void read(const Json& json, std::string& value)
    {
        if (json.is_string()) {
            json.get_to(value);
        }
    }
    static void read(const Json& json, std::map<std::string, int>& values)
    {
        for (const auto& item : json.items()) {
            read(item.value(), values[item.key()]);
        }
    }
    template <typename T>
    static void read(const Json& json, std::vector<T>& values)
    {
        values = std::vector<T>(json.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            read(json[i], values[i]);
        }
    }

    // Free-form values: extensions and extras. Numbers that are no `int` are floating-point.

    static void read(const Json& json, tinygltf::Value& value)
    {
        if (json.is_object()) {
            tinygltf::ExtensionMap members;
            read(json, members);
            value = tinygltf::Value(std::move(members));
        } else if (json.is_array()) {
            std::vector<tinygltf::Value> elements;
            read(json, elements);
            value = tinygltf::Value(std::move(elements));
        } else if (json.is_string()) {
            value = tinygltf::Value(json.get<std::string>());
        } else if (json.is_boolean()) {
            value = tinygltf::Value(json.get<bool>());
        } else if (json.is_number()) {
            const auto number = json.get<double>();
            const bool fits = json.is_number_integer() &&
                              number >= std::numeric_limits<int>::min() &&
                              number <= std::numeric_limits<int>::max();
            value = fits ? tinygltf::Value(static_cast<int>(number)) : tinygltf::Value(number);
        }
    }
    static void read(const Json& json, tinygltf::ExtensionMap& members)
    {
        for (const auto& item : json.items()) {
            if (!item.value().is_null()) {
                read(item.value(), members[item.key()]);
            }
        }
    }

    // Geometry

    static void read(const Json& json, tinygltf::BufferView& view)
    {
        members(json, "buffer", view.buffer, "byteOffset", view.byteOffset, "byteLength",
                view.byteLength, "byteStride", view.byteStride);
    }
    static void read(const Json& json, tinygltf::Accessor& accessor)
    {
        members(json, "bufferView", accessor.bufferView, "byteOffset", accessor.byteOffset,
                "componentType", accessor.componentType, "count", accessor.count, "normalized",
                accessor.normalized);
        const auto* const type =
            std::find_if(accessor_types.begin(), accessor_types.end(),
                         [&](const AccessorType& known) { return json["type"] == known.name; });
        accessor.type = type->type;
        accessor.sparse = {};
        const auto sparse = json.find("sparse");
        accessor.sparse.isSparse = sparse != json.end();
        if (accessor.sparse.isSparse) {
            auto& indices = accessor.sparse.indices;
            auto& values = accessor.sparse.values;
            members(*sparse, "count", accessor.sparse.count);
            members((*sparse)["indices"], "bufferView", indices.bufferView, "byteOffset",
                    indices.byteOffset, "componentType", indices.componentType);
            members((*sparse)["values"], "bufferView", values.bufferView, "byteOffset",
                    values.byteOffset);
        }
    }
    static void read(const Json& json, tinygltf::Primitive& primitive)
    {
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        members(json, "attributes", primitive.attributes, "indices", primitive.indices, "material",
                primitive.material, "mode", primitive.mode, "targets", primitive.targets,
                "extensions", primitive.extensions);
    }
    static void read(const Json& json, tinygltf::Mesh& mesh)
    {
        members(json, "name", mesh.name, "primitives", mesh.primitives, "weights", mesh.weights);
    }
    static void read(const Json& json, tinygltf::Skin& skin)
    {
        members(json, "inverseBindMatrices", skin.inverseBindMatrices, "joints", skin.joints);
    }

    // Nodes and their animations

    static void read(const Json& json, tinygltf::Node& node)
    {
        members(json, "name", node.name, "children", node.children, "mesh", node.mesh, "skin",
                node.skin, "camera", node.camera, "matrix", node.matrix, "translation",
                node.translation, "rotation", node.rotation, "scale", node.scale, "weights",
                node.weights, "extensions", node.extensions);
    }
    static void read(const Json& json, tinygltf::Scene& scene)
    {
        members(json, "nodes", scene.nodes, "extensions", scene.extensions);
    }
    static void read(const Json& json, tinygltf::AnimationChannel& channel)
    {
        members(json, "sampler", channel.sampler);
        if (const auto target = json.find("target"); target != json.end()) {
            members(*target, "node", channel.target_node, "path", channel.target_path);
        }
    }
    static void read(const Json& json, tinygltf::AnimationSampler& sampler)
    {
        members(json, "input", sampler.input, "output", sampler.output, "interpolation",
                sampler.interpolation);
    }
    static void read(const Json& json, tinygltf::Animation& animation)
    {
        members(json, "channels", animation.channels, "samplers", animation.samplers);
    }

    // Materials

    static void read(const Json& json, tinygltf::Image& image)
    {
        members(json, "uri", image.uri, "bufferView", image.bufferView);
    }
    static void read(const Json& json, tinygltf::Sampler& sampler)
    {
        members(json, "wrapS", sampler.wrapS, "wrapT", sampler.wrapT);
    }
    static void read(const Json& json, tinygltf::Texture& texture)
    {
        members(json, "source", texture.source, "sampler", texture.sampler, "extensions",
                texture.extensions);
    }
    static void read(const Json& json, tinygltf::TextureInfo& info)
    {
        members(json, "index", info.index, "texCoord", info.texCoord, "extensions",
                info.extensions);
    }
    static void read(const Json& json, tinygltf::NormalTextureInfo& info)
    {
        members(json, "index", info.index, "texCoord", info.texCoord, "scale", info.scale,
                "extensions", info.extensions);
    }
    static void read(const Json& json, tinygltf::PbrMetallicRoughness& pbr)
    {
        members(json, "baseColorFactor", pbr.baseColorFactor, "baseColorTexture",
                pbr.baseColorTexture, "metallicFactor", pbr.metallicFactor, "roughnessFactor",
                pbr.roughnessFactor, "metallicRoughnessTexture", pbr.metallicRoughnessTexture);
    }
    static void read(const Json& json, tinygltf::Material& material)
    {
        material.emissiveFactor = {0.0, 0.0, 0.0};
        members(json, "name", material.name, "doubleSided", material.doubleSided, "alphaMode",
                material.alphaMode, "alphaCutoff", material.alphaCutoff, "emissiveFactor",
                material.emissiveFactor, "emissiveTexture", material.emissiveTexture,
                "normalTexture", material.normalTexture, "pbrMetallicRoughness",
                material.pbrMetallicRoughness, "extensions", material.extensions);
    }

    // Cameras and lights

    static void read(const Json& json, tinygltf::PerspectiveCamera& camera)
    {
        members(json, "yfov", camera.yfov, "aspectRatio", camera.aspectRatio);
    }
    static void read(const Json& json, tinygltf::OrthographicCamera& camera)
    {
        members(json, "xmag", camera.xmag, "ymag", camera.ymag);
    }
    static void read(const Json& json, tinygltf::Camera& camera)
    {
        members(json, "name", camera.name, "type", camera.type, "perspective", camera.perspective,
                "orthographic", camera.orthographic, "extras", camera.extras);
    }
    static void read(const Json& json, tinygltf::SpotLight& spot)
    {
        members(json, "innerConeAngle", spot.innerConeAngle, "outerConeAngle", spot.outerConeAngle);
    }
    static void read(const Json& json, tinygltf::Light& light)
    {
        members(json, "name", light.name, "type", light.type, "color", light.color, "intensity",
                light.intensity, "range", light.range, "spot", light.spot, "extras", light.extras);
    }
};

}  // namespace

Bytes read_source(const tinygltf::Model& model, const std::string& uri, int buffer_view,
                  std::uint64_t limit, const LoadContext& context)
{
    if (uri.empty() && buffer_view >= 0) {
        const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(buffer_view)];
        if (view.byteLength > limit) {
            throw Error(
                ErrorCode::invalid_input,
                fmt::format("a view of {} bytes, but the limit is {}", view.byteLength, limit));
        }
        const Bytes& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
        const ByteView bytes = ByteView(data).subspan(view.byteOffset, view.byteLength);
        return {bytes.begin(), bytes.end()};
    }
    if (uri.empty()) {
        throw Error(ErrorCode::invalid_input, "neither \"uri\" nor \"bufferView\"");
    }
    if (is_data_uri(uri)) {
        return decode_data_uri(uri, limit);
    }
    const std::filesystem::path file = resolve_uri(context.folders, uri);
    try {
        return read_file(file, limit);
    } catch (const Error& error) {
        throw Error(error.code(), quote(uri) + ": " + error.what());
    }
}

const tinygltf::Value& find_light(const tinygltf::Model& model, const char* extension,
                                  std::size_t index)
{
    // tinygltf's own index is signed in some versions.
    return model.extensions.at(extension).Get("lights").Get<tinygltf::Value::Array>().at(index);
}

tinygltf::Model build_model(CheckedGltf checked, std::span<const std::size_t> played)
{
    const Json& document = checked.document;
    tinygltf::Model model;
    Reader::members(document, "accessors", model.accessors, "bufferViews", model.bufferViews,
                    "meshes", model.meshes, "skins", model.skins, "nodes", model.nodes, "scenes",
                    model.scenes, "images", model.images, "samplers", model.samplers, "textures",
                    model.textures, "materials", model.materials, "cameras", model.cameras,
                    "extensions", model.extensions);
    if (model.extensions.contains("KHR_lights_punctual")) {
        Reader::members(document["extensions"]["KHR_lights_punctual"], "lights", model.lights);
    }
    if (document.contains("animations")) {
        const Json& animations = document["animations"];
        model.animations.resize(animations.size());
        for (const std::size_t index : played) {
            Reader::read(animations[index], model.animations[index]);
        }
    }
    model.buffers.resize(checked.buffers.size());
    for (std::size_t i = 0; i < model.buffers.size(); ++i) {
        model.buffers[i].data = std::move(checked.buffers[i]);
        model.buffers[i].data.resize(document["buffers"][i]["byteLength"].get<std::size_t>());
    }
    return model;
}

}  // namespace bdpt::io
