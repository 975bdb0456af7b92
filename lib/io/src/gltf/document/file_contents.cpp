#include <bdpt/io/gltf.h>

#include "file/json.h"
#include "file/load_context.h"
#include "file/named_errors.h"
#include "file/read_file.h"
#include "file/standard_input.h"
#include "file/uri.h"
#include "gltf/checks/glb.h"

#include <bdpt/error.h>

#include <set>

namespace bdpt::io {
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

/// Adds the files named by the elements of the list at `pointer`.
void add_uris(std::set<std::string>& uris, const Json& document, const char* pointer)
{
    const Json::json_pointer place(pointer);
    if (!document.contains(place) || !document[place].is_array()) {
        return;
    }
    for (const Json& element : document[place]) {
        if (!element.is_object() || !element.contains("uri") || !element["uri"].is_string()) {
            continue;
        }
        const auto& uri = element["uri"].get_ref<const std::string&>();
        if (!is_data_uri(uri)) {
            uris.insert(uri);
        }
    }
}

std::set<std::string> read_uris(ByteView file, LoadContext& context)
{
    ByteView text = file;
    if (is_glb(file)) {
        const GlbChunks::Range json = find_glb_chunks(file, context).json;
        text = text.subspan(json.offset, json.size);
    }
    const Json document = parse_json(text, context.limits);
    std::set<std::string> uris;
    for (const char* list : {"/buffers", "/images", "/extensions/EXT_lights_ies/lights"}) {
        add_uris(uris, document, list);
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
        for (const std::string& uri : read_uris(bytes, context)) {
            result.push_back({.name = uri, .hash = hash_if_readable(uri, context)});
        }
        return result;
    });
}

}  // namespace bdpt::io
