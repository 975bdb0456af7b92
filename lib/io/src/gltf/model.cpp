#include "gltf/model.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace bdpt::io {

namespace {

/// tinygltf holds integers within extensions as `int`; greater ones become floating point.
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

std::vector<ImageSource> take_images(Json& document)
{
    std::vector<ImageSource> images;
    for_each(document, "images", [&images](Json& image) {
        ImageSource source;
        if (image.contains("uri")) {
            source.uri = std::move(image["uri"].get_ref<std::string&>());
        } else if (image.contains("bufferView")) {
            source.buffer_view = image["bufferView"].get<std::size_t>();
        }
        images.push_back(std::move(source));
    });
    document.erase("images");
    return images;
}

Json take_motion(Json& document)
{
    Json motion = Json::object();
    for (const char* section : {"skins", "animations"}) {
        const auto found = document.find(section);
        motion[section] = found != document.end() ? std::move(*found) : Json::array();
        document.erase(section);
    }
    return motion;
}

/// What tinygltf sees: buffers are named by their index and come from memory; what the loader does
/// not read is taken away; what tinygltf insists on, but the loader does not need, is put in.
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
    for_each(document, "materials", [](Json& material) {
        if (material.contains("extensions")) {
            widen_integers(material["extensions"]);
        }
    });
}

/// Gives tinygltf the buffers that have been read. Each is taken once.
tinygltf::FsCallbacks memory_files(std::vector<Bytes>& buffers)
{
    tinygltf::FsCallbacks callbacks{};
    callbacks.FileExists = [](const std::string&, void*) { return true; };
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = [](Bytes* bytes, std::string*, const std::string& path, void* user) {
        auto& all = *static_cast<std::vector<Bytes>*>(user);
        // The names are those that simplify() gave.
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

GltfModel build_model(CheckedGltf checked)
{
    GltfModel model;
    model.folder = std::move(checked.folder);
    model.images = take_images(checked.document);
    model.motion = take_motion(checked.document);
    std::size_t index = 0;
    for_each(checked.document, "buffers", [&](const Json& buffer) {
        checked.buffers[index++].resize(buffer["byteLength"].get<std::size_t>());
    });
    simplify(checked.document);
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
    if (!parser.LoadASCIIFromString(&model.structs, &error, &warning, text.data(),
                                    static_cast<unsigned>(text.size()), "",
                                    tinygltf::REQUIRE_VERSION)) {
        throw Error(ErrorCode::invalid_input, "glTF: " + one_line(error));
    }
    return model;
}

}  // namespace bdpt::io
