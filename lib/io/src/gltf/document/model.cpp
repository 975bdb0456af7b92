#include "gltf/document/model.h"

#include "file/read_file.h"
#include "file/uri.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::io {

namespace {

/// Converts integers beyond `int` to floating point, as tinygltf holds integers within extensions
/// as `int`.
void widen_integers(Json& value)
{
    if (value.is_structured()) {
        for (Json& element : value) {
            widen_integers(element);
        }
    } else if (value.is_number_unsigned() &&
               value.get<std::uint64_t>() > std::numeric_limits<int>::max()) {
        value = value.get<double>();
    } else if (value.is_number_integer() && !value.is_number_unsigned() &&
               value.get<std::int64_t>() < std::numeric_limits<int>::min()) {
        value = value.get<double>();
    }
}

/// Calls `visit` with each element of a top-level array.
template <typename Visit>
void for_each(Json& document, const char* section, const Visit& visit)
{
    const auto found = document.find(section);
    if (found == document.end()) {
        return;
    }
    for (Json& element : *found) {
        visit(element);
    }
}

/// Removes the images from the document, as tinygltf would decode the data in their URIs, and
/// returns them.
std::vector<tinygltf::Image> take_images(Json& document)
{
    std::vector<tinygltf::Image> images;
    for_each(document, "images", [&images](Json& image) {
        tinygltf::Image& taken = images.emplace_back();
        if (image.contains("uri")) {
            taken.uri = std::move(image["uri"].get_ref<std::string&>());
        } else if (image.contains("bufferView")) {
            taken.bufferView = image["bufferView"].get<int>();
        }
    });
    document.erase("images");
    return images;
}

/// Calls `visit` with each light of an extension of the document.
template <typename Visit>
void for_each_light(Json& document, const char* extension, const Visit& visit)
{
    const auto extensions = document.find("extensions");
    if (extensions != document.end() && extensions->contains(extension)) {
        for_each((*extensions)[extension], "lights", visit);
    }
}

// tinygltf drops empty values within extensions, so that later elements of an array move. So each
// light keeps a member, and members that are not read are dropped.

Json reduced_profile(Json& light)
{
    if (light.contains("bufferView") && !light.contains("uri")) {
        return {{"bufferView", light["bufferView"]}};
    }
    return {{"uri", light.contains("uri") ? std::move(light["uri"]) : Json("")}};
}

/// Reduces an environment to the first level of its cube, if that has any side.
Json reduced_environment(Json& light)
{
    Json reduced{{"intensity", light.value("intensity", 1.0)}};
    Json& levels = light["specularImages"];
    if (!levels.empty() && !levels[0].empty()) {
        reduced["specularImages"] = Json::array({std::move(levels[0])});
    }
    if (light.contains("rotation")) {
        reduced["rotation"] = std::move(light["rotation"]);
        widen_integers(reduced["rotation"]);
    }
    return reduced;
}

// tinygltf drops incomplete channels, and refuses the document for incomplete samplers. The loader
// reads neither, so missing members become -1.

Json reduced_channel(const Json& channel)
{
    Json reduced{{"sampler", -1}, {"target", {{"node", -1}, {"path", ""}}}};
    const Json& target = channel["target"];
    if (target.contains("node") && target["path"].is_string()) {
        reduced["target"] = {{"node", target["node"]}, {"path", target["path"]}};
    }
    const auto sampler = channel.find("sampler");
    if (sampler != channel.end() &&
        sampler->get<std::uint64_t>() <= std::numeric_limits<int>::max()) {
        reduced["sampler"] = *sampler;
    }
    return reduced;
}

Json reduced_sampler(const Json& sampler)
{
    Json reduced{{"input", sampler.value("input", -1)}, {"output", sampler.value("output", -1)}};
    if (sampler.contains("interpolation") && sampler["interpolation"].is_string()) {
        reduced["interpolation"] = sampler["interpolation"];
    }
    return reduced;
}

/// Drops extensions, which tinygltf would copy into each sampler.
Json reduced_animation(Json& animation)
{
    Json reduced = Json::object();
    for_each(animation, "channels",
             [&](const Json& channel) { reduced["channels"].push_back(reduced_channel(channel)); });
    for_each(animation, "samplers",
             [&](const Json& sampler) { reduced["samplers"].push_back(reduced_sampler(sampler)); });
    return reduced;
}

void simplify_animations(Json& document, std::span<const std::size_t> played)
{
    std::size_t index = 0;
    for_each(document, "animations", [&](Json& animation) {
        const bool plays = std::find(played.begin(), played.end(), index++) != played.end();
        animation = plays ? reduced_animation(animation) : Json::object();
    });
}

/// Prepares the document for tinygltf: buffers are named by their index and come from memory;
/// members that the loader does not read are removed; members that tinygltf requires, but the
/// loader does not, are added.
void simplify(Json& document)
{
    std::size_t index = 0;
    for_each(document, "buffers",
             [&index](Json& buffer) { buffer["uri"] = std::to_string(index++); });
    for_each(document, "meshes", [](Json& mesh) {
        for (Json& primitive : mesh["primitives"]) {
            Json& attributes = primitive["attributes"];
            attributes.erase(indices_attribute);
            if (primitive.contains("indices")) {
                attributes[indices_attribute] = primitive["indices"];
                primitive.erase("indices");
            }
        }
    });
    for_each(document, "cameras", [](Json& camera) {
        if (camera.contains("perspective")) {
            camera["perspective"].emplace("znear", 0.1);
        }
        if (camera.contains("orthographic")) {
            for (const char* name : {"xmag", "ymag", "znear", "zfar"}) {
                camera["orthographic"].emplace(name, 1.0);
            }
        }
    });
    for_each(document, "nodes", [](Json& node) {
        if (node.contains("extensions") && node["extensions"].contains("EXT_lights_ies")) {
            widen_integers(node["extensions"]["EXT_lights_ies"]);
        }
    });
    for_each(document, "materials", [](Json& material) {
        if (material.contains("extensions")) {
            widen_integers(material["extensions"]);
        }
    });
    for_each_light(document, "EXT_lights_ies", [](Json& light) { light = reduced_profile(light); });
    for_each_light(document, "EXT_lights_image_based",
                   [](Json& light) { light = reduced_environment(light); });
}

/// Passes the buffers that have been read to tinygltf. Each is taken once.
tinygltf::FsCallbacks memory_files(std::vector<Bytes>& buffers)
{
    tinygltf::FsCallbacks callbacks{};
    callbacks.FileExists = [](const std::string&, void*) { return true; };
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = [](Bytes* bytes, std::string*, const std::string& path, void* user) {
        auto& all = *static_cast<std::vector<Bytes>*>(user);
        // The names are those given by simplify().
        *bytes = std::move(all.at(std::stoul(path.substr(path.rfind('/') + 1))));
        return true;
    };
    callbacks.WriteWholeFile = [](std::string*, const std::string&, const Bytes&, void*) {
        return false;
    };
    // Newer versions ask for the size first.
    const auto add_size_callback = [](auto& newer) {
        if constexpr (requires { newer.GetFileSizeInBytes; }) {
            newer.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string& path,
                                          void* user) {
                const auto& all = *static_cast<std::vector<Bytes>*>(user);
                *size = all.at(std::stoul(path.substr(path.rfind('/') + 1))).size();
                return true;
            };
        }
    };
    add_size_callback(callbacks);
    callbacks.user_data = &buffers;
    return callbacks;
}

std::string one_line(std::string text)
{
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

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
    const std::filesystem::path file = resolve_uri(context.folder, uri);
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
    tinygltf::Model model;
    std::vector<tinygltf::Image> images = take_images(checked.document);
    std::size_t index = 0;
    for_each(checked.document, "buffers", [&](const Json& buffer) {
        checked.buffers[index++].resize(buffer["byteLength"].get<std::size_t>());
    });
    simplify(checked.document);
    simplify_animations(checked.document, played);
    const std::string text = checked.document.dump(-1, ' ', false, Json::error_handler_t::replace);
    checked.document = nullptr;
    if (text.size() > std::numeric_limits<unsigned>::max()) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("JSON of {} bytes is too long", text.size()));
    }
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks(memory_files(checked.buffers));
    std::string error;
    std::string warning;
    if (!parser.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                    static_cast<unsigned>(text.size()), "",
                                    tinygltf::REQUIRE_VERSION)) {
        throw Error(ErrorCode::invalid_input, "glTF: " + one_line(error));
    }
    model.images = std::move(images);
    return model;
}

}  // namespace bdpt::io
