#include "gltf/checks/checks.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace bdpt::io {

namespace {

constexpr std::uint32_t magic = 0x46546C67;       // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t bin_chunk = 0x004E4942;   // "BIN"
constexpr std::size_t header_size = 12;
constexpr std::size_t chunk_header_size = 8;

std::uint32_t read_u32(ByteView file, std::size_t offset)
{
    return static_cast<std::uint32_t>(file[offset]) |
           static_cast<std::uint32_t>(file[offset + 1]) << 8 |
           static_cast<std::uint32_t>(file[offset + 2]) << 16 |
           static_cast<std::uint32_t>(file[offset + 3]) << 24;
}

[[noreturn]] void fail(const std::string& what)
{
    throw Error(ErrorCode::invalid_input, "GLB: " + what);
}

}  // namespace

bool is_glb(ByteView file)
{
    return file.size() >= 4 && read_u32(file, 0) == magic;
}

std::uint64_t worth_reading(ByteView start, const ReadLimits& limits)
{
    if (is_glb(start) && start.size() >= header_size) {
        return std::uint64_t{read_u32(start, 8)} + 1;
    }
    // White space, and the byte order mark of UTF-8.
    constexpr std::string_view before_object = " \t\r\n\xef\xbb\xbf";
    const auto first = std::find_if(start.begin(), start.end(), [&](std::uint8_t byte) {
        return before_object.find(static_cast<char>(byte)) == std::string_view::npos;
    });
    const bool may_be_json = first == start.end() || *first == '{';
    return may_be_json ? limits.json_bytes + 1 : start.size();
}

GlbChunks find_glb_chunks(ByteView file, LoadContext& context)
{
    if (file.size() < header_size) {
        fail(fmt::format("truncated: {} bytes are less than a header", file.size()));
    }
    if (const std::uint32_t version = read_u32(file, 4); version != 2) {
        throw Error(ErrorCode::unsupported,
                    fmt::format("GLB: container version {}; only 2 is supported", version));
    }
    const std::size_t length = read_u32(file, 8);
    if (length < header_size) {
        fail(fmt::format("the header states a length of {} bytes, but has {} itself", length,
                         header_size));
    }
    if (length > file.size()) {
        fail(fmt::format("truncated: the header promises {} bytes, but there are {}", length,
                         file.size()));
    }
    if (length < file.size()) {
        context.warn("bytes after the end of the GLB are ignored",
                     fmt::format("GLB: {} bytes", file.size() - length));
    }
    std::optional<GlbChunks::Range> json;
    std::optional<GlbChunks::Range> bin;
    std::size_t offset = header_size;
    while (length - offset >= chunk_header_size && length > offset) {
        const std::size_t size = read_u32(file, offset);
        const std::uint32_t type = read_u32(file, offset + 4);
        const std::size_t start = offset + chunk_header_size;
        if (size > length - start) {
            fail(fmt::format("chunk at byte {}: {} bytes, but {} are left", offset, size,
                             length - start));
        }
        if (!json && type != json_chunk) {
            fail(fmt::format("the first chunk has type 0x{:08x}, but must be JSON", type));
        }
        if ((json && type == json_chunk) || (bin && type == bin_chunk)) {
            fail(fmt::format("chunk at byte {}: a second {} chunk", offset,
                             type == json_chunk ? "JSON" : "BIN"));
        }
        if (type == json_chunk) {
            json = GlbChunks::Range{start, size};
        } else if (type == bin_chunk) {
            bin = GlbChunks::Range{start, size};
        }
        offset = start + size;
    }
    if (offset != length) {
        fail(fmt::format("{} bytes at byte {} are not a chunk", length - offset, offset));
    }
    if (!json) {
        fail("no JSON chunk");
    }
    // Padding must be spaces, but some exporters write zeros.
    while (json->size > 0 && file[json->offset + json->size - 1] == 0) {
        --json->size;
    }
    return {*json, bin};
}

}  // namespace bdpt::io
