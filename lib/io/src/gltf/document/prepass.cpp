#include "gltf/document/document.h"

#include "file/load_context.h"
#include "file/read_file.h"
#include "gltf/checks/checks.h"
#include "gltf/compression/compression.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace bdpt::io {

namespace {

/// Checks major and minor version: 2.x, and a minimum of 2.0 at most [glTF 2.0, sec. 3.2]. Called
/// first, as glTF 1.0 breaks about every rule of 2.0.
void check_version(const JsonPlace& root)
{
    if (!root.has("asset")) {
        return;
    }
    const JsonPlace asset = root.member("asset");
    if (asset.has("version")) {
        const JsonPlace version = asset.member("version");
        if (version.value().is_string() &&
            !version.value().get_ref<const std::string&>().starts_with("2.")) {
            version.fail("glTF " + brief(version.value()) + "; only 2.x is supported",
                         ErrorCode::unsupported);
        }
    }
    if (asset.has("minVersion")) {
        const JsonPlace minimum = asset.member("minVersion");
        if (minimum.value() != "2.0") {
            minimum.fail("requires glTF " + brief(minimum.value()) + "; 2.0 is supported",
                         ErrorCode::unsupported);
        }
    }
}

/// Reads `length` bytes of the buffer's URI, and one more if there are more. Many buffers may share
/// one large file.
Bytes read_buffer(const JsonPlace& buffer, std::uint64_t length, const LoadContext& context)
{
    const JsonPlace place = buffer.member("uri");
    const auto& uri = place.value().get_ref<const std::string&>();
    try {
        if (is_data_uri(uri)) {
            return decode_data_uri(uri, context.limits.file_bytes);
        }
        const std::filesystem::path file = resolve_uri(context.folders, uri);
        try {
            return read_file(file, context.limits.file_bytes, length + 1, &context.budget.memory());
        } catch (const Error& error) {
            throw Error(error.code(), quote(uri) + ": " + error.what());
        }
    } catch (const Error& error) {
        place.fail(error.what(), error.code());
    }
}

/// Reads the buffers. Buffer 0 of a binary file is its BIN chunk, unless it has a URI [glTF 2.0,
/// sec. 4.4.3.3].
std::vector<Bytes> read_buffers(const JsonPlace& root, std::optional<Bytes> bin,
                                LoadContext& context)
{
    std::vector<Bytes> buffers;
    const std::vector<bool> fallback = find_fallback_buffers(root);
    const std::size_t count = root.has("buffers") ? root.member("buffers").size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const JsonPlace all = root.member("buffers");
        const JsonPlace buffer = all.element(i);
        if (fallback[i]) {
            buffers.emplace_back();
            continue;
        }
        const bool in_bin = i == 0 && bin && !buffer.has("uri");
        if (!in_bin && !buffer.has("uri")) {
            buffer.fail(i == 0 ? "no \"uri\", and there is no BIN chunk" : "no \"uri\"");
        }
        const std::uint64_t length = buffer.member("byteLength").as_unsigned();
        Bytes bytes = in_bin ? std::move(*bin) : read_buffer(buffer, length, context);
        if (!in_bin) {
            context.budget.memory().spend(buffer.pointer(), bytes.size());
        }
        if (bytes.size() < length) {
            buffer.member("byteLength")
                .fail(fmt::format("{} bytes, but there are {}", length, bytes.size()));
        }
        // The BIN chunk may have up to three bytes of padding.
        if (bytes.size() > length + (in_bin ? 3 : 0)) {
            context.warn("the buffer has more bytes than its byteLength; they are ignored",
                         fmt::format("{}: {}", buffer.member("byteLength").pointer(), length));
        }
        buffers.push_back(std::move(bytes));
    }
    return buffers;
}

using Paths = std::vector<std::filesystem::path>;

/// Adds the file that `place` names.
void add_file(Paths& files, const JsonPlace& place, LoadContext& context)
{
    const auto& uri = place.value().get_ref<const std::string&>();
    if (is_data_uri(uri)) {
        return;
    }
    files.push_back(resolve_uri(context.folders, uri));
    const auto has_backslash = [](const std::string& text) {
        return text.find('\\') != std::string::npos;
    };
    if (has_backslash(percent_decode(uri)) && !has_backslash(files.back().string())) {
        context.warn("a backslash in a URI is read as a slash",
                     fmt::format("{}: {}", place.pointer(), quote(uri)));
    }
}

