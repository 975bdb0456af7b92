#include <bdpt/error.h>
#include <bdpt/io/gltf.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <system_error>

#include "file/json.h"
#include "file/load_context.h"
#include "file/messages.h"
#include "file/read_file.h"
#include "gltf/checks/checks.h"
#include "gltf/document/document.h"

namespace bdpt::io {

namespace {

std::string text_or_empty(const Json& object, const char* key)
{
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Returns the array at `pointer`, or an empty one.
const Json& array_at(const Json& document, const std::string& pointer)
{
    static const Json none = Json::array();
    const Json::json_pointer place(pointer);
    return document.contains(place) && document.at(place).is_array() ? document.at(place) : none;
}

/// Returns the packet that the asset refers to; empty if anything about it is invalid.
std::string find_xmp(const Json& document)
{
    constexpr std::size_t longest = std::size_t{1} << 20;
    for (const std::string extension : {"KHR_xmp_json_ld", "KHR_xmp"}) {
        const Json::json_pointer reference("/asset/extensions/" + extension + "/packet");
        const Json& packets = array_at(document, "/extensions/" + extension + "/packets");
        if (!document.contains(reference)) {
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

/// Returns the greatest time that the samplers of `animation` have; 0 if that is not stated.
double find_end(const Json& document, const Json& animation)
{
    double end = 0.0;
    const Json& accessors = array_at(document, "/accessors");
    for (const Json& sampler : array_at(animation, "/samplers")) {
        const auto input = sampler.find("input");
        if (input == sampler.end() || !input->is_number_unsigned() ||
            input->get<std::uint64_t>() >= accessors.size()) {
            continue;
        }
        const Json& greatest = array_at(accessors[input->get<std::size_t>()], "/max");
        if (!greatest.empty() && greatest[0].is_number()) {
            end = std::max(end, greatest[0].get<double>());
        }
    }
    return end;
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
    const auto count = [&document](const char* place) { return array_at(document, place).size(); };
    facts.nodes = count("/nodes");
    facts.meshes = count("/meshes");
    facts.materials = count("/materials");
    facts.textures = count("/textures");
    facts.images = count("/images");
    facts.cameras = count("/cameras");
    facts.skins = count("/skins");
    facts.animations = count("/animations");
    facts.lights = count("/extensions/KHR_lights_punctual/lights");
    facts.extensions = checked.extensions;
    facts.xmp = find_xmp(document);
    for (const Json& mesh : array_at(document, "/meshes")) {
        facts.primitives += array_at(mesh, "/primitives").size();
    }
    facts.scene_names = names_in(document, "/scenes");
    facts.variant_names = names_in(document, "/extensions/KHR_materials_variants/variants");
    facts.animation_names = names_in(document, "/animations");
    for (const Json& animation : array_at(document, "/animations")) {
        facts.animation_ends.push_back(find_end(document, animation));
    }
    return facts;
}

namespace {

/// Parses the JSON of a .gltf or .glb file.
Json parse_document(ByteView file, LoadContext& context)
{
    if (is_glb(file)) {
        const GlbChunks::Range json = find_glb_chunks(file, context).json;
        file = file.subspan(json.offset, json.size);
    }
    return parse_json(file, context.limits);
}

}  // namespace

GltfFacts read_gltf_facts(const std::filesystem::path& file, const ReadLimits& limits)
{
    return with_named_errors(file, [&] {
        LoadContext context{.folders = {.own = file.parent_path()}, .limits = limits};
        CheckedGltf unchecked;
        unchecked.document = parse_document(read_file(file, limits.file_bytes), context);
        const JsonPlace root(unchecked.document);
        if (!root.has("asset") || !root.member("asset").value().is_object()) {
            root.fail("not a glTF document: it has no object \"asset\"");
        }
        unchecked.extensions = list_extensions(root);
        return collect_facts(unchecked);
    });
}

std::vector<std::filesystem::path> read_gltf_files(
    const std::filesystem::path& file, const ReadLimits& limits,
    const std::vector<std::filesystem::path>& allowed)
{
    return with_named_errors(file, [&] {
        LoadContext context{.folders = {.own = file.parent_path(), .allowed = allowed},
                            .limits = limits};
        const Json document = parse_document(read_file(file, limits.file_bytes), context);
        return checked_uris(JsonPlace(document), context);
    });
}

namespace {

/// Returns a list such as "the file has 2 scenes: 0 "day", 1 "night"".
std::string list(std::string_view what, const std::vector<std::string>& names)
{
    constexpr std::size_t max_listed = 20;
    if (names.empty()) {
        return fmt::format("the file has no {}s", what);
    }
    std::string text = names.size() == 1 ? fmt::format("the file has one {}:", what)
                                         : fmt::format("the file has {} {}s:", names.size(), what);
    for (std::size_t i = 0; i < std::min(names.size(), max_listed); ++i) {
        text += fmt::format("{} {}", i == 0 ? "" : ",", i);
        if (!names[i].empty()) {
            text += fmt::format(" {}", quote(names[i]));
        }
    }
    return names.size() > max_listed ? text + fmt::format(" and {} more", names.size() - max_listed)
                                     : text;
}

std::optional<std::size_t> to_index(std::string_view text)
{
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || end != text.data() + text.size()) {
        return std::nullopt;
    }
    return index;
}

}  // namespace

std::vector<std::string> names_in(const Json& document, const std::string& pointer)
{
    std::vector<std::string> names;
    for (const Json& element : array_at(document, pointer)) {
        names.push_back(text_or_empty(element, "name"));
    }
    return names;
}

std::size_t select(std::string_view what, const std::vector<std::string>& names,
                   const std::string& wanted)
{
    const auto named = std::find(names.begin(), names.end(), wanted);
    if (named != names.end() && !wanted.empty()) {
        return static_cast<std::size_t>(named - names.begin());
    }
    const std::optional<std::size_t> index = to_index(wanted);
    if (!index || *index >= names.size()) {
        throw Error(ErrorCode::not_found,
                    fmt::format("no {} {}; {}", what, quote(wanted), list(what, names)));
    }
    return *index;
}

namespace {

ContentHash hash_bytes(ByteView bytes)
{
    ContentHasher hasher;
    hasher.add(bytes.data(), bytes.size());
    return hasher.hash();
}

/// Hashes a file in blocks, as it may be large while the scene is in memory already.
ContentHash hash_by_blocks(const std::filesystem::path& file, std::uint64_t limit)
{
    ContentHasher hasher;
    for_each_block(file, limit, [&](ByteView block) { hasher.add(block.data(), block.size()); });
    return hasher.hash();
}

std::set<std::string> read_uris(const Json& document)
{
    std::set<std::string> uris;
    for (const char* list : {"/buffers", "/images", "/extensions/EXT_lights_ies/lights"}) {
        for (const Json& element : array_at(document, list)) {
            const std::string uri = text_or_empty(element, "uri");
            if (!uri.empty() && !is_data_uri(uri)) {
                uris.insert(uri);
            }
        }
    }
    return uris;
}

/// Hashes a file; none if the loader will refuse or ignore it.
std::optional<ContentHash> hash_if_readable(const std::string& uri, const LoadContext& context)
{
    try {
        return hash_by_blocks(resolve_uri(context.folders, uri), context.limits.file_bytes);
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace

ContentHash hash_of_file(const std::filesystem::path& file, const ReadLimits& limits)
{
    return with_named_errors(file, [&] {
        return file == "-" ? hash_bytes(read_named(file, limits.file_bytes))
                           : hash_by_blocks(file, limits.file_bytes);
    });
}

std::vector<FileContent> gltf_file_contents(const std::filesystem::path& file,
                                            const ReadLimits& limits,
                                            const std::vector<std::filesystem::path>& allowed)
{
    return with_named_errors(file, [&] {
        LoadContext context{.folders = {.own = file.parent_path(), .allowed = allowed},
                            .limits = limits};
        const Bytes bytes = read_named(file, limits.file_bytes);
        std::vector<FileContent> result{
            {.name = file.filename().string(), .hash = hash_bytes(bytes)}};
        for (const std::string& uri : read_uris(parse_document(bytes, context))) {
            result.push_back({.name = uri, .hash = hash_if_readable(uri, context)});
        }
        return result;
    });
}

}  // namespace bdpt::io
