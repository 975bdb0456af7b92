#include "gltf/document/facts.h"

#include "file/named_errors.h"
#include "file/read_file.h"
#include "gltf/checks/glb.h"
#include "gltf/document/extensions.h"
#include "gltf/document/selection.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace bdpt::io {

namespace {

std::string text_or_empty(const Json& object, const char* key)
{
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::size_t section_size(const Json& document, const char* section)
{
    const auto found = document.find(section);
    return found != document.end() && found->is_array() ? found->size() : 0;
}

/// Returns the packet that the asset refers to; empty if anything about it is invalid.
std::string find_xmp(const Json& document)
{
    constexpr std::size_t longest = std::size_t{1} << 20;
    for (const std::string extension : {"KHR_xmp_json_ld", "KHR_xmp"}) {
        const Json::json_pointer reference("/asset/extensions/" + extension + "/packet");
        const Json::json_pointer place("/extensions/" + extension + "/packets");
        const Json& packets = array_at(document, place);
        if (!document.contains(reference) || !packets.is_array()) {
            continue;
        }
        const Json& index = document.at(reference);
        if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= packets.size()) {
            continue;
        }
        std::string text =
            packets[index.get<std::size_t>()].dump(-1, ' ', false, Json::error_handler_t::replace);
        if (text.size() <= longest) {
            return text;
        }
    }
    return {};
}

}  // namespace

GltfFacts collect_facts(const CheckedGltf& checked)
{
    const Json& document = checked.document;
    const Json& asset = document.at("asset");
    GltfFacts facts;
    facts.version = text_or_empty(asset, "version");
    facts.generator = text_or_empty(asset, "generator");
    facts.copyright = text_or_empty(asset, "copyright");
    facts.nodes = section_size(document, "nodes");
    facts.meshes = section_size(document, "meshes");
    facts.materials = section_size(document, "materials");
    facts.textures = section_size(document, "textures");
    facts.images = section_size(document, "images");
    facts.cameras = section_size(document, "cameras");
    facts.skins = section_size(document, "skins");
    facts.animations = section_size(document, "animations");
    facts.extensions = checked.extensions;
    facts.xmp = find_xmp(document);
    if (section_size(document, "meshes") > 0) {
        for (const Json& mesh : document["meshes"]) {
            facts.primitives += section_size(mesh, "primitives");
        }
    }
    const auto names = [&document](const char* place) {
        return names_in(array_at(document, Json::json_pointer(place)));
    };
    facts.scene_names = names("/scenes");
    facts.variant_names = names("/extensions/KHR_materials_variants/variants");
    facts.animation_names = names("/animations");
    const auto extensions = document.find("extensions");
    if (extensions != document.end() && extensions->contains("KHR_lights_punctual")) {
        facts.lights = section_size((*extensions)["KHR_lights_punctual"], "lights");
    }
    return facts;
}

namespace {

/// Reads the JSON of a file.
Json read_document(const std::filesystem::path& file, const ReadLimits& limits)
{
    const Bytes bytes = read_file(file, limits.file_bytes);
    ByteView text = bytes;
    if (is_glb(bytes)) {
        LoadContext context{.folders = {.own = file.parent_path()}, .limits = limits};
        const GlbChunks::Range json = find_glb_chunks(bytes, context).json;
        text = text.subspan(json.offset, json.size);
    }
    return parse_json(text, limits);
}

}  // namespace

GltfFacts read_gltf_facts(const std::filesystem::path& file, const ReadLimits& limits)
{
    return with_named_errors(file, [&] {
        CheckedGltf unchecked;
        unchecked.document = read_document(file, limits);
        const JsonPlace root(unchecked.document);
        if (!root.has("asset") || !root.member("asset").value().is_object()) {
            root.fail("not a glTF document: it has no object \"asset\"");
        }
        unchecked.extensions = list_extensions(root);
        return collect_facts(unchecked);
    });
}

std::vector<std::filesystem::path> read_gltf_files(const std::filesystem::path& file,
                                                   const ReadLimits& limits,
                                                   const std::vector<std::filesystem::path>& allowed)
{
    return with_named_errors(file, [&] {
        LoadContext context{.folders = {.own = file.parent_path(), .allowed = allowed},
                            .limits = limits};
        const Json document = read_document(file, limits);
        return checked_uris(JsonPlace(document), context);
    });
}

}  // namespace bdpt::io