/// Adds the files of all images or light profiles, used or not: a document that points outside of
/// its folder is refused as a whole.
void add_checked_uris(Paths& files, const JsonPlace& holders, LoadContext& context)
{
    for (std::size_t i = 0; i < holders.size(); ++i) {
        const JsonPlace holder = holders.element(i);
        if (holder.has("uri") && holder.has("bufferView")) {
            holder.fail("both \"uri\" and \"bufferView\"");
        }
        if (!holder.has("uri")) {
            continue;
        }
        const JsonPlace place = holder.member("uri");
        try {
            add_file(files, place, context);
        } catch (const Error& error) {
            place.fail(error.what(), error.code());
        }
    }
}

/// Adds the files of buffers. Unreadable ones are refused when they are read, which never happens
/// to fallback buffers.
void add_buffers(Paths& files, const JsonPlace& buffers, LoadContext& context)
{
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const JsonPlace buffer = buffers.element(i);
        if (!buffer.has("uri")) {
            continue;
        }
        const JsonPlace place = buffer.member("uri");
        try {
            add_file(files, place, context);
        } catch (const Error&) {
        }
    }
}

}  // namespace

std::vector<std::filesystem::path> checked_uris(const JsonPlace& root, LoadContext& context)
{
    Paths files;
    if (root.has("buffers")) {
        add_buffers(files, root.member("buffers"), context);
    }
    if (root.has("images")) {
        add_checked_uris(files, root.member("images"), context);
    }
    if (!root.has("extensions")) {
        return files;
    }
    const JsonPlace extensions = root.member("extensions");
    if (!extensions.has("EXT_lights_ies")) {
        return files;
    }
    const JsonPlace profiles = extensions.member("EXT_lights_ies");
    if (profiles.has("lights")) {
        add_checked_uris(files, profiles.member("lights"), context);
    }
    return files;
}

CheckedGltf read_checked_gltf(const std::filesystem::path& file, LoadContext& context)
{
    const auto worth = [&](ByteView start) { return worth_reading(start, context.limits); };
    MemoryBudget& memory = context.budget.memory();
    Bytes bytes = read_named(file, context.limits.file_bytes, worth, &memory);
    memory.spend("the file", bytes.size());
    CheckedGltf result;
    std::optional<Bytes> bin;
    if (is_glb(bytes)) {
        const GlbChunks chunks = find_glb_chunks(bytes, context);
        memory.spend("its JSON", chunks.json.size * parsed_growth);
        result.document = parse_json(ByteView(bytes).subspan(chunks.json.offset, chunks.json.size),
                                     context.limits);
        if (chunks.bin) {
            // In place, so that a scene's vertices are not in memory twice.
            bytes.resize(chunks.bin->offset + chunks.bin->size);
            bytes.erase(bytes.begin(),
                        bytes.begin() + static_cast<std::ptrdiff_t>(chunks.bin->offset));
            bin = std::move(bytes);
        }
    } else {
        if (const std::optional<std::string> kind = kind_instead_of_gltf(bytes, file)) {
            throw Error(ErrorCode::invalid_input, fmt::format("not a glTF file but {}", *kind));
        }
        memory.spend("its JSON", bytes.size() * parsed_growth);
        result.document = parse_json(bytes, context.limits);
    }
    const JsonPlace root(result.document);
    if (!root.value().is_object()) {
        root.fail("a glTF document must be a JSON object, but is " + brief(root.value()));
    }
    check_version(root);
    result.extensions = check_extensions(root, context);
    check_schema(root, context);
    check_layout(root, context);
    check_node_graph(root, context.limits);
    result.files = checked_uris(root, context);
    result.buffers = read_buffers(root, std::move(bin), context);
    decode_meshopt_views(result.document, result.buffers, context);
    decode_draco_primitives(result.document, result.buffers, context);
    // Decoded data is checked like data from the file.
    const Silence silence(context.warnings);
    check_layout(JsonPlace(result.document), context);
    return result;
}

}  // namespace bdpt::io
